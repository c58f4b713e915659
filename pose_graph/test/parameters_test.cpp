// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "pose_graph_ceres/solve_by_ceres.hpp"
#include "pose_graph_relative/relative_pcg.hpp"
#include "support/driven.hpp"
#include "support/gps_drive.hpp"
#include "support/specific_force_drive.hpp"
#include "urban_nav_core/testing/parameter_effects.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"

namespace pose_graph {
namespace {

using testing::kLap;
using Experiment = urban_nav_core::testing::ParameterExperiment<Parameters>;

/// Relaxes; returns the poses and the verdicts of the closures as exact text.
std::string relaxedBytes(PoseGraph& graph) {
  graph.relax({}, {relativeSolver(), ceresSolver()});
  std::string bytes;
  const auto put = [&bytes](const double* numbers, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(double));
  };
  for (const Track& track : graph.tracks())
    for (const Pose& pose : track.map) {
      put(pose.t().data(), 3);
      put(pose.q().coeffs().data(), 4);
    }
  for (const auto& [id, closure] : graph.closures()) {
    bytes += std::to_string(static_cast<int>(closure.verdict));
    put(&closure.weight, 1);
  }
  return bytes;
}

/// Three laps with closures, one of which is false.
std::string threeLaps(const Parameters& parameters) {
  PoseGraph graph(parameters);
  testing::drive(graph, "a", 0, 3 * kLap);
  for (const int i : {10, 35, 60, 85, 110, 160}) graph.addClosure(testing::closureAt("a", i, "a", i + kLap));
  Closure wrong = testing::closureAt("a", 20, "a", 70);
  wrong.measured.T_a_b = Pose(Eigen::Matrix3d::Identity(), Eigen::Vector3d(1.0, 0.5, 0.0));
  graph.addClosure(wrong);
  return relaxedBytes(graph);
}

/// Two laps of uncertain odometry and a single closure that deviates from odometry by `distance` (m) and `turn` (rad).
std::string singleClosure(const Parameters& parameters, double distance, double turn) {
  PoseGraph graph(parameters);
  Pose T_first_last;
  for (int i = 0; i < 2 * kLap; ++i) {
    urban_nav_core::RelativePose step = testing::stepAt(i);
    step.covariance *= 100.0;
    step.drift_covariance *= 100.0;
    T_first_last = T_first_last * step.T_from_to;
    graph.addOdometry("a", step);
  }
  Closure closure = testing::closureAt("a", 0, "a", 2 * kLap);
  closure.odometry_gate = false;
  closure.measured.T_a_b =
      T_first_last * Pose(urban_nav_core::expSo3(Eigen::Vector3d(0.0, 0.0, turn)), Eigen::Vector3d(distance, 0.0, 0.0));
  graph.addClosure(closure);
  return relaxedBytes(graph);
}
std::string farClosure(const Parameters& parameters) { return singleClosure(parameters, 0.6, 0.0); }
std::string turnedClosure(const Parameters& parameters) { return singleClosure(parameters, 0.0, 0.04); }

/// A minute over hills with an accelerometer and odometry whose rotation drifts.
std::string tiltedDrive(const Parameters& parameters) {
  urban_nav_core::testing::Dice dice(3);
  testing::Drive drive;
  drive.frames = 1200;
  drive.noise = 0.01;
  const urban_nav_core::Trajectory truth = drive.trajectory();
  PoseGraph graph(parameters);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    urban_nav_core::RelativePose step = testing::stepAt(0);
    step.from = truth[i - 1].stamp;
    step.to = truth[i].stamp;
    const Pose T_from_to = truth[i - 1].pose.inverse() * truth[i].pose;
    step.T_from_to = Pose(T_from_to.q() * urban_nav_core::expSo3(2e-4 * dice.normals<3>()), T_from_to.t());
    graph.addOdometry("a", step);
  }
  graph.putForces("a", drive.forces(dice));
  return relaxedBytes(graph);
}

/// Ten minutes through streets with satellite navigation.
std::string streets(const Parameters& parameters) {
  testing::GpsDrive drive;
  drive.turn_drift = 0.002;
  drive.slow = 1.0;
  drive.white = 0.3;
  testing::makeDrive(5, 600.0, drive);
  PoseGraph graph(parameters);
  graph.beginSession("a");
  for (const urban_nav_core::RelativePose& step : drive.odometry) graph.addOdometry("a", step);
  graph.putFixes("a", drive.fixes);
  return relaxedBytes(graph);
}

TEST(Parameters, YamlAndReadmeMatchTheTables) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, EachChangesTheMap) {
  const std::vector<Experiment> experiments = {
      {"three laps", threeLaps, {{"solver", "relative_pcg"}, {"solver", "ceres"}, {"robust", false}}},
      {"a closure that is far off", farClosure, {{"confirmation_distance", 0.7}}},
      {"a closure that is turned", turnedClosure, {{"confirmation_angle", 3.0}}},
      {"accelerometer", tiltedDrive, {{"gravity", false}}},
      {"satellites", streets, {{"gps", true}}},
      {"satellites in use", streets, {{"gps_correlation", 20.0}, {"iterations", 1}}, {{"gps", true}}}};
  EXPECT_EQ(urban_nav_core::testing::findParametersWithoutEffect(table(), experiments), "");
}

TEST(NodeletParameters, EachChangesWhatTheNodeletDoes) {
  const std::string nodelet = "test/ros", parameters = nodelet;
  EXPECT_EQ(urban_nav_core::testing::findParametersWithoutEffect(
                nodeletTable(), {},
                {{"map_frame", "NodeletParameters.NameFramesAndSpaceThePath", parameters},
                 {"odom_frame", "NodeletParameters.NameFramesAndSpaceThePath", parameters},
                 {"base_frame", "NodeletParameters.NameFramesAndSpaceThePath", parameters},
                 {"path_spacing", "NodeletParameters.NameFramesAndSpaceThePath", parameters},
                 {"publish_tf", "NodeletParameters.LeaveOutTransformsGroundAndPictures", parameters},
                 {"ground", "NodeletParameters.LeaveOutTransformsGroundAndPictures", parameters},
                 {"visualization_period", "NodeletParameters.LeaveOutTransformsGroundAndPictures", parameters},
                 {"queue_size", "NodeletParameters.LimitTheInputsThatWait", parameters},
                 {"robot", "LivePoseGraphTest.TheIdOfASessionHasRobotAndRecording"},
                 {"recording", "LivePoseGraphTest.TheIdOfASessionHasRobotAndRecording"},
                 {"store", "Store.ContainsInputsAfterOneSecond", nodelet}}),
            "");
}

}  // namespace
}  // namespace pose_graph
