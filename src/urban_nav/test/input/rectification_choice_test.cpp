// SPDX-License-Identifier: BSD-3-Clause
#include "input/rectification_choice.hpp"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "support/folders.hpp"

namespace urban_nav {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::CameraInfo;

/// Calibration of a rendered room's cameras (240x180 px, f 200 px) behind lenses that differ.
CameraInfo lensInfo(bool is_right) {
  CameraInfo info;
  info.width = 240;
  info.height = 180;
  info.distortion_model = "plumb_bob";
  info.D = {is_right ? -0.25 : -0.35, 0.1, 0.0, 0.0, 0.0};
  info.K << 200, 0, is_right ? 117.0 : 121.0, 0, 200, is_right ? 92.0 : 86.0, 0, 0, 1;
  info.R.setIdentity();
  info.P.setZero();
  info.P.leftCols<3>() << 200, 0, 119.5, 0, 200, 89.5, 0, 0, 1;
  info.P(0, 3) = is_right ? -200.0 * 0.2 : 0.0;
  return info;
}

/// Returns the image that a lens makes of what an ideal camera sees.
cv::Mat distort(const cv::Mat& ideal, const CameraInfo& info) {
  const cv::Matx33d K(info.K(0, 0), 0, info.K(0, 2), 0, info.K(1, 1), info.K(1, 2), 0, 0, 1);
  const cv::Matx33d P(200, 0, 119.5, 0, 200, 89.5, 0, 0, 1);
  std::vector<cv::Point2f> raw, seen;
  for (int v = 0; v < ideal.rows; ++v)
    for (int u = 0; u < ideal.cols; ++u) raw.emplace_back(cv::Point(u, v));
  cv::undistortPoints(raw, seen, K, info.D, cv::noArray(), P);
  const cv::Mat map(ideal.rows, ideal.cols, CV_32FC2, seen.data());
  cv::Mat image;
  cv::remap(ideal, image, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return image;
}

class RectificationChoiceTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    testing::KittiStyle style;
    style.frames = 5;
    testing::makeKittiFolder(folder.file("room"), style);
    for (int i = 0; i < style.frames; ++i) {
      const std::string name = "/00000" + std::to_string(i) + ".png";
      pairs_.emplace_back(cv::imread(folder.file("room") + "/image_0" + name, cv::IMREAD_GRAYSCALE),
                          cv::imread(folder.file("room") + "/image_1" + name, cv::IMREAD_GRAYSCALE));
    }
  }
  static std::vector<ImagePair> pairs_;
  const urban_nav_ros::StereoCalibration rectifying_{lensInfo(false), lensInfo(true), false, "room"};
};
std::vector<ImagePair> RectificationChoiceTest::pairs_;

TEST_F(RectificationChoiceTest, imagesThatAreRectifiedAlreadyAreRecognised) {
  const RectificationChoice choice = chooseRectification(pairs_, rectifying_);
  EXPECT_TRUE(choice.is_decided);
  EXPECT_TRUE(choice.is_rectified);
  EXPECT_LT(choice.as_they_are_px, 0.5);
}

TEST_F(RectificationChoiceTest, rawImagesAreRecognised) {
  std::vector<ImagePair> raw;
  for (const auto& [left, right] : pairs_)
    raw.emplace_back(distort(left, lensInfo(false)), distort(right, lensInfo(true)));
  const RectificationChoice choice = chooseRectification(raw, rectifying_);
  EXPECT_TRUE(choice.is_decided);
  EXPECT_FALSE(choice.is_rectified);
  EXPECT_LT(choice.rectified_px, 0.5);
}

TEST_F(RectificationChoiceTest, fewPairsOrBlankImagesDecideNothing) {
  EXPECT_FALSE(chooseRectification({pairs_[0], pairs_[1]}, rectifying_).is_decided);
  const cv::Mat blank(180, 240, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(chooseRectification({{blank, blank}, {blank, blank}, {blank, blank}}, rectifying_).is_decided);
}

}  // namespace
}  // namespace urban_nav
