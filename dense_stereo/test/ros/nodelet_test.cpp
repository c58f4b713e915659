// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <stereo_msgs/DisparityImage.h>
#include <urban_nav_msgs/GroundPlane.h>
#include <urban_nav_msgs/StageStatus.h>

#include <cmath>
#include <cstring>

#include "dense_stereo/near_scene.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_ros/testing/stereo_listener.hpp"

namespace dense_stereo::test {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::testing::RenderedSequence;

constexpr double kCameraHeight = 1.2;  // m

RenderedSequence room() {
  using namespace urban_nav_core::testing;
  SequenceOptions options;
  options.camera.fx = options.camera.fy = 260.0;
  options.camera.width = 320;
  options.camera.height = 240;
  options.camera.cx = 159.5;
  options.camera.cy = 119.5;
  options.first_stamp = 1'225'719'873'123'456'789;
  return RenderedSequence(texturedRoom(), loop(3.0, 1.5, kCameraHeight, 25.0), options);
}

/// The robot's camera, and a subscriber to all topics of the nodelet.
class DenseStereoGraph : public urban_nav_ros::testing::StereoListener {
 public:
  DenseStereoGraph() : urban_nav_ros::testing::StereoListener("dense_stereo") {
    keep("stereo/disparity", disparities);
    keep("stereo/points2", points);
    keep("stereo/ground_plane", grounds);
    keep("stereo/obstacles", obstacles);
    keep("dense_stereo/status", statuses);
    connected_ = until([this] { return isConnected(); });
  }
  bool connected() const { return connected_; }

  std::vector<stereo_msgs::DisparityImage> disparities;
  std::vector<sensor_msgs::PointCloud2> points, obstacles;
  std::vector<urban_nav_msgs::GroundPlane> grounds;
  std::vector<urban_nav_msgs::StageStatus> statuses;

 private:
  bool connected_ = false;
};

class DenseStereoNodelet : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(graph.connected());
    graph.place(Pose(urban_nav_ros::opticalInBody().q(), Eigen::Vector3d(0.1, 0.06, kCameraHeight)));
    ASSERT_TRUE(graph.call("reset"));
  }
  StereoCamera camera() { return makeCamera(sequence.options().camera); }
  /// Shows one frame after another, each when all messages of the previous one have been received: no queue overflows.
  bool play(int first, int count) {
    for (int i = first; i < first + count; ++i) {
      const std::size_t wanted = graph.grounds.size() + 1;
      graph.show(sequence.frame(i), camera(), sequence.stamp(i));
      const bool came = DenseStereoGraph::until([&] {
        return graph.grounds.size() >= wanted && graph.disparities.size() >= wanted && graph.points.size() >= wanted &&
               graph.obstacles.size() >= wanted;
      });
      if (!came) return false;
    }
    return true;
  }

  DenseStereoGraph graph;
  RenderedSequence sequence = room();
};

TEST_F(DenseStereoNodelet, PublishesWhatTheCoreComputes) {
  ASSERT_TRUE(play(0, 3));
  NearSceneEstimator estimator(Parameters(), camera());
  const Pose mounting(urban_nav_ros::opticalInBody().q(), Eigen::Vector3d::Zero());
  for (int i = 0; i < 3; ++i) {
    const NearScene& scene =
        estimator.process(sequence.frame(i).pair(), mounting.R().transpose() * Eigen::Vector3d::UnitZ());
    const auto n = static_cast<std::size_t>(i);
    const stereo_msgs::DisparityImage& disparity = graph.disparities[n];
    EXPECT_EQ(urban_nav_ros::toStampNs(disparity.header.stamp), sequence.stamp(i));
    EXPECT_EQ(disparity.header.frame_id, urban_nav_core::frames::kStereoLeft);
    EXPECT_EQ(disparity.image.encoding, "32FC1");
    ASSERT_EQ(disparity.image.data.size(), scene.stereo.image.disparity.size() * sizeof(float));
    EXPECT_EQ(
        std::memcmp(disparity.image.data.data(), scene.stereo.image.disparity.data(), disparity.image.data.size()), 0);
    EXPECT_FLOAT_EQ(disparity.f, static_cast<float>(camera().left.fx));
    EXPECT_FLOAT_EQ(disparity.T, static_cast<float>(camera().baseline));
    EXPECT_EQ(disparity.max_disparity, 63.0F);
    const urban_nav_msgs::GroundPlane& ground = graph.grounds[n];
    ASSERT_EQ(ground.verdict, urban_nav_msgs::GroundPlane::FOUND) << ground.message;
    EXPECT_EQ(ground.height, scene.ground.height);
    EXPECT_EQ(ground.up.y, scene.ground.up.y());
    EXPECT_NEAR(ground.height, kCameraHeight, 0.02);
    EXPECT_EQ(graph.obstacles[n].width, scene.obstacles.size());
  }
}

TEST_F(DenseStereoNodelet, PublishesPointsAsTheDisparitiesAndTheCameraHaveThem) {
  ASSERT_TRUE(play(0, 1));
  const sensor_msgs::PointCloud2& cloud = graph.points.back();
  const stereo_msgs::DisparityImage& disparity = graph.disparities.back();
  ASSERT_EQ(cloud.width, 320U);
  ASSERT_EQ(cloud.height, 240U);
  sensor_msgs::PointCloud2ConstIterator<float> at(cloud, "x");
  std::size_t valid = 0;
  for (std::size_t i = 0; i < 320 * 240; ++i, ++at) {
    float value = 0.0F;
    std::memcpy(&value, disparity.image.data.data() + i * sizeof value, sizeof value);
    ASSERT_EQ(std::isnan(at[2]), value <= 0.0F) << i;
    if (value <= 0.0F) continue;
    ++valid;
    ASSERT_NEAR(at[2], disparity.f * disparity.T / value, 1e-4F * at[2]);
    ASSERT_NEAR(at[0] / at[2], (static_cast<float>(i % 320) - 159.5F) / 260.0F, 1e-4F);
  }
  EXPECT_GT(valid, 320U * 240U / 2);
}

TEST_F(DenseStereoNodelet, ReportsSwappedImagesInItsStatus) {
  ASSERT_TRUE(play(0, 2));
  urban_nav_core::testing::StereoFrame swapped = sequence.frame(2);
  std::swap(swapped.left, swapped.right);
  graph.show(swapped, camera(), sequence.stamp(2));
  EXPECT_TRUE(DenseStereoGraph::until(
      [&] { return !graph.statuses.empty() && graph.statuses.back().reason_name == "swapped"; }));
}

}  // namespace
}  // namespace dense_stereo::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "dense_stereo_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
