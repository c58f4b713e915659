// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/rectification_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/rectification_judge.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/stereo_sessions.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::CameraInfo;
using urban_nav_core::StampNs;

constexpr StampNs kFrameInterval = 50'000'000, kFirstStamp = 1'600'000'000'000'000'000;

/// Calibration of a rendered room's cameras (240x180 px, f 190 px) with different distortions.
CameraInfo lensInfo(bool is_right) {
  CameraInfo info;
  info.width = 240;
  info.height = 180;
  info.distortion_model = "plumb_bob";
  info.D = {is_right ? -0.25 : -0.35, 0.1, 0.0, 0.0, 0.0};
  info.K << 190, 0, is_right ? 117.0 : 121.0, 0, 190, is_right ? 92.0 : 86.0, 0, 0, 1;
  info.R.setIdentity();
  info.P.setZero();
  info.P.leftCols<3>() << 190, 0, 119.5, 0, 190, 89.5, 0, 0, 1;
  info.P(0, 3) = is_right ? -190.0 * 0.12 : 0.0;
  return info;
}

/// Returns the distorted image of an ideal camera's image.
cv::Mat distort(const cv::Mat& ideal, const CameraInfo& info) {
  cv::Mat map(ideal.rows, ideal.cols, CV_32FC2), image;
  for (int v = 0; v < ideal.rows; ++v)
    for (int u = 0; u < ideal.cols; ++u) {
      const Eigen::Vector2d seen((u - info.K(0, 2)) / info.K(0, 0), (v - info.K(1, 2)) / info.K(1, 1));
      Eigen::Vector2d ray = seen;  // fixed point of ray (1 + k1 r^2 + k2 r^4) = seen
      for (int k = 0; k < 50; ++k)
        ray = seen / (1.0 + info.D[0] * ray.squaredNorm() + info.D[1] * std::pow(ray.squaredNorm(), 2));
      map.at<cv::Vec2f>(v, u) = {static_cast<float>(info.P(0, 0) * ray.x() + info.P(0, 2)),
                                 static_cast<float>(info.P(1, 1) * ray.y() + info.P(1, 2))};
    }
  cv::remap(ideal, image, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return image;
}

cv::Mat toPixels(const urban_nav_core::testing::GreyImage& image) {
  cv::Mat pixels(image.height, image.width, CV_8UC1);
  std::copy(image.pixels.begin(), image.pixels.end(), pixels.begin<std::uint8_t>());
  return pixels;
}

ImageInput toInput(Side side, StampNs stamp, const cv::Mat& pixels) {
  auto message = boost::make_shared<sensor_msgs::Image>(toImageMessage(pixels));
  message->header.stamp = toRosTime(stamp);
  return {side, sensor_msgs::ImageConstPtr(message), stamp};
}

class RectificationTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    urban_nav_core::testing::SequenceOptions options;
    options.camera.width = 240;
    options.camera.height = 180;
    options.camera.fx = options.camera.fy = 190.0;
    options.camera.cx = 119.5;
    options.camera.cy = 89.5;
    options.camera.baseline = 0.12;
    urban_nav_core::testing::RenderedSequence sequence(urban_nav_core::testing::texturedRoom(),
                                                       urban_nav_core::testing::loop(2.5, 1.5, 1.1, 30.0), options);
    for (int i = 0; i < kJudgedPairs + 2; ++i) {
      const auto& frame = sequence.frame(i);
      ideal_.emplace_back(toPixels(frame.left), toPixels(frame.right));
      raw_.emplace_back(distort(ideal_.back().first, lensInfo(false)), distort(ideal_.back().second, lensInfo(true)));
    }
  }
  static std::vector<ImagePair> ideal_, raw_;
  const StereoCalibration rectifying_{lensInfo(false), lensInfo(true), false, "room"};
};
std::vector<ImagePair> RectificationTest::ideal_, RectificationTest::raw_;

TEST_F(RectificationTest, ImagesThatAreRectifiedAlreadyAreRecognised) {
  const RectificationChoice choice = chooseRectification(ideal_, rectifying_);
  EXPECT_TRUE(choice.is_decided);
  EXPECT_TRUE(choice.is_rectified);
  EXPECT_LT(choice.as_they_are_px, 0.5);
  EXPECT_EQ(choice.contradiction(true), "");
  EXPECT_NE(choice.contradiction(false).find("rectified already"), std::string::npos);
}

TEST_F(RectificationTest, RawImagesAreRecognised) {
  const RectificationChoice choice = chooseRectification(raw_, rectifying_);
  EXPECT_TRUE(choice.is_decided);
  EXPECT_FALSE(choice.is_rectified);
  EXPECT_LT(choice.rectified_px, 0.5);
}

TEST_F(RectificationTest, FewPairsOrBlankImagesDecideNothing) {
  EXPECT_FALSE(chooseRectification({ideal_[0], ideal_[1]}, rectifying_).is_decided);
  const cv::Mat blank(180, 240, CV_8UC1, cv::Scalar(90));
  const RectificationChoice choice = chooseRectification({{blank, blank}, {blank, blank}, {blank, blank}}, rectifying_);
  EXPECT_FALSE(choice.is_decided);
  EXPECT_TRUE(choice.isRectified(true));
  EXPECT_FALSE(choice.isRectified(false));
}

/// Sessions of a live camera, with the number of pairs received before each.
struct LiveCamera {
  explicit LiveCamera(bool named_as_rectified) {
    StereoSessions::Options options;
    options.tf_timeout = 0.0;
    options.rectified = named_as_rectified;
    options.judges_images = true;
    StereoSessions::Listener listener;
    listener.began = [this](const StereoSessions::Camera& camera) { began.push_back(camera); };
    listener.pair = [this](DecodedPair&) { ++pairs; };
    sessions = std::make_unique<StereoSessions>(options, listener);
  }
  void calibrate() {
    for (const Side side : {Side::Left, Side::Right}) {
      auto message = boost::make_shared<sensor_msgs::CameraInfo>(toCameraInfoMessage(lensInfo(side == Side::Right)));
      sessions->handle(InfoInput{side, message});
    }
  }
  void show(const ImagePair& pair, bool with_right = true) {
    const StampNs stamp = kFirstStamp + kFrameInterval * shown++;
    sessions->handle(toInput(Side::Left, stamp, pair.first));
    if (with_right) sessions->handle(toInput(Side::Right, stamp, pair.second));
  }
  std::unique_ptr<StereoSessions> sessions;
  std::vector<StereoSessions::Camera> began;
  int shown = 0, pairs = 0;
};

TEST_F(RectificationTest, LiveTheFirstPairsDecideAndNoneIsLost) {
  for (const bool is_raw : {false, true})
    for (const bool named_as_rectified : {false, true}) {
      LiveCamera camera(named_as_rectified);
      camera.calibrate();
      for (const ImagePair& pair : is_raw ? raw_ : ideal_) camera.show(pair);
      ASSERT_EQ(camera.began.size(), 1U);
      EXPECT_EQ(camera.began[0].rectifies, is_raw);
      EXPECT_EQ(camera.began[0].contradiction.empty(), is_raw != named_as_rectified);
      camera.sessions->end("done");
      EXPECT_EQ(camera.pairs, kJudgedPairs + 2);
    }
}

TEST_F(RectificationTest, LiveACameraWithoutPairsBeginsByItsName) {
  LiveCamera camera(false);
  camera.calibrate();
  for (int i = 0; i < 60; ++i) camera.show(ideal_[0], false);
  ASSERT_EQ(camera.began.size(), 1U);
  EXPECT_TRUE(camera.began[0].rectifies);
  EXPECT_TRUE(camera.began[0].contradiction.empty());
}

TEST_F(RectificationTest, LiveImagesBeforeTheCalibrationCount) {
  LiveCamera camera(false);
  for (const ImagePair& pair : ideal_) camera.show(pair);
  camera.calibrate();
  ASSERT_EQ(camera.began.size(), 1U);
  EXPECT_FALSE(camera.began[0].rectifies);
}

}  // namespace
}  // namespace urban_nav_ros
