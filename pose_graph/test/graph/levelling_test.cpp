// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/map_levels.hpp"

#include "../support/driven.hpp"
#include "../support/specific_force_drive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using testing::closureAt;
using testing::drive;
using testing::kLap;
using testing::kPeriod;

// The robot begins tilted; a map that begins with its session is tilted accordingly.
const Pose kT_level_first(urban_nav_core::expSo3(Eigen::Vector3d(0.1, -0.2, 0.0)), Eigen::Vector3d::Zero());

/// Forces at rest: a lap of 10 m in 5 s changes the axes and the acceleration only a little.
std::vector<SpecificForce> forcesAlong(const Track& track, std::size_t first, std::size_t end,
                                       const std::vector<Pose>& poses) {
  std::vector<SpecificForce> made;
  for (std::size_t i = first; i < end; ++i) {
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
    const double h = 1e-9 * static_cast<double>(kPeriod);
    if (i > 0 && i + 1 < poses.size())
      acceleration = (poses[i + 1].t() - 2.0 * poses[i].t() + poses[i - 1].t()) / (h * h);
    const Eigen::Vector3d up = kT_level_first.R().transpose() * Eigen::Vector3d(0.0, 0.0, 9.81);
    made.push_back({track.stamps[i], poses[i].R().transpose() * (acceleration + up)});
  }
  return made;
}

/// Forces along a track at its odometry poses.
std::vector<SpecificForce> forcesAlong(const Track& track) {
  return forcesAlong(track, 0, track.stamps.size(), track.odom);
}

double computeTilt(const PoseGraph& graph, std::size_t track = 0) {
  // The first pose of the map has the robot's tilt, so its up vector is known.
  const Eigen::Vector3d up =
      graph.tracks()[track].map.front().R() * (kT_level_first.R().transpose() * Eigen::Vector3d::UnitZ());
  return std::acos(std::min(1.0, up.z()));
}

TEST(Levelling, TurnsTheMapAboutItsFirstPoseOnceItIsKnown) {
  PoseGraph graph{Parameters()};
  drive(graph, "a", 0, 20);
  graph.putForces("a", forcesAlong(graph.tracks()[0]));
  EXPECT_FALSE(graph.level()) << "a second is too short";
  EXPECT_FALSE(graph.isLevel("a"));
  EXPECT_EQ(graph.revision(), 0);
  drive(graph, "a", 20, 2 * kLap);
  graph.putForces("a", forcesAlong(graph.tracks()[0]));
  const Pose before = graph.tracks()[0].map.back();
  const auto levelled = graph.level();
  ASSERT_TRUE(levelled);
  EXPECT_TRUE(graph.isLevel("a"));
  EXPECT_LT(computeTilt(graph), 0.01);
  EXPECT_EQ(graph.tracks()[0].map.front().t(), Eigen::Vector3d::Zero().eval());
  ASSERT_TRUE(levelled->correction);
  EXPECT_EQ(levelled->correction->reason, CorrectionReason::Levelled);
  EXPECT_TRUE(levelled->correction->causing_edges.empty());
  EXPECT_TRUE(isApprox(levelled->correction->before, before, 0.0));
  ASSERT_EQ(levelled->moved.size(), 1u);
  EXPECT_EQ(levelled->moved[0].last, 2u * kLap);
  EXPECT_FALSE(graph.level()) << "once";
}

TEST(Levelling, TheBatchLevelsByAllForces) {
  PoseGraph graph{Parameters()}, plain{Parameters()};
  for (PoseGraph* each : {&graph, &plain}) {
    drive(*each, "a", 0, 2 * kLap);
    for (const int i : {10, 60}) each->addClosure(closureAt("a", i, "a", i + kLap));
  }
  graph.putForces("a", forcesAlong(graph.tracks()[0]));
  graph.level();
  graph.update();
  graph.relax();
  plain.relax();
  urban_nav_core::Trajectory flat;
  for (std::size_t i = 0; i < plain.tracks()[0].map.size(); ++i)
    flat.append(plain.tracks()[0].stamps[i], plain.tracks()[0].map[i]);
  const Level level = estimateLevel(flat, forcesAlong(graph.tracks()[0]));
  ASSERT_TRUE(level.known());
  const Pose T_level_map = levelling(level, plain.tracks()[0].map.front());
  for (std::size_t i = 0; i < flat.size(); ++i) {
    EXPECT_EQ(graph.tracks()[0].map[i].t(), (T_level_map * flat[i].pose).t()) << i;
    EXPECT_EQ(graph.tracks()[0].map[i].q().coeffs(), (T_level_map * flat[i].pose).q().coeffs()) << i;
  }
}

TEST(Levelling, ClosuresComeIntoTheLevelMap) {
  PoseGraph graph{Parameters()};
  drive(graph, "a", 0, 2 * kLap);
  graph.putForces("a", forcesAlong(graph.tracks()[0]));
  graph.addClosure(closureAt("a", 10, "a", 10 + kLap));
  graph.update();
  ASSERT_TRUE(graph.level());
  graph.addClosure(closureAt("a", 60, "a", 60 + kLap));
  const Relaxed relaxed = graph.update();
  EXPECT_EQ(relaxed.accepted, 2u);
  EXPECT_LT(computeTilt(graph), 0.02);
  const Pose live = graph.tracks()[0].map.back();
  graph.relax();
  EXPECT_TRUE(isApprox(graph.tracks()[0].map.back(), live, 2e-2));
}

TEST(Levelling, OneSessionLevelsTheMapOfAllThatAreInIt) {
  PoseGraph graph{Parameters()};
  drive(graph, "a", 0, 2 * kLap);
  drive(graph, "b", 0, 2 * kLap);
  graph.putForces("b", forcesAlong(graph.tracks()[1]));
  ASSERT_TRUE(graph.level());
  EXPECT_FALSE(graph.isLevel("a"));
  EXPECT_TRUE(graph.isLevel("b"));
  for (const int i : {10, 60, 110}) graph.addClosure(closureAt("a", i, "b", i));
  EXPECT_EQ(graph.relax().parts, 1);
  EXPECT_TRUE(graph.isLevel("a"));
  EXPECT_LT(computeTilt(graph, 0), 0.02);
  EXPECT_EQ(findMap(graph.tracks(), 1), 0u);
}

TEST(Levelling, TheGroundLevelsAMapOfWhichNoSessionHasForces) {
  PoseGraph graph{Parameters()};
  drive(graph, "a", 0, 2 * kLap);
  std::vector<GroundNormal> ground;
  for (std::size_t i = 0; i < graph.tracks()[0].stamps.size(); i += 4) {
    const Eigen::Vector3d up = kT_level_first.R().transpose() * Eigen::Vector3d::UnitZ();
    ground.push_back({graph.tracks()[0].stamps[i], graph.tracks()[0].odom[i].R().transpose() * up, 1e-3});
  }
  graph.putGround("a", {ground.begin(), ground.begin() + 4});
  EXPECT_FALSE(graph.level()) << "four normals are too few";
  graph.putGround("a", ground);
  EXPECT_EQ(graph.ground(0).size(), ground.size()) << "each once";
  ASSERT_TRUE(graph.level());
  EXPECT_LT(computeTilt(graph), 1e-6);
  EXPECT_TRUE(graph.isLevel("a"));
  graph.relax();
  EXPECT_LT(computeTilt(graph), 1e-6);
  EXPECT_THROW(graph.putGround("b", ground), urban_nav_core::UserError);
}

TEST(Levelling, LaterForcesReplaceEarlierOnes) {
  PoseGraph graph{Parameters()}, whole{Parameters()};
  for (PoseGraph* each : {&graph, &whole}) drive(*each, "a", 0, 2 * kLap);
  const std::vector<SpecificForce> all = forcesAlong(whole.tracks()[0]);
  whole.putForces("a", all);
  std::vector<SpecificForce> early(all.begin(), all.begin() + 120);
  early.back().force.setConstant(900.0);
  graph.putForces("a", early);
  graph.putForces("a", {});
  graph.putForces("a", {all.begin() + 110, all.end()});
  for (PoseGraph* each : {&graph, &whole}) each->relax();
  testing::expectSameMap(graph, whole);
  EXPECT_THROW(graph.putForces("b", all), urban_nav_core::UserError);
}

/// Odometry with rotation drift, and the specific forces along the true path.
struct DriftingDrive {
  testing::Drive drive;
  std::vector<urban_nav_core::RelativePose> steps;
  std::vector<SpecificForce> forces;

  DriftingDrive() {
    urban_nav_core::testing::Dice dice(5);
    drive.frames = 3000;
    drive.noise = 0.01;
    forces = drive.forces(dice);
    const auto truth = drive.trajectory();
    for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
      urban_nav_core::RelativePose step;
      step.from = truth[i].stamp;
      step.to = truth[i + 1].stamp;
      const Pose right = truth[i].pose.inverse() * truth[i + 1].pose;
      step.T_from_to = Pose(right.q() * urban_nav_core::expSo3(2e-4 * dice.normals<3>()), right.t());
      step.covariance = 4e-8 * urban_nav_core::Matrix6d::Identity();
      steps.push_back(step);
    }
  }
  void into(PoseGraph& graph) const {
    for (const auto& step : steps) graph.addOdometry("a", step);
    graph.putForces("a", forces);
  }
  /// Returns the largest tilt of a pose relative to the first one.
  double lost(const PoseGraph& graph) const {
    const auto truth = drive.trajectory();
    const Eigen::Vector3d up = drive.trueUp();
    const std::vector<Pose>& map = graph.tracks()[0].map;
    double most = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      most = std::max(most, (truth[i].pose.R().transpose() * up - map[i].R().transpose() * (map[0].R() * up)).norm());
    return most;
  }
};

TEST(Levelling, TakesTheDriftOfRollAndPitchOutOfOdometry) {
  const DriftingDrive drive;
  Parameters without;
  without.gravity = false;
  PoseGraph graph{Parameters()}, plain{without};
  for (PoseGraph* each : {&graph, &plain}) {
    drive.into(*each);
    each->relax();
  }
  EXPECT_GT(drive.lost(plain), 5e-3);
  EXPECT_LT(drive.lost(graph), 0.3 * drive.lost(plain));
  EXPECT_TRUE(isApprox(graph.tracks()[0].odom.back(), plain.tracks()[0].odom.back(), 0.0)) << "odometry is what it was";
}

TEST(Levelling, ABatchLeavesNoTraceInTheNextOne) {
  const DriftingDrive drive;
  PoseGraph graph{Parameters()}, once{Parameters()};
  for (PoseGraph* each : {&graph, &once}) {
    drive.into(*each);
    each->relax();
  }
  graph.relax();
  testing::expectSameMap(graph, once);
}

TEST(Levelling, AnUpdateGoesOnFromTheLevelledSteps) {
  const DriftingDrive drive;
  PoseGraph graph{Parameters()};
  drive.into(graph);
  graph.relax();
  Closure closure = closureAt("a", 300, "a", 2700);
  closure.measured.T_a_b = graph.tracks()[0].map[300].inverse() * graph.tracks()[0].map[2700];
  graph.addClosure(closure);
  const double lost = drive.lost(graph);
  graph.update();
  EXPECT_EQ(graph.closures().begin()->second.verdict, ClosureVerdict::Accepted);
  EXPECT_LT(drive.lost(graph), 1.1 * lost) << "it agrees with how the poses lie";
}

}  // namespace
}  // namespace pose_graph
