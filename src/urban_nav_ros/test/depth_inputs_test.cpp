// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/depth_inputs.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace urban_nav_ros {
namespace {

constexpr std::uint32_t kInputWidth = 8, kInputHeight = 6;

sensor_msgs::ImageConstPtr depthInputImage(const std::string& encoding = "16UC1", std::uint32_t width = kInputWidth) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp = ros::Time(5, 0);
  image->header.frame_id = "depth_optical_frame";
  image->encoding = encoding;
  image->width = width;
  image->height = kInputHeight;
  image->step = 2 * width;
  for (std::uint32_t i = 0; i < width * kInputHeight; ++i) {
    image->data.push_back(0xD0);  // 2000 mm
    image->data.push_back(0x07);
  }
  return image;
}

sensor_msgs::CameraInfoConstPtr depthInputInfo(double focal_length = 10.0) {
  auto info = boost::make_shared<sensor_msgs::CameraInfo>();
  info->width = kInputWidth;
  info->height = kInputHeight;
  info->K = {focal_length, 0.0, 4.0, 0.0, focal_length, 3.0, 0.0, 0.0, 1.0};
  info->P = {focal_length, 0.0, 4.0, 0.0, 0.0, focal_length, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  info->R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  return info;
}

class DepthInputsTest : public ::testing::Test {
 protected:
  std::vector<DepthInputs::Image> images_;
  DepthInputs inputs_{[this](const DepthInputs::Image& image) { images_.push_back(image); }};
};

TEST_F(DepthInputsTest, ImagesArePassedOnOnceTheirCameraIsKnown) {
  inputs_.handle({1, depthInputImage()});
  EXPECT_TRUE(images_.empty());
  EXPECT_EQ(inputs_.fault(), "1 images on depth1/image_raw, but nothing on depth1/camera_info");
  inputs_.handle({1, depthInputInfo()});
  inputs_.handle({1, depthInputImage()});
  EXPECT_EQ(inputs_.fault(), "");
  ASSERT_EQ(images_.size(), 1U);
  EXPECT_EQ(images_.front().frame, "depth_optical_frame");
  EXPECT_EQ(images_.front().stamp, 5'000'000'000);
  EXPECT_EQ(images_.front().pinhole.fx, 10.0);
  const cv::Mat depth = images_.front().decode();
  ASSERT_EQ(depth.size(), cv::Size(kInputWidth, kInputHeight));
  EXPECT_FLOAT_EQ(depth.at<float>(3, 2), 2.0F);
}

TEST_F(DepthInputsTest, ACalibrationThatIsNotThatOfACameraIsNamed) {
  inputs_.handle({0, depthInputInfo(0.0)});
  EXPECT_NE(inputs_.fault().find("depth0/camera_info"), std::string::npos) << inputs_.fault();
  inputs_.handle({0, depthInputInfo()});
  EXPECT_EQ(inputs_.fault(), "") << "the driver was started again";
}

TEST_F(DepthInputsTest, AnImageThatCannotBeUsedIsNamed) {
  inputs_.handle({0, depthInputInfo()});
  inputs_.handle({0, depthInputImage("16UC1", 4)});
  ASSERT_EQ(images_.size(), 1U);
  images_.back().decode();
  EXPECT_EQ(inputs_.fault(), "depth0/image_raw: images have 4x6 pixels, depth0/camera_info is of 8x6");
  inputs_.handle({0, depthInputImage("rgb8")});
  EXPECT_TRUE(images_.back().decode().empty());
  EXPECT_NE(inputs_.fault().find("rgb8"), std::string::npos) << inputs_.fault();
  inputs_.handle({0, depthInputImage()});
  EXPECT_FALSE(images_.back().decode().empty());
  EXPECT_EQ(inputs_.fault(), "");
}

TEST_F(DepthInputsTest, DistortionThatIsNotCorrectedIsAWarning) {
  const auto distorted = boost::make_shared<sensor_msgs::CameraInfo>(*depthInputInfo());
  distorted->distortion_model = "plumb_bob";
  distorted->D = {0.1, 0.0, 0.0, 0.0, 0.0};
  inputs_.handle({0, sensor_msgs::CameraInfoConstPtr(distorted)});
  urban_nav_live::StageReport report;
  inputs_.addTo(report);
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_NE(report.warnings.front().find("distortion in depth0/camera_info"), std::string::npos);
}

TEST_F(DepthInputsTest, ADriverWithAnotherCalibrationIsFollowed) {
  inputs_.handle({0, depthInputInfo(10.0)});
  inputs_.handle({0, depthInputImage()});
  inputs_.handle({0, depthInputInfo(20.0)});
  inputs_.handle({0, depthInputImage()});
  ASSERT_EQ(images_.size(), 2U);
  EXPECT_EQ(images_.front().pinhole.fx, 10.0);
  EXPECT_EQ(images_.back().pinhole.fx, 20.0);
  EXPECT_FALSE(images_.back().decode().empty());
}

}  // namespace
}  // namespace urban_nav_ros
