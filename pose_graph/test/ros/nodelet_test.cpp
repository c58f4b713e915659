// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <urban_nav_msgs/AddEdge.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/GetTrajectory.h>
#include <urban_nav_msgs/NewSession.h>
#include <urban_nav_msgs/RemoveEdge.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "listener.hpp"
#include "urban_nav_core/geometry/geodetic.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_store/store.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector6d;

constexpr StampNs kStart = 1'225'719'873'000'000'000, kPeriod = 100'000'000;
constexpr int kLap = 40;  // poses of a lap

StampNs toStamp(int i) { return kStart + i * kPeriod; }

Pose turned(double yaw, double x) {
  return Pose(urban_nav_core::expSo3(Eigen::Vector3d(0, 0, yaw)), Eigen::Vector3d(x, 0, 0));
}
// A circle with steps of 1 m; odometry underestimates each rotation and overestimates each length.
Pose measuredStep() { return turned(2.0 * M_PI / kLap - 0.004, 1.01); }
Pose odomPose(int i) {
  Pose T;
  for (int k = 0; k < i; ++k) T = T * measuredStep();
  return T;
}

urban_nav_core::MetricClosure toClosure(int a, int b, const Pose& T_a_b) {
  urban_nav_core::MetricClosure closure;
  closure.a = {"", toStamp(a)};
  closure.b = {"", toStamp(b)};
  closure.measured.T_a_b = T_a_b;
  closure.measured.information = (Vector6d() << 1e4, 1e4, 1e4, 1e6, 1e6, 1e6).finished().asDiagonal();
  closure.probability = 0.999;
  closure.method = urban_nav_core::ClosureMethod::Stereo;
  closure.odometry_gate = true;
  closure.verdict = urban_nav_core::ClosureVerdict::Accepted;
  closure.source = "loop_metric";
  return closure;
}

class PoseGraphNodelet : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { listener_ = new Listener; }
  static void TearDownTestSuite() { delete listener_; }
  void SetUp() override {
    ASSERT_TRUE(listener().connected());
    ASSERT_TRUE(listener().call("reset"));
    listener().forgetAll();  // messages caused by the previous test arrive first
  }
  Listener& listener() { return *listener_; }

  void drive(int from, int to, double rotation_variance = 1e-4) {
    for (int i = from; i < to; ++i) {
      urban_nav_core::RelativePose step;
      step.from = toStamp(i);
      step.to = toStamp(i + 1);
      step.T_from_to = measuredStep();
      step.covariance.setZero();
      step.covariance.diagonal() << Eigen::Vector3d::Constant(1e-3), Eigen::Vector3d::Constant(rotation_variance);
      step.source = "swf_vo";
      listener().relative.publish(urban_nav_ros::toRelativePoseMessage(step, "base_link"));
    }
  }
  /// Publishes a closure. Returns once the nodelet has received it.
  void close(const urban_nav_core::MetricClosure& closure) {
    EXPECT_TRUE(listener().receipts.await({{"loops/metric", 1}}, [&] {
      listener().closures.publish(urban_nav_ros::toMetricClosureMessage(closure, "base_link", 1.0));
    }));
  }
  /// Returns the poses of the graph, by its service.
  urban_nav_msgs::GetTrajectory::Response trajectory(std::uint64_t since = 0, int from = -1, int to = -1) {
    urban_nav_msgs::GetTrajectory call;
    call.request.revision = since;
    if (from >= 0) call.request.from_stamp = urban_nav_ros::toRosTime(toStamp(from));
    if (to >= 0) call.request.to_stamp = urban_nav_ros::toRosTime(toStamp(to));
    EXPECT_TRUE(ros::service::call("pose_graph/get_trajectory", call));
    return call.response;
  }
  std::size_t poses(std::uint64_t since = 0) {
    std::size_t count = 0;
    for (const auto& run : trajectory(since).segments) count += run.stamps.size();
    return count;
  }
  bool driven(int count) {
    return Listener::until([&] { return poses() == static_cast<std::size_t>(count); });
  }
  void receive(int at, const Pose& T_odom_base) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = urban_nav_ros::toRosTime(toStamp(at));
    odometry.header.frame_id = "odom";
    odometry.pose.pose = urban_nav_ros::toPoseMessage(T_odom_base);
    listener().odometry.publish(odometry);
  }
  /// Returns map -> odom as published with an odometry message.
  Pose mapFromOdom(int at) {
    listener().transforms.clear();
    receive(at, odomPose(at));
    if (!Listener::until([&] { return !listener().transforms.empty(); })) {
      ADD_FAILURE() << "no map -> odom";
      return {};
    }
    const auto& transform = listener().transforms.back().transforms.back();
    EXPECT_EQ(transform.header.frame_id, "map");
    EXPECT_EQ(transform.child_frame_id, "odom");
    EXPECT_EQ(transform.header.stamp, urban_nav_ros::toRosTime(toStamp(at)));
    return *urban_nav_ros::toPose(transform.transform);
  }

  static Listener* listener_;
};
Listener* PoseGraphNodelet::listener_ = nullptr;

/// Without a camera pose in /tf_static the camera is assumed at base_link.
TEST_F(PoseGraphNodelet, TheGroundLevelsTheMapWithoutAnAccelerometer) {
  constexpr int kPoses = 80;
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, 0.0, 1.0).normalized();
  const auto publish = [&](int i) {
    const Eigen::Vector3d up_camera = urban_nav_ros::opticalInBody().R().transpose() * odomPose(i).R().transpose() * up;
    urban_nav_msgs::GroundPlane plane;
    plane.header.stamp = urban_nav_ros::toRosTime(toStamp(i));
    plane.header.frame_id = "camera";
    plane.up.x = up_camera.x();
    plane.up.y = up_camera.y();
    plane.up.z = up_camera.z();
    plane.support = 1.0;
    listener().ground.publish(plane);
  };
  ASSERT_TRUE(listener().receipts.await({{"stereo/ground_plane", 1}}, [&] { publish(0); }));
  ros::WallDuration(2.0).sleep();  // twice as long as the nodelet waits for the camera's pose
  ASSERT_TRUE(listener().receipts.await({{"stereo/ground_plane", kPoses}}, [&] {
    for (int i = 1; i <= kPoses; ++i) publish(i);
  })) << "before the poses: topics have no order among each other";
  drive(0, kPoses);
  const auto isLevelled = [](const auto& correction) { return correction.reason_name == "Levelled"; };
  EXPECT_TRUE(Listener::until(
      [&] { return std::any_of(listener().corrections.begin(), listener().corrections.end(), isLevelled); }));
  const auto runs = trajectory().segments;
  ASSERT_FALSE(runs.empty());
  const Pose first = *urban_nav_ros::toPose(runs[0].T_map_base[0]);
  EXPECT_LT((first.R() * up - Eigen::Vector3d::UnitZ()).norm(), 0.01);
}

TEST_F(PoseGraphNodelet, AClosureBringsTheRobotHome) {
  drive(0, kLap);
  ASSERT_TRUE(driven(kLap + 1));
  EXPECT_TRUE(isApprox(mapFromOdom(kLap), Pose(), 1e-12)) << "nothing says otherwise yet";
  EXPECT_GT(odomPose(kLap).t().norm(), 0.5) << "odometry has drifted";

  close(toClosure(0, kLap, Pose()));
  ASSERT_TRUE(Listener::until([&] { return !listener().updates.empty() && !listener().states.empty(); }));
  const auto update = urban_nav_ros::toGraphUpdate(listener().updates.front());
  const auto state = listener().states.front();
  ASSERT_TRUE(update);
  EXPECT_EQ(update->revision, static_cast<std::int64_t>(state.revision));
  EXPECT_EQ(listener().updates.back().header.frame_id, "map");
  ASSERT_FALSE(update->segments.empty());
  EXPECT_EQ(update->segments.back().poses.back().stamp, toStamp(kLap));
  EXPECT_LT(update->segments.back().poses.back().T_map_base.t().norm(), 0.1);
  ASSERT_TRUE(Listener::until([&] { return (mapFromOdom(kLap) * odomPose(kLap)).t().norm() < 0.1; }));

  EXPECT_EQ(state.poses, static_cast<std::uint64_t>(kLap + 1));
  EXPECT_EQ(state.closures, 1U);
  EXPECT_EQ(state.closures_rejected, 0U);
  EXPECT_LT(state.cost_after, state.cost_before);
  EXPECT_GT(state.relax_ms, 0.0);
  ASSERT_TRUE(Listener::until([&] { return !listener().corrections.empty(); }));
  EXPECT_NEAR(listener().corrections.back().distance, odomPose(kLap).t().norm(), 0.2);
  ASSERT_EQ(listener().corrections.back().causing_edges.size(), 1U);
  EXPECT_EQ(listener().corrections.back().causing_edges[0].source, "loop_metric");
  EXPECT_EQ(listener().corrections.back().reason, 1);
  EXPECT_EQ(listener().corrections.back().reason_name, "ClosuresAccepted");
  EXPECT_EQ(listener().corrections.back().message, "a closure is newly accepted");
}

TEST_F(PoseGraphNodelet, PositionsOfSatellitesBringTheRobotHome) {
  constexpr int kLast = 8 * kLap, kAgain = 7 * kLap;  // fixes of 30 s are used in one batch
  const urban_nav_core::LocalTangent tangent({0.9, -0.02, 120.0});
  const Pose T_east_map(urban_nav_core::expSo3(Eigen::Vector3d(0, 0, 0.7)), Eigen::Vector3d(30.0, -8.0, 1.0));
  drive(0, kLast, 1e-2);
  ASSERT_TRUE(driven(kLast + 1));
  Pose T_map_base;
  for (int i = 0; i <= kLast; ++i, T_map_base = T_map_base * turned(2.0 * M_PI / kLap, 1.0)) {
    if (i % 5 != 0) continue;  // more fixes than wait for the antenna's pose, which is not in /tf_static
    const urban_nav_core::Geodetic position = tangent.toGeodetic((T_east_map * T_map_base).t());
    sensor_msgs::NavSatFix fix;
    fix.header.stamp = urban_nav_ros::toRosTime(toStamp(i));
    fix.header.frame_id = "gps";
    fix.latitude = position.latitude * 180.0 / M_PI;
    fix.longitude = position.longitude * 180.0 / M_PI;
    fix.altitude = position.height;
    fix.position_covariance = {4e-4, 0, 0, 0, 4e-4, 0, 0, 0, 1e-3};
    fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
    listener().fixes.publish(fix);
  }
  EXPECT_GT(odomPose(kAgain).t().norm(), 5.0) << "odometry has drifted";
  const auto apart = [&] {
    const auto run = trajectory().segments.at(0);
    return distanceBetween(*urban_nav_ros::toPose(run.T_map_base.front()),
                           *urban_nav_ros::toPose(run.T_map_base.at(kAgain)));
  };
  EXPECT_TRUE(Listener::until([&] { return apart() < 1.0; })) << apart() << " m between equal places";
}

TEST_F(PoseGraphNodelet, AClosureThatIsAheadOfOdometryWaitsForIt) {
  drive(0, 10);
  ASSERT_TRUE(driven(11));
  close(toClosure(0, kLap, Pose()));
  ros::WallDuration(0.3).sleep();
  ros::spinOnce();
  EXPECT_TRUE(listener().updates.empty());
  drive(10, kLap);
  ASSERT_TRUE(Listener::until([&] { return !listener().updates.empty(); }));
  EXPECT_LT(listener().updates.back().segments.back().T_map_base.back().position.x, 0.1);
}

TEST_F(PoseGraphNodelet, ARejectedClosureIsNone) {
  drive(0, kLap);
  auto rejected = toClosure(0, kLap, Pose());
  rejected.verdict = urban_nav_core::ClosureVerdict::Rejected;
  close(rejected);
  ASSERT_TRUE(driven(kLap + 1));
  ASSERT_EQ(poses(), static_cast<std::size_t>(kLap + 1)) << "asked after the closure has been received";
  ros::WallDuration(0.3).sleep();
  ros::spinOnce();
  EXPECT_TRUE(listener().updates.empty());
}

TEST_F(PoseGraphNodelet, GivesTheTrajectoryOrWhatChangedOfIt) {
  drive(0, kLap);
  ASSERT_TRUE(driven(kLap + 1));
  const auto before = trajectory();
  ASSERT_EQ(before.segments.size(), 1U);
  EXPECT_EQ(before.segments[0].stamps.front(), urban_nav_ros::toRosTime(kStart));
  EXPECT_EQ(before.segments[0].session.size(), 20U);
  const auto part = trajectory(0, 5, 9);
  ASSERT_EQ(part.segments.size(), 1U);
  EXPECT_EQ(part.segments[0].stamps.size(), 5U);

  close(toClosure(0, kLap, Pose()));
  ASSERT_TRUE(Listener::until([&] { return !listener().updates.empty(); }));
  const std::uint64_t now = trajectory().revision;
  EXPECT_GT(now, before.revision);
  EXPECT_EQ(poses(now), 0U) << "nothing moved since";
  drive(kLap, kLap + 3);
  ASSERT_TRUE(driven(kLap + 4));
  EXPECT_EQ(poses(now), 3U) << "new poses are new";
}

TEST_F(PoseGraphNodelet, EdgesAreAddedAndRemovedByHand) {
  drive(0, kLap);
  ASSERT_TRUE(driven(kLap + 1));
  urban_nav_msgs::AddEdge add;
  add.request.a.stamp = urban_nav_ros::toRosTime(toStamp(0));
  add.request.b.stamp = urban_nav_ros::toRosTime(toStamp(kLap));
  add.request.T_a_b = urban_nav_ros::toPoseMessage(Pose());
  add.request.information =
      urban_nav_ros::toArray36((Vector6d() << 1e4, 1e4, 1e4, 1e6, 1e6, 1e6).finished().asDiagonal());
  add.request.kind = "asserted";
  ASSERT_TRUE(ros::service::call("pose_graph/add_edge", add));
  EXPECT_TRUE(add.response.success) << add.response.message;
  EXPECT_TRUE(add.response.contradicting.empty());
  ASSERT_TRUE(Listener::until([&] { return (mapFromOdom(kLap) * odomPose(kLap)).t().norm() < 0.1; }));

  urban_nav_msgs::RemoveEdge remove;
  remove.request.edge.a = add.request.a;
  remove.request.edge.b = add.request.b;
  remove.request.edge.kind = "icp";
  ASSERT_TRUE(ros::service::call("pose_graph/remove_edge", remove));
  EXPECT_FALSE(remove.response.success);
  EXPECT_NE(remove.response.message.find("asserted of operator"), std::string::npos) << remove.response.message;
  remove.request.edge.kind.clear();
  ASSERT_TRUE(ros::service::call("pose_graph/remove_edge", remove));
  EXPECT_TRUE(remove.response.success) << remove.response.message;
  EXPECT_TRUE(Listener::until([&] { return (mapFromOdom(kLap) * odomPose(kLap)).t().norm() > 0.5; }));
}

TEST_F(PoseGraphNodelet, AnEdgeThatCannotBeIsRefusedWithTheReason) {
  drive(0, 5);
  ASSERT_TRUE(driven(6));
  urban_nav_msgs::AddEdge add;
  add.request.a.stamp = urban_nav_ros::toRosTime(toStamp(0));
  add.request.b.stamp = urban_nav_ros::toRosTime(toStamp(3) + 7);
  add.request.T_a_b.orientation.w = 1.0;
  add.request.kind = "asserted";
  ASSERT_TRUE(ros::service::call("pose_graph/add_edge", add));
  EXPECT_FALSE(add.response.success);
  EXPECT_NE(add.response.message.find("nearest"), std::string::npos) << add.response.message;
  add.request.b.stamp = urban_nav_ros::toRosTime(toStamp(3));
  add.request.kind = "guess";
  ASSERT_TRUE(ros::service::call("pose_graph/add_edge", add));
  EXPECT_NE(add.response.message.find("asserted, stereo, icp, plane"), std::string::npos) << add.response.message;
  add.request.kind = "asserted";
  add.request.information[3] = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(ros::service::call("pose_graph/add_edge", add));
  EXPECT_FALSE(add.response.success);
}

TEST_F(PoseGraphNodelet, ShowsPathAndClosures) {
  drive(0, kLap);
  close(toClosure(0, kLap, Pose()));
  ASSERT_TRUE(Listener::until([&] {
    return !listener().paths.empty() && listener().paths.back().poses.size() > kLap / 2 &&
           !listener().markers.empty() && listener().markers.back().markers.size() >= 3;
  }));
  EXPECT_EQ(listener().paths.back().header.frame_id, "map");
  const auto& picture = listener().markers.back().markers;
  EXPECT_EQ(picture[1].ns, "stereo");
  EXPECT_EQ(picture[1].points.size(), 2U);
  EXPECT_EQ(picture.back().ns, "trajectory");
}

TEST_F(PoseGraphNodelet, ANewSessionHasItsOwnIdAndTimeGoingBackBeginsOne) {
  drive(0, 5);
  ASSERT_TRUE(driven(6));
  urban_nav_msgs::NewSession begin;
  begin.request.name = "afternoon";
  ASSERT_TRUE(ros::service::call("pose_graph/new_session", begin));
  EXPECT_TRUE(begin.response.success) << begin.response.message;
  drive(100, 103);
  ASSERT_TRUE(driven(6 + 4));
  const auto two = trajectory();
  ASSERT_EQ(two.segments.size(), 2U);
  EXPECT_NE(two.segments[0].session, two.segments[1].session);
  EXPECT_EQ(two.segments[1].session, begin.response.session);
  drive(0, 2);  // the bag is played again
  ASSERT_TRUE(driven(6 + 4 + 3));
  EXPECT_EQ(trajectory().segments.size(), 3U);
}

TEST_F(PoseGraphNodelet, MapToOdomTakesTheRobotToItsPoseIfTheSessionBeginsLater) {
  for (int i = 0; i <= 20; ++i) receive(i, odomPose(i));
  drive(0, 10);
  ASSERT_TRUE(driven(11));
  urban_nav_msgs::NewSession begin;
  ASSERT_TRUE(ros::service::call("pose_graph/new_session", begin));
  drive(10, 15);
  ASSERT_TRUE(driven(11 + 6));
  const Pose newest = *urban_nav_ros::toPose(trajectory().segments.back().T_map_base.back());
  EXPECT_LT(distanceBetween(newest, odomPose(15)), 20.0);
  EXPECT_GT(distanceBetween(newest, odomPose(15)), 1.0) << "the map is that of the session";
  EXPECT_TRUE(Listener::until([&] { return isApprox(mapFromOdom(21) * odomPose(15), newest, 1e-9); }));
}

TEST_F(PoseGraphNodelet, MapToOdomTakesTheRobotToItsPoseWhenTheNodeletIsStartedInTheMiddle) {
  for (int i = 0; i <= 20; ++i) receive(i, odomPose(i));
  drive(0, 18);
  ASSERT_TRUE(driven(19));
  ASSERT_EQ(std::system("rosnode kill /pose_graph > /dev/null 2>&1"), 0);
  ASSERT_TRUE(Listener::until([&] { return listener().relative.getNumSubscribers() == 0; }));
  ASSERT_TRUE(Listener::until(
      [&] { return listener().isConnected() && ros::service::exists("pose_graph/get_trajectory", false); }));
  listener().forget();
  const auto reaches = [&](int pose) {
    const auto runs = trajectory().segments;  // empty until the store has been read
    return !runs.empty() && runs.back().stamps.back() == urban_nav_ros::toRosTime(toStamp(pose));
  };
  ASSERT_TRUE(listener().receipts.await({{"odometry", 6}}, [&] {
    for (int i = 30; i <= 35; ++i) receive(i, odomPose(i));
  }));
  drive(25, 29);  // data in between are lost, and so is their odometry
  ASSERT_TRUE(Listener::until([&] { return reaches(29); }));
  ros::WallDuration(0.3).sleep();
  ros::spinOnce();
  EXPECT_TRUE(listener().transforms.empty()) << "nothing is published that is not known";
  drive(29, 33);
  ASSERT_TRUE(Listener::until([&] { return reaches(33); }));
  const Pose newest = *urban_nav_ros::toPose(trajectory().segments.back().T_map_base.back());
  ASSERT_TRUE(Listener::until([&] { return !listener().transforms.empty(); }));
  EXPECT_GE(listener().transforms.back().transforms.size(), 6U) << "of the odometry that waited, too";
  EXPECT_TRUE(Listener::until([&] { return isApprox(mapFromOdom(36) * odomPose(33), newest, 1e-9); }));
}

TEST_F(PoseGraphNodelet, PauseDropsInputsAndDiagnosticsCountWhatIsWrong) {
  drive(0, 5);
  ASSERT_TRUE(driven(6));
  ASSERT_TRUE(listener().call("pause"));
  drive(5, 8);
  EXPECT_TRUE(Listener::until([&] { return listener().diagnosed("dropped: paused", "3"); }));
  EXPECT_EQ(poses(), 6U);
  ASSERT_TRUE(listener().call("resume"));
  auto damaged = urban_nav_ros::toMetricClosureMessage(toClosure(0, 3, Pose()), "base_link", 1.0);
  damaged.T_a_b.position.x = std::numeric_limits<double>::quiet_NaN();
  listener().closures.publish(damaged);
  EXPECT_TRUE(Listener::until([&] { return listener().diagnosed("messages damaged", "1"); }));
}

/// The nodelet keeps its graph in a file named by the launch file.
class Store : public PoseGraphNodelet {
 protected:
  static std::string path() {
    std::string path;
    EXPECT_TRUE(ros::param::get("pose_graph/store", path));
    return path;
  }
  static void TearDownTestSuite() {
    PoseGraphNodelet::TearDownTestSuite();
    for (const char* suffix : {"", "-wal", "-shm", "-lock"}) std::filesystem::remove(path() + suffix);
    std::filesystem::remove(path() + ".saved");
  }
  static urban_nav_msgs::FileCommand::Response command(const std::string& service, const std::string& path) {
    urban_nav_msgs::FileCommand call;
    call.request.path = path;
    EXPECT_TRUE(ros::service::call("pose_graph/" + service, call));
    return call.response;
  }
  /// Returns the number of published diagnostics: one per second, fewer on a slow machine.
  std::size_t countDiagnostics() {
    std::size_t count = 0;
    for (const auto& array : listener().diagnostics)
      for (const auto& status : array.status) count += status.name.find("pose_graph: map") <= 1 ? 1 : 0;
    return count;
  }
  /// Returns the number of nodes of the last session, as read by another process during writing.
  static std::int64_t storedNodes() {
    urban_nav_store::Store store(path(), urban_nav_store::Access::Read);
    std::int64_t nodes = 0;
    for (const auto& session : store.sessions().all())
      if (!session.complete) nodes = store.graph().nodes(session.id);
    return nodes;
  }
};

TEST_F(Store, ContainsInputsAfterOneSecond) {
  drive(0, kLap);
  ASSERT_TRUE(driven(kLap + 1));
  listener().forget();
  ASSERT_TRUE(Listener::until([&] { return storedNodes() == kLap + 1; }));
  EXPECT_LE(countDiagnostics(), 4U) << "a second, on a machine with nothing else to do";
  EXPECT_TRUE(Listener::until([&] { return listener().diagnosed("store", path()); }));
}

TEST_F(Store, SavesTheGraphAndGoesOnFromIt) {
  drive(0, kLap);
  close(toClosure(0, kLap, Pose()));
  ASSERT_TRUE(Listener::until([&] { return !listener().updates.empty(); }));
  const auto saved = command("save", path() + ".saved");
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_FALSE(command("save", "relative.db").success);
  EXPECT_FALSE(command("save", "/no/such/folder.db").success);
  ASSERT_TRUE(listener().call("reset"));
  ASSERT_EQ(poses(), 0U);
  const auto loaded = command("load", path() + ".saved");
  EXPECT_TRUE(loaded.success) << loaded.message;
  EXPECT_NE(loaded.message.find(" closures are in the graph"), std::string::npos) << loaded.message;
  EXPECT_GE(poses(), static_cast<std::size_t>(kLap + 1));
  const auto refused = command("load", "/nothing.db");
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("/nothing.db"), std::string::npos) << refused.message;
}

TEST_F(PoseGraphNodelet, OptimizesFromTheEdgesAndTheStatusWaitsForLateSubscribers) {
  drive(0, kLap);
  close(toClosure(0, kLap, Pose()));
  ASSERT_TRUE(Listener::until([&] { return !listener().states.empty(); }));
  const std::uint64_t before = listener().states.back().revision;
  std_srvs::Trigger optimize;
  ASSERT_TRUE(ros::service::call("pose_graph/optimize", optimize) && optimize.response.success)
      << optimize.response.message;
  EXPECT_NE(optimize.response.message.find(std::to_string(kLap + 1) + " poses, 1 closures"), std::string::npos)
      << "it has ended: " << optimize.response.message;
  ASSERT_TRUE(Listener::until([&] { return listener().states.back().revision > before; }));
  const auto status = ros::topic::waitForMessage<urban_nav_msgs::StageStatus>("pose_graph/status", ros::Duration(60.0));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->stage, "pose_graph");
}

}  // namespace
}  // namespace pose_graph::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "pose_graph_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
