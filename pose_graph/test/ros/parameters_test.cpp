// SPDX-License-Identifier: BSD-3-Clause
// Two further nodelets of nodelet.test, each with its own parameters.
#include <gtest/gtest.h>
#include <urban_nav_msgs/GetTrajectory.h>

#include "listener.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::expSo3;
using urban_nav_core::Pose;

urban_nav_core::StampNs poseStamp(int pose) { return 1'225'800'000'000'000'000 + pose * 100'000'000LL; }

/// A step of 1 m along a curve.
Pose curveStep() { return Pose(expSo3(Eigen::Vector3d(0.0, 0.0, 0.15)), Eigen::Vector3d(1.0, 0.0, 0.0)); }

/// Inputs and outputs of a nodelet in a namespace.
class NamedNodelet : public urban_nav_ros::testing::Listener {
 public:
  explicit NamedNodelet(const std::string& name) : Listener(name + "/pose_graph"), receipts_(name + "/pose_graph") {
    keep(name + "/graph/path", paths);
    keep("/tf", transforms);
    steps_ = advertise<urban_nav_msgs::RelativePose>(name + "/odometry/relative_pose");
    odometry_ = advertise<nav_msgs::Odometry>(name + "/odometry");
  }

  void drive(int from, int to) {
    for (int i = from; i < to; ++i) {
      urban_nav_core::RelativePose step;
      step.from = poseStamp(i);
      step.to = poseStamp(i + 1);
      step.T_from_to = curveStep();
      step.covariance = 1e-4 * urban_nav_core::Matrix6d::Identity();
      step.source = "swf_vo";
      steps_.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link"));
    }
  }
  void sendOdometry(int pose) {
    nav_msgs::Odometry message;
    message.header.stamp = urban_nav_ros::toRosTime(poseStamp(pose));
    message.pose.pose = urban_nav_ros::toPoseMessage(Pose());
    odometry_.publish(message);
  }
  /// Returns the child frame of a transform with parent `map_frame`; empty if none was received.
  std::string findChild(const std::string& map_frame) const {
    for (const tf2_msgs::TFMessage& message : transforms)
      for (const auto& transform : message.transforms)
        if (transform.header.frame_id == map_frame) return transform.child_frame_id;
    return "";
  }

  const urban_nav_ros::testing::Receipts& receipts() const { return receipts_; }

  std::vector<nav_msgs::Path> paths;
  std::vector<tf2_msgs::TFMessage> transforms;

 private:
  const urban_nav_ros::testing::Receipts receipts_;
  ros::Publisher steps_, odometry_;
};

/// The nodelet under /renamed: other frames, and a path with a pose every five metres.
class RenamedNodelet : public NamedNodelet {
 public:
  RenamedNodelet() : NamedNodelet("renamed") {
    ground_ = advertise<urban_nav_msgs::GroundPlane>("renamed/stereo/ground_plane");
    static_transforms_ = advertise<tf2_msgs::TFMessage>("/tf_static", true);
  }

  /// Publishes a camera pitched down by 0.3 rad in the frame `body`. Returns whether the nodelet has received it.
  bool describeCamera() {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(urban_nav_ros::toStaticTransform("body", "body_camera", camera_));
    return receipts().await({{"/tf_static", 1}}, [&] { static_transforms_.publish(message); });
  }
  /// Publishes level ground normals, with `up` in the axes of the first pose.
  void seeGround(int poses, const Eigen::Vector3d& up) {
    Pose T_first_body;
    for (int i = 0; i <= poses; ++i, T_first_body = T_first_body * curveStep()) {
      const Eigen::Vector3d up_camera = camera_.R().transpose() * T_first_body.R().transpose() * up;
      urban_nav_msgs::GroundPlane plane;
      plane.header.stamp = urban_nav_ros::toRosTime(poseStamp(i));
      plane.header.frame_id = "body_camera";
      plane.up.x = up_camera.x();
      plane.up.y = up_camera.y();
      plane.up.z = up_camera.z();
      plane.support = 1.0;
      ground_.publish(plane);
    }
  }

 private:
  const Pose camera_ =
      Pose(expSo3(Eigen::Vector3d(0.0, 0.3, 0.0)), Eigen::Vector3d::Zero()) * urban_nav_ros::opticalInBody();
  ros::Publisher ground_, static_transforms_;
};

/// Returns the path length in a nodelet's graph; a missing step counts as zero.
double pathMetres(const std::string& name) {
  urban_nav_msgs::GetTrajectory call;
  EXPECT_TRUE(ros::service::call(name + "/pose_graph/get_trajectory", call));
  double metres = 0.0;
  for (const auto& run : call.response.segments)
    for (std::size_t i = 1; i < run.T_map_base.size(); ++i)
      metres +=
          distanceBetween(*urban_nav_ros::toPose(run.T_map_base[i - 1]), *urban_nav_ros::toPose(run.T_map_base[i]));
  return metres;
}

TEST(NodeletParameters, NameFramesAndSpaceThePath) {
  constexpr int kPoses = 80;
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();
  RenamedNodelet nodelet;
  ASSERT_TRUE(nodelet.until([&] { return nodelet.isConnected(); }));
  // There is no order between topics.
  ASSERT_TRUE(nodelet.describeCamera());
  ASSERT_TRUE(
      nodelet.receipts().await({{"renamed/stereo/ground_plane", kPoses + 1}}, [&] { nodelet.seeGround(kPoses, up); }));
  nodelet.drive(0, kPoses);
  const auto isLevel = [&] {
    if (nodelet.paths.empty() || nodelet.paths.back().poses.empty()) return false;
    const Pose first = *urban_nav_ros::toPose(nodelet.paths.back().poses.front().pose);
    return (first.R() * up - Eigen::Vector3d::UnitZ()).norm() < 0.01;
  };
  EXPECT_TRUE(nodelet.until(isLevel)) << "by base_frame and the static tf of the camera";
  nodelet.sendOdometry(0);
  EXPECT_TRUE(nodelet.until([&] { return nodelet.findChild("world") == "wheels"; }));
  const auto isWhole = [&] {
    return nodelet.paths.back().poses.back().header.stamp == urban_nav_ros::toRosTime(poseStamp(kPoses));
  };
  ASSERT_TRUE(!nodelet.paths.empty() && nodelet.until(isWhole));
  const nav_msgs::Path& path = nodelet.paths.back();
  EXPECT_EQ(path.header.frame_id, "world");
  EXPECT_GT(path.poses.size(), 10U);
  EXPECT_LT(path.poses.size(), 22U) << "one each five metres, and the last";
}

TEST(NodeletParameters, LeaveOutTransformsGroundAndPictures) {
  NamedNodelet nodelet("quiet");
  ASSERT_TRUE(nodelet.until([&] { return nodelet.isConnected(); }));
  ros::Publisher ground = ros::NodeHandle().advertise<urban_nav_msgs::GroundPlane>("quiet/stereo/ground_plane", 1);
  nodelet.drive(0, 1);
  ASSERT_TRUE(nodelet.until([&] { return !nodelet.paths.empty(); }));
  for (int i = 1; i < 25; ++i) {  // longer than the default period of one second between path messages
    nodelet.drive(i, i + 1);
    nodelet.sendOdometry(i);
    ros::WallDuration(0.1).sleep();
    ros::spinOnce();
  }
  EXPECT_EQ(nodelet.paths.size(), 1U) << "one an hour";
  EXPECT_EQ(ground.getNumSubscribers(), 0U);
  EXPECT_EQ(nodelet.findChild("quiet_map"), "");
}

TEST(NodeletParameters, LimitTheInputsThatWait) {
  constexpr int kSteps = 900;
  NamedNodelet all("renamed"), few("quiet");
  ASSERT_TRUE(all.until([&] { return all.isConnected() && few.isConnected(); }));
  ASSERT_TRUE(all.call("reset"));
  ASSERT_TRUE(few.call("reset"));
  all.drive(0, kSteps);
  EXPECT_TRUE(few.receipts().await({{"quiet/odometry/relative_pose", kSteps}}, [&] { few.drive(0, kSteps); }));
  EXPECT_TRUE(all.until([&] { return pathMetres("renamed") > kSteps - 0.5; }));
  EXPECT_TRUE(few.until([&] { return pathMetres("quiet") > 0.5; }));
  EXPECT_LT(pathMetres("quiet"), kSteps - 0.5) << "the oldest of more than two that wait are dropped";
}

}  // namespace
}  // namespace pose_graph::test
