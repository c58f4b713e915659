// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <vector>

#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/testing/listener.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_ros {
namespace {

/// Distorted stereo camera, with a listener to the rectified images.
class RectifiedCamera : public testing::Listener {
 public:
  RectifiedCamera() : Listener("stereo_rectify") {
    keep(topics::kLeftRectified, left);
    keep(topics::kRightRectified, right);
  }

  void show(urban_nav_core::StampNs stamp) {
    urban_nav_core::StereoCamera camera;
    camera.left = {80.0, 80.0, 47.5, 35.5, 96, 72};
    camera.baseline = 0.12;
    publish(left_info_, left_image_, toCameraInfoMessage(leftInfo(camera)), stamp);
    publish(right_info_, right_image_, toCameraInfoMessage(rightInfo(camera)), stamp);
  }

  std::vector<sensor_msgs::Image> left, right;

 private:
  static void publish(ros::Publisher& infos, ros::Publisher& images, sensor_msgs::CameraInfo info,
                      urban_nav_core::StampNs stamp) {
    info.D.assign(5, 0.0);
    info.D[0] = -0.3;
    info.distortion_model = "plumb_bob";
    sensor_msgs::Image image = toImageMessage(cv::Mat(72, 96, CV_8UC1, cv::Scalar(90)));
    info.header.stamp = image.header.stamp = toRosTime(stamp);
    info.header.frame_id = image.header.frame_id = "camera";
    infos.publish(info);
    images.publish(image);
  }

  ros::Publisher left_image_ = advertise<sensor_msgs::Image>(topics::kLeftImage);
  ros::Publisher right_image_ = advertise<sensor_msgs::Image>(topics::kRightImage);
  ros::Publisher left_info_ = advertise<sensor_msgs::CameraInfo>(topics::kLeftInfo);
  ros::Publisher right_info_ = advertise<sensor_msgs::CameraInfo>(topics::kRightInfo);
};

TEST(StereoRectifyNodelet, PublishesEachImageOnceAndReports) {
  RectifiedCamera camera;
  ASSERT_TRUE(testing::Listener::until([&] { return camera.isConnected(); }));
  for (int i = 1; i <= 5; ++i) camera.show(i * 50'000'000);
  ASSERT_TRUE(testing::Listener::until([&] { return camera.left.size() >= 5 && camera.right.size() >= 5; }));
  EXPECT_EQ(camera.left[4].header.stamp, toRosTime(250'000'000));
  EXPECT_EQ(camera.left[4].header.frame_id, "camera");
  EXPECT_EQ(camera.left[4].encoding, "mono8");
  EXPECT_TRUE(testing::Listener::until([&] { return camera.diagnosed("images rectified", "10"); }));
  EXPECT_EQ(camera.left.size(), 5U);
}

TEST(StereoRectifyNodelet, APauseDropsImages) {
  RectifiedCamera camera;
  ASSERT_TRUE(testing::Listener::until([&] { return camera.isConnected(); }));
  ASSERT_TRUE(camera.call("pause"));
  camera.show(1'000'000'000);
  EXPECT_TRUE(testing::Listener::until([&] { return camera.diagnosed("dropped: paused", "4"); }));
  EXPECT_TRUE(camera.left.empty());
  ASSERT_TRUE(camera.call("resume"));
  camera.show(1'050'000'000);
  EXPECT_TRUE(testing::Listener::until([&] { return !camera.left.empty(); }));
  EXPECT_TRUE(camera.call("reset"));
}

}  // namespace
}  // namespace urban_nav_ros

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "urban_nav_ros_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
