// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "map/output_folder.hpp"
#include "map/trajectory_files.hpp"
#include "support/circle_drive.hpp"
#include "topics/graph/graph_g2o.hpp"
#include "topics/graph/graph_trajectories.hpp"
#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using Eigen::Vector3d;
using testing::closure;
using testing::driveCircle;
using testing::kStep;
using testing::truthAt;
using urban_nav_core::expSo3;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

/// Writes the files of a run that relaxes.
void writeFiles(const OutputFolder& folder, const GraphRun& graph, const std::vector<const SessionOdometry*>& runs) {
  const std::vector<SessionTrajectory> trajectories = relaxedTrajectories(graph, odometryTrajectories(runs));
  for (const OutputFile& file : trajectoryFiles(runs, trajectories))
    file.content ? folder.write(file.name, file.content()) : folder.remove(file.name);
  folder.write("graph.g2o", graphG2o(graph));
  folder.write("closures.csv", printClosureRows(graph.closures, graph.assessments));
}

double worstError(const urban_nav_core::Trajectory& trajectory, const Pose& T_truth_map) {
  double worst = 0.0;
  for (const auto& pose : trajectory)
    worst = std::max(worst, distanceBetween(T_truth_map * pose.pose, truthAt(static_cast<double>(pose.stamp) / kStep)));
  return worst;
}

TEST(GraphRunTest, RelaxesSessionsIntoOneMap) {
  const SessionOdometry monday = driveCircle(0, 1200, 2e-4), tuesday = driveCircle(300, 900, -1e-4);
  std::vector<MetricClosure> rows;
  // Moments between frames, so that odometry has to carry them.
  for (int i = 20; i < 600; i += 60) rows.push_back(closure("monday", i + 0.3, "monday", i + 600.6));
  rows.push_back(closure("monday", -0.3, "monday", 600.0));  // just before the first frame
  for (int i = 310; i < 600; i += 60) rows.push_back(closure("monday", i + 0.4, "tuesday", i + 0.2));
  const GraphRun run = runGraph({}, {&monday, &tuesday}, {"monday", "tuesday"}, rows);
  EXPECT_TRUE(run.joined(0));
  EXPECT_TRUE(run.joined(1));
  EXPECT_EQ(run.relaxed.accepted, rows.size());
  EXPECT_LT(worstError(run.trajectory(0), Pose()), 0.6);
  EXPECT_LT(worstError(run.trajectory(1), Pose()), 0.6);
  EXPECT_GT(worstError(smoothedTrajectory(monday), Pose()), 1.0);
  for (const auto& covariance : run.covariances[1]) EXPECT_TRUE(covariance.allFinite());
  EXPECT_LT(run.covariances[0][0].norm(), 1e-12);

  const urban_nav_input::testing::TemporaryFolder folder;
  writeFiles(OutputFolder(folder.file("out")), run, {&monday, &tuesday});
  EXPECT_EQ(urban_nav_core::readKitti(folder.file("out/trajectory.kitti")).size(), 1802U);
  EXPECT_EQ(urban_nav_core::readCovariances(folder.file("out/covariance.csv")).size(), 1802U);
  const std::vector<urban_nav_core::ClosureRow> written = urban_nav_core::readClosures(folder.file("out/closures.csv"));
  ASSERT_EQ(written.size(), rows.size());
  EXPECT_EQ(written[0].a.session, "monday");
}

TEST(GraphRunTest, KeepsApartWhatNothingJoins) {
  const SessionOdometry monday = driveCircle(0, 300, 0.0), tuesday = driveCircle(0, 300, 0.0);
  const GraphRun run = runGraph({}, {&monday, &tuesday}, {"monday", "tuesday"}, {});
  EXPECT_TRUE(run.joined(0));
  EXPECT_FALSE(run.joined(1));
  ASSERT_FALSE(run.warnings.empty());
  EXPECT_NE(run.warnings[0].find("tuesday"), std::string::npos);
}

TEST(GraphRunTest, LeavesASessionWithoutClosuresAsOdometryHasIt) {
  const SessionOdometry monday = driveCircle(0, 700, 0.0), tuesday = driveCircle(0, 300, 0.0);
  MetricClosure wrong = closure("tuesday", 10.0, "tuesday", 290.0);
  wrong.measured.T_a_b = Pose(Eigen::Quaterniond::Identity(), Vector3d(30.0, 0.0, 0.0)) * wrong.measured.T_a_b;
  const GraphRun run =
      runGraph({}, {&monday, &tuesday}, {"monday", "tuesday"},
               {closure("monday", 20.0, "monday", 620.0), closure("monday", 40.0, "monday", 640.0), wrong});
  ASSERT_EQ(run.relaxed.accepted, 2U);
  for (std::size_t i = 0; i < tuesday.settled.size(); ++i) {
    EXPECT_EQ(run.covariances[1][i], tuesday.settled[i].T_odom_base.covariance);
    EXPECT_TRUE(isApprox(run.trajectory(1)[i].pose, tuesday.settled[i].T_odom_base.pose, 1e-9));
  }
  EXPECT_NE(run.covariances[0].back(), monday.settled.back().T_odom_base.covariance);
}

TEST(GraphRunTest, UsesGpsFixesOnRequestAndReportsTheirUse) {
  const SessionOdometry run = driveCircle(0, 1200, 1e-3);
  const urban_nav_core::LocalTangent tangent({0.9, 0.0, 100.0});
  constexpr double kDegrees = 180.0 / M_PI;
  std::vector<urban_nav_core::PositionFix> fixes;
  for (int i = 0; i <= 1200; i += 20) {
    const urban_nav_core::Geodetic at = tangent.toGeodetic(truthAt(i).t());
    const Vector3d sigma = Vector3d::Constant(0.1);
    fixes.push_back({{i * kStep, kDegrees * at.latitude, kDegrees * at.longitude, at.height, sigma}, Vector3d::Zero()});
  }
  pose_graph::Parameters parameters;
  parameters.gps_correlation = 1.0;
  const double without =
      worstError(runGraph(parameters, {&run}, {"monday"}, {}, {}, {}, {fixes}).trajectory(0), Pose());
  parameters.gps = true;
  const GraphRun used = runGraph(parameters, {&run}, {"monday"}, {}, {}, {}, {fixes});
  EXPECT_GT(without, 2.0) << "odometry alone: fixes are not used unless asked for";
  EXPECT_LT(worstError(used.trajectory(0), Pose()), 0.25 * without);
  EXPECT_EQ(used.graph.fixUse().used, fixes.size());
  const GraphRun none = runGraph(parameters, {&run}, {"monday"}, {});
  ASSERT_EQ(none.warnings.size(), 1U);
  EXPECT_NE(none.warnings[0].find("no GPS fix"), std::string::npos);
  fixes.back().reading.stamp += 3600'000'000'000;
  const GraphRun late = runGraph(parameters, {&run}, {"monday"}, {}, {}, {}, {fixes});
  ASSERT_FALSE(late.warnings.empty());
  EXPECT_NE(late.warnings[0].find("1 of 61 GPS fixes"), std::string::npos) << late.warnings[0];
}

TEST(GraphRunTest, TakesClosuresInAnyOrderAndFromWhereverTheyAreKnown) {
  const SessionOdometry monday = driveCircle(0, 900, 2e-4), tuesday = driveCircle(300, 900, -1e-4);
  std::vector<MetricClosure> rows;
  for (int i = 20; i < 300; i += 40) rows.push_back(closure("monday", i + 0.3, "monday", i + 600.6));
  for (int i = 310; i < 600; i += 60) rows.push_back(closure("monday", i + 0.4, "tuesday", i + 0.2));
  const auto toBytes = [&](const std::vector<MetricClosure>& file, const PreviousClosures& known) {
    const urban_nav_input::testing::TemporaryFolder folder;
    const GraphRun run = runGraph({}, {&monday, &tuesday}, {"monday", "tuesday"}, file, known);
    writeFiles(OutputFolder(folder.file("out")), run, {&monday, &tuesday});
    EXPECT_EQ(run.closures.size(), rows.size());
    std::string bytes;
    for (const char* name : {"trajectory.tum", "trajectory.kitti", "covariance.csv", "graph.g2o"})
      bytes += urban_nav_input::testing::readFile(folder.file("out/" + std::string(name)));
    return bytes;
  };
  const std::string expected = toBytes(rows, {});
  std::vector<MetricClosure> backwards(rows.rbegin(), rows.rend());
  EXPECT_TRUE(toBytes(backwards, {}) == expected);

  const GraphRun whole = runGraph({}, {&monday, &tuesday}, {"monday", "tuesday"}, rows);
  PreviousClosures known;
  for (std::size_t i = 0; i < whole.closures.size(); ++i) {
    if (whole.closures[i].b.session != "monday") continue;
    known.offered.push_back(whole.closures[i]);
    known.in_graph.push_back(whole.graph.closures().at(whole.assessments[i].id));
  }
  ASSERT_EQ(known.offered.size(), 7U);
  EXPECT_TRUE(toBytes({rows.begin() + 7, rows.end()}, known) == expected) << "the file has the new ones alone";
  EXPECT_TRUE(toBytes(rows, known) == expected) << "the file has all of them again";
}

TEST(GraphRunTest, SessionsThatJoinEachOtherAloneAreOneMapOfTheirOwn) {
  const SessionOdometry monday = driveCircle(0, 300, 0.0), tuesday = driveCircle(300, 900, 1e-4),
                        friday = driveCircle(300, 900, -1e-4);
  std::vector<MetricClosure> rows;
  for (int i = 310; i < 600; i += 60) rows.push_back(closure("tuesday", i, "friday", i + 0.2));
  const GraphRun run = runGraph({}, {&monday, &tuesday, &friday}, {"monday", "tuesday", "friday"}, rows);
  EXPECT_EQ(run.findMap(1), 1U);
  EXPECT_EQ(run.findMap(2), 1U);
  EXPECT_EQ(run.sessionsJoined(), 1U);
  EXPECT_TRUE(isApprox(run.trajectory(1).front().pose, Pose(), 1e-12)) << "its origin is its own first pose";
  ASSERT_EQ(run.warnings.size(), 1U) << "one map that nothing joins";
  EXPECT_NE(run.warnings[0].find("tuesday"), std::string::npos);

  const urban_nav_input::testing::TemporaryFolder folder;
  const OutputFolder out(folder.file("out"));
  out.write("trajectory_3.tum", "of visual odometry");
  writeFiles(out, run, {&monday, &tuesday, &friday});
  EXPECT_EQ(urban_nav_core::readTum(out.file("trajectory.tum")).size(), 301U);
  EXPECT_EQ(urban_nav_input::testing::readFile(out.file("trajectory_2.tum")),
            urban_nav_core::printTum(run.trajectory(1)) + urban_nav_core::printTum(run.trajectory(2)));
  EXPECT_EQ(urban_nav_core::readCovariances(out.file("covariance_2.csv")).size(), 1202U);
  EXPECT_EQ(urban_nav_input::testing::readFile(out.file("trajectory_3.tum")), "");
}

/// Adds the specific forces on the circle at each frame.
void feel(SessionOdometry& run, const Pose& T_first_level) {
  constexpr double kTurnRate = 2.0 * M_PI / (600.0 * 0.05);
  const Pose first = truthAt(static_cast<double>(run.settled.front().stamp) / kStep);
  for (const SmoothedFrame& settled : run.settled) {
    const Pose now = truthAt(static_cast<double>(settled.stamp) / kStep);
    const Vector3d to_centre = Vector3d(0.0, 10.0, 0.0) - now.t();
    const Vector3d up = first.R() * T_first_level.R() * Vector3d(0.0, 0.0, 9.81);
    run.forces.push_back({settled.stamp, now.R().transpose() * (up + kTurnRate * kTurnRate * to_centre)});
  }
}

/// Two days on the circle and closures between and within them.
struct TwoDays {
  SessionOdometry monday = driveCircle(0, 900, 2e-4), tuesday = driveCircle(300, 900, -1e-4);
  std::vector<MetricClosure> rows;

  TwoDays() {
    for (int i = 20; i < 300; i += 40) rows.push_back(closure("monday", i, "monday", i + 600));
    for (int i = 310; i < 600; i += 60) rows.push_back(closure("monday", i, "tuesday", i));
  }

  GraphRun relaxed(bool gravity) const {
    pose_graph::Parameters parameters;
    parameters.gravity = gravity;
    return runGraph(parameters, {&monday, &tuesday}, {"monday", "tuesday"}, rows);
  }
};

// The robot's first pose is tilted by 0.1 rad to the side and 0.05 rad ahead.
const Pose kTilted(expSo3(Vector3d(0.1, 0.05, 0.0)), Vector3d::Zero());

TEST(GraphRunTest, LevelsTheMapByAnAccelerometer) {
  TwoDays days;
  const GraphRun before = days.relaxed(false);
  EXPECT_FALSE(before.levels[0].known());
  EXPECT_EQ(before.levels[0].trouble, pose_graph::LevelTrouble::NoForces);

  feel(days.monday, kTilted.inverse());
  const GraphRun after = days.relaxed(false);
  ASSERT_TRUE(after.levels[0].known());
  EXPECT_NEAR(std::acos(after.levels[0].up.z()), std::acos(kTilted.R()(2, 2)), 2e-3);
  EXPECT_TRUE(isApprox(after.trajectory(0).front().pose, kTilted * Pose(), 5e-3)) << "its heading was zero and is";
  EXPECT_LT(after.trajectory(0).front().pose.t().norm(), 1e-12);
  for (std::size_t s = 0; s < 2; ++s) {
    const auto level = after.trajectory(s), tilted = before.trajectory(s);
    const Pose turn = after.trajectory(0).front().pose;
    for (std::size_t i = 0; i < level.size(); i += 50)
      EXPECT_TRUE(isApprox(level[i].pose, turn * tilted[i].pose, 1e-9));
    EXPECT_EQ(after.covariances[s].back(), before.covariances[s].back()) << "they are of the axes of the first pose";
  }

  // If the first session has no accelerometer, the next one of the same map determines gravity.
  days.monday.forces.clear();
  feel(days.tuesday, Pose());
  for (const bool gravity : {false, true}) {
    const GraphRun second = days.relaxed(gravity);
    ASSERT_TRUE(second.levels[0].known());
    EXPECT_LT(std::acos(second.levels[0].up.z()), 2e-3);
  }
}

TEST(GraphRunTest, HoldsRollAndPitchBySpecificForce) {
  // Odometry whose roll drifts by 0.05 rad in 45 s, from a tilted start; closures would correct that.
  TwoDays days;
  days.rows.clear();
  Pose odom;
  for (std::size_t i = 1; i < days.monday.settled.size(); ++i) {
    urban_nav_core::RelativePose& step = days.monday.settled[i].from_previous;
    const Vector3d lean = truthAt(static_cast<double>(i)).R().transpose() * Vector3d(0.0, 0.05 / 900.0, 0.0);
    step.T_from_to = step.T_from_to * Pose(expSo3(lean), Vector3d::Zero());
    odom = odom * step.T_from_to;
    days.monday.settled[i].T_odom_base.pose = odom;
  }
  feel(days.monday, kTilted.inverse());
  const auto worstTilt = [](const GraphRun& run) {
    double worst = 0.0;
    for (const auto& pose : run.trajectory(0)) {
      const Vector3d up = truthAt(static_cast<double>(pose.stamp) / kStep).R().transpose() *
                          (kTilted.inverse().R() * Vector3d::UnitZ());
      worst = std::max(worst, (pose.pose.R().transpose() * Vector3d::UnitZ() - up).norm());
    }
    return worst;
  };
  const double leant = worstTilt(days.relaxed(false)), held = worstTilt(days.relaxed(true));
  EXPECT_GT(leant, 0.01);
  EXPECT_LT(held, 0.3 * leant);
}

TEST(GraphRunTest, NamesClosuresThatCannotBeUsed) {
  const SessionOdometry monday = driveCircle(0, 300, 0.0);
  std::vector<MetricClosure> rows = {closure("monday", 10, "sunday", 20), closure("monday", 10, "monday", 5000),
                                     closure("monday", 10, "monday", 10.1), closure("monday", 10, "monday", 200),
                                     closure("monday", 10, "sunday", 20)};
  rows[3] = toCandidate({rows[3].a, rows[3].b, 0.9}, "test");
  rows[4] = toCandidate({rows[4].a, rows[4].b, 0.9}, "test");  // the session first: a transform would not help
  const GraphRun run = runGraph({}, {&monday}, {"monday"}, rows);
  const char* expected[] = {"sunday", "no frames", "both ends are", "no transform", "sunday"};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ClosureAssessment& assessment = run.assessments.at(i);
    EXPECT_EQ(assessment.id, 0);
    EXPECT_EQ(assessment.verdict, urban_nav_core::ClosureVerdict::Rejected);
    EXPECT_NE(assessment.reason.find(expected[i]), std::string::npos) << assessment.reason;
  }
  EXPECT_NE(run.warnings.at(0).find("5 closures"), std::string::npos);
}

TEST(GraphRunTest, CarriesMeasuredInformationToTheNearestFrames) {
  const SessionOdometry monday = driveCircle(0, 900, 0.0);
  // Sure of x alone at the moments; 0.4 steps later x has turned by 0.24 deg.
  MetricClosure measured = closure("monday", 20.4, "monday", 620.4);
  measured.measured.information(0, 0) = 1e6;
  MetricClosure given = measured;
  measured.evidence = "evidence";
  const auto toGraph = [&](const MetricClosure& each) {
    const GraphRun run = runGraph({}, {&monday}, {"monday"}, {each});
    return run.graph.closures().at(run.assessments.at(0).id).measured;
  };
  const urban_nav_core::Constraint at_frames = toGraph(measured), as_stated = toGraph(given);
  EXPECT_EQ(as_stated.information, given.measured.information) << "of a file, at the nearest frames as it is";
  EXPECT_GT((at_frames.information - measured.measured.information).norm(), 1e3);
  EXPECT_EQ(at_frames.T_a_b.matrix(), as_stated.T_a_b.matrix());
}

TEST(GraphRunTest, StereoIsWhatAFileWithoutAKindGives) {
  const SessionOdometry monday = driveCircle(0, 900, 0.0);
  std::vector<MetricClosure> rows = {closure("monday", 20, "monday", 620), closure("monday", 40, "monday", 640)};
  rows[0].method = urban_nav_core::ClosureMethod::None;
  rows[1].method = urban_nav_core::ClosureMethod::Icp;
  const GraphRun run = runGraph({}, {&monday}, {"monday"}, rows);
  EXPECT_EQ(run.graph.closures().at(run.assessments.at(0).id).kind, pose_graph::EdgeKind::Stereo);
  EXPECT_EQ(run.graph.closures().at(run.assessments.at(1).id).kind, pose_graph::EdgeKind::Icp);
}

}  // namespace
}  // namespace urban_nav
