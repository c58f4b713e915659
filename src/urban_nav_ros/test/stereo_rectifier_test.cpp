// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_rectifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/stereo_feed.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::StampNs;

constexpr int kRawWidth = 96, kRawHeight = 72;

sensor_msgs::CameraInfo rawInfo(Side side, double distortion) {
  urban_nav_core::StereoCamera camera;
  camera.left = {80.0, 80.0, 47.5, 35.5, kRawWidth, kRawHeight};
  camera.baseline = 0.12;
  sensor_msgs::CameraInfo info = toCameraInfoMessage(side == Side::Left ? leftInfo(camera) : rightInfo(camera));
  info.D.assign(5, 0.0);
  info.D[0] = distortion;
  info.distortion_model = "plumb_bob";
  return info;
}

cv::Mat pattern(int type, int scale) {
  cv::Mat image(kRawHeight, kRawWidth, type);
  for (int v = 0; v < kRawHeight; ++v)
    for (int u = 0; u < kRawWidth; ++u) {
      const int value = scale * ((7 * u + 13 * v) % 251);
      if (type == CV_8UC1) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(value);
      else image.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(value);
    }
  return image;
}

ImageInput rawImage(Side side, StampNs stamp) {
  auto message = boost::make_shared<sensor_msgs::Image>(toImageMessage(pattern(CV_8UC1, 1)));
  message->header.stamp = toRosTime(stamp);
  message->header.frame_id = "camera";
  return {side, sensor_msgs::ImageConstPtr(message), stamp};
}

ImageInput deepImage(Side side, StampNs stamp) {
  const cv::Mat pixels = pattern(CV_16UC1, 16);
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = toRosTime(stamp);
  message->encoding = "mono16";
  message->width = kRawWidth;
  message->height = kRawHeight;
  message->step = 2 * kRawWidth;
  message->data.assign(pixels.datastart, pixels.dataend);
  return {side, sensor_msgs::ImageConstPtr(message), stamp};
}

ImageInput packedImage(Side side, StampNs stamp) {
  auto message = boost::make_shared<sensor_msgs::CompressedImage>();
  message->header.stamp = toRosTime(stamp);
  message->format = "png";
  cv::imencode(".png", pattern(CV_8UC1, 1), message->data);
  return {side, sensor_msgs::CompressedImageConstPtr(message), stamp};
}

/// Rectifier that keeps the published images.
struct Rectified {
  explicit Rectified(bool rectified = false, int queue = 10, StampNs right_delay = 0) {
    StereoRectifier::Options options;
    options.rectified = rectified;
    options.right_delay = right_delay;
    options.queue = queue;
    rectifier = std::make_unique<StereoRectifier>(
        options, StereoRectifier::Listener{[this](Side side, const sensor_msgs::ImageConstPtr& image) {
                                             (side == Side::Left ? left : right).push_back(image);
                                           },
                                           [this](const std::string& fault) { faults.push_back(fault); }});
  }
  void calibrate(double distortion, double baseline_scale = 1.0) {
    for (const Side side : {Side::Left, Side::Right}) {
      auto info = boost::make_shared<sensor_msgs::CameraInfo>(rawInfo(side, distortion));
      info->P[3] *= baseline_scale;
      rectifier->handle(InfoInput{side, info});
    }
  }
  std::unique_ptr<StereoRectifier> rectifier;
  std::vector<sensor_msgs::ImageConstPtr> left, right;
  std::vector<std::string> faults;
};

/// Returns the pixels of the same images from a stereo feed, as in the offline run.
std::vector<std::uint8_t> fedLeft(const ImageInput& left, const ImageInput& right, double distortion) {
  StereoFeed feed(StereoFeed::Options(),
                  std::make_shared<StereoCalibration>(toCameraInfo(rawInfo(Side::Left, distortion)),
                                                      toCameraInfo(rawInfo(Side::Right, distortion)), false, "test"));
  for (const ImageInput* image : {&left, &right})
    std::visit([&](const auto& message) { feed.add(image->side, message); }, image->message);
  feed.finish();
  const auto pair = feed.take();
  const urban_nav_core::ImageView& view = pair->assembled.pair.left;
  std::vector<std::uint8_t> pixels;
  for (int v = 0; v < view.height; ++v) pixels.insert(pixels.end(), view.row(v), view.row(v) + view.width);
  return pixels;
}

TEST(StereoRectifier, PublishesThePixelsThatAStereoFeedHas) {
  for (const auto make : {&rawImage, &deepImage, &packedImage}) {
    for (const double distortion : {0.0, -0.3}) {
      Rectified rectified;
      rectified.calibrate(distortion);
      rectified.rectifier->handle(make(Side::Left, 1'000'000'000));
      rectified.rectifier->handle(make(Side::Right, 1'000'000'000));
      ASSERT_EQ(rectified.left.size(), 1U);
      ASSERT_EQ(rectified.right.size(), 1U);
      const sensor_msgs::Image& image = *rectified.left[0];
      EXPECT_EQ(image.encoding, "mono8");
      EXPECT_EQ(image.header.stamp, toRosTime(1'000'000'000));
      EXPECT_EQ(image.step, image.width);
      EXPECT_EQ(image.data, fedLeft(make(Side::Left, 1'000'000'000), make(Side::Right, 1'000'000'000), distortion));
      EXPECT_EQ(rectified.rectifier->counts().rectified, distortion == 0.0 ? 0 : 2);
      EXPECT_EQ(rectified.rectifier->counts().passed, distortion == 0.0 ? 2 : 0);
    }
  }
}

TEST(StereoRectifier, RectifiedImagesPassWithoutACopy) {
  Rectified rectified(true);
  rectified.calibrate(-0.3);
  const ImageInput image = rawImage(Side::Left, 5);
  rectified.rectifier->handle(image);
  ASSERT_EQ(rectified.left.size(), 1U);
  EXPECT_EQ(rectified.left[0], std::get<sensor_msgs::ImageConstPtr>(image.message));
  EXPECT_EQ(rectified.rectifier->counts().rectified, 0);
}

TEST(StereoRectifier, ADelayIsTakenFromTheStampsOfTheRightImages) {
  for (const bool are_rectified : {false, true}) {
    Rectified rectified(are_rectified, 10, 8'000'000);
    rectified.calibrate(-0.3);
    rectified.rectifier->handle(rawImage(Side::Left, 1'000'000'000));
    rectified.rectifier->handle(rawImage(Side::Right, 1'008'000'000));
    ASSERT_EQ(rectified.right.size(), 1U);
    EXPECT_EQ(rectified.right[0]->header.stamp, rectified.left[0]->header.stamp);
    EXPECT_EQ(rectified.right[0]->header.frame_id, "camera");
    EXPECT_EQ(rectified.right[0]->width, static_cast<std::uint32_t>(kRawWidth));
  }
}

TEST(StereoRectifier, ABaselineThatNoVehicleHasIsAWarning) {
  Rectified rectified;
  rectified.calibrate(0.0, 1000.0);
  const std::vector<std::string> warnings = rectified.rectifier->report().warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("120 m"), std::string::npos) << warnings[0];
}

TEST(StereoRectifier, ImagesWaitForTheCalibration) {
  Rectified rectified(false, 2);
  EXPECT_TRUE(rectified.rectifier->report().is_warning);
  for (StampNs stamp : {1, 2, 3}) rectified.rectifier->handle(rawImage(Side::Left, stamp));
  EXPECT_TRUE(rectified.left.empty());
  rectified.calibrate(-0.3);
  ASSERT_EQ(rectified.left.size(), 2U);
  EXPECT_EQ(rectified.left[0]->header.stamp, toRosTime(2));
  EXPECT_EQ(rectified.rectifier->counts().dropped, 1);
  EXPECT_FALSE(rectified.rectifier->report().is_warning);
}

TEST(StereoRectifier, ADamagedImageBecomesOneWithoutPixels) {
  Rectified rectified;
  rectified.calibrate(-0.3);
  auto small = boost::make_shared<sensor_msgs::Image>(toImageMessage(cv::Mat(10, 10, CV_8UC1, cv::Scalar(3))));
  small->header.stamp = toRosTime(7);
  rectified.rectifier->handle(ImageInput{Side::Right, sensor_msgs::ImageConstPtr(small), 7});
  ASSERT_EQ(rectified.right.size(), 1U);
  EXPECT_TRUE(rectified.right[0]->data.empty());
  EXPECT_EQ(rectified.right[0]->header.stamp, toRosTime(7));
  EXPECT_EQ(rectified.rectifier->counts().damaged, 1);
  ASSERT_EQ(rectified.faults.size(), 1U);
  EXPECT_EQ(rectified.faults[0], "right image: 10x10, which is not the size in camera_info");
}

TEST(StereoRectifier, ANewCalibrationNeedsBothSides) {
  Rectified rectified;
  rectified.calibrate(-0.3);
  rectified.rectifier->handle(
      InfoInput{Side::Left, boost::make_shared<sensor_msgs::CameraInfo>(rawInfo(Side::Left, -0.2))});
  rectified.rectifier->handle(rawImage(Side::Left, 5));
  EXPECT_TRUE(rectified.left.empty());
  rectified.rectifier->handle(
      InfoInput{Side::Right, boost::make_shared<sensor_msgs::CameraInfo>(rawInfo(Side::Right, -0.2))});
  ASSERT_EQ(rectified.left.size(), 1U);
  EXPECT_EQ(rectified.left[0]->data, fedLeft(rawImage(Side::Left, 5), rawImage(Side::Right, 5), -0.2));
}

TEST(StereoRectifier, ACalibrationThatIsNoStereoPairIsNamed) {
  Rectified rectified;
  for (const Side side : {Side::Left, Side::Right})
    rectified.rectifier->handle(InfoInput{side, boost::make_shared<sensor_msgs::CameraInfo>(rawInfo(Side::Left, 0.0))});
  ASSERT_EQ(rectified.faults.size(), 1U);
  EXPECT_EQ(rectified.rectifier->report().summary, rectified.faults[0]);
}

}  // namespace
}  // namespace urban_nav_ros
