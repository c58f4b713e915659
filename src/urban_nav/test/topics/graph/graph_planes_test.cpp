// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/command.hpp"
#include "commands/stages.hpp"
#include "map/map_command.hpp"
#include "simulate/simulate_command.hpp"
#include "support/circle_drive.hpp"
#include "topics/graph/graph_g2o.hpp"
#include "topics/graph/graph_report.hpp"
#include "topics/graph/graph_run.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using pose_graph::Closure;
using testing::closure;
using testing::driveCircle;
using testing::kStep;
using testing::truthAt;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

constexpr double kPlaneSigmaM = 0.005, kPlaneSigmaRad = 0.001;

/// What the walls beside the path tell of two moments one round apart: all but the distance along the path.
Closure planesBetween(int step_a, int step_b) {
  Closure made;
  made.a = {"monday", step_a * kStep};
  made.b = {"monday", step_b * kStep};
  made.kind = pose_graph::EdgeKind::Plane;
  made.source = "planes";
  made.measured.T_a_b = truthAt(step_a).inverse() * truthAt(step_b);
  made.measured.information.diagonal() << 0.0, 1.0 / (kPlaneSigmaM * kPlaneSigmaM), 1.0 / (kPlaneSigmaM * kPlaneSigmaM),
      1.0 / (kPlaneSigmaRad * kPlaneSigmaRad), 1.0 / (kPlaneSigmaRad * kPlaneSigmaRad),
      1.0 / (kPlaneSigmaRad * kPlaneSigmaRad);
  return made;
}

std::vector<Closure> planesOfRound() {
  std::vector<Closure> planes;
  for (int i = 20; i < 600; i += 40) planes.push_back(planesBetween(i, i + 600));
  return planes;
}

GraphRun relaxWith(const SessionOdometry& monday, const std::vector<urban_nav_core::MetricClosure>& rows,
                   const PlaneFinder& find_planes) {
  return runGraph({}, {&monday}, {"monday"}, rows, {}, {}, {}, find_planes);
}

/// Root mean square distance between the places that the robot passed twice and where it passed them before.
double gapBetweenRounds(const GraphRun& run) {
  const urban_nav_core::Trajectory trajectory = run.trajectory(0);
  double squares = 0.0;
  for (std::size_t i = 0; i < 600; ++i)
    squares += (trajectory[i].pose.t() - trajectory[i + 600].pose.t()).squaredNorm() / 600.0;
  return std::sqrt(squares);
}

TEST(GraphPlanesTest, PlanesBringTheRoundsTogetherAndAreNoClosures) {
  const SessionOdometry monday = driveCircle(0, 1200, 2e-4);
  int searches = 0;
  const GraphRun without = relaxWith(monday, {}, {});
  const GraphRun with = relaxWith(monday, {}, [&](const GraphRun&) {
    ++searches;
    return PlaneClosures{planesOfRound(), 3};
  });
  EXPECT_FALSE(without.planes.searched);
  EXPECT_GT(gapBetweenRounds(without), 0.5);
  EXPECT_LT(gapBetweenRounds(with), 0.02);
  EXPECT_EQ(searches, 2) << "again from where the first ones have moved the poses";
  EXPECT_EQ(with.planes.rounds, 2U);
  EXPECT_EQ(with.planes.shared, 3U);
  EXPECT_GT(with.planes.moved, 0.3);
  EXPECT_EQ(with.planeVerdicts().accepted, planesOfRound().size());
  EXPECT_EQ(with.closureVerdicts().all(), 0U);
  EXPECT_TRUE(with.closures.empty()) << "closures.csv holds what was proposed as a closure";
  EXPECT_EQ(with.relaxed.edges, without.relaxed.edges + planesOfRound().size());
  const std::string json = toJson(with, {}).print();
  EXPECT_NE(json.find("\"planes\""), std::string::npos);
  EXPECT_EQ(toJson(without, {}).print().find("\"planes\""), std::string::npos);
}

TEST(GraphPlanesTest, LaterPlanesTakeThePlaceOfEarlierOnes) {
  const SessionOdometry monday = driveCircle(0, 1200, 2e-4);
  int searches = 0;
  const GraphRun run = relaxWith(monday, {}, [&](const GraphRun&) {
    PlaneClosures found{planesOfRound(), 0};
    if (++searches == 2) found.closures.resize(5);
    return found;
  });
  EXPECT_EQ(run.planeVerdicts().all(), 5U);
}

TEST(GraphPlanesTest, PlanesOfAnotherSurfaceAreRejected) {
  const SessionOdometry monday = driveCircle(0, 1200, 2e-4);
  std::vector<Closure> planes = planesOfRound();
  planes[7].measured.T_a_b = planes[7].measured.T_a_b * Pose(Eigen::Quaterniond::Identity(), {0.0, 0.4, 0.0});
  const GraphRun run = relaxWith(monday, {}, [&](const GraphRun&) { return PlaneClosures{planes, 0}; });
  EXPECT_EQ(run.planeVerdicts().accepted, planes.size() - 1);
  EXPECT_LT(gapBetweenRounds(run), 0.02);
}

TEST(GraphPlanesTest, WithoutPlanesNothingChanges) {
  const SessionOdometry monday = driveCircle(0, 1200, 2e-4);
  const std::vector<urban_nav_core::MetricClosure> rows = {closure("monday", 20.0, "monday", 620.0),
                                                           closure("monday", 60.0, "monday", 660.0)};
  const GraphRun without = relaxWith(monday, rows, {});
  const GraphRun with = relaxWith(monday, rows, [](const GraphRun&) { return PlaneClosures(); });
  EXPECT_TRUE(with.planes.searched);
  EXPECT_EQ(with.planes.rounds, 0U);
  EXPECT_EQ(graphG2o(with), graphG2o(without));
  EXPECT_EQ(with.closures.size(), 2U);
}

TEST(GraphPlanesTest, AreSearchedInTheScansUnlessSwitchedOff) {
  const urban_nav_input::testing::TemporaryFolder folder;
  const auto call = [](const std::vector<std::string>& words) {
    std::vector<const char*> argv = {"urban_nav"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({simulateCommand(), mapCommand(makeStages)}, addStageTables, static_cast<int>(argv.size()),
                          argv.data());
  };
  const std::string bag = folder.file("drive.bag");
  ASSERT_EQ(call({"simulate", "--seed", "3", "--duration", "1", "--sensors", "stereo,lasers", "-o", bag}), 0);
  for (const std::string constraints : {"true", "false"}) {
    const std::string out = folder.file(constraints);
    ASSERT_EQ(call({"map", bag, "--out", out, "--stages", "vo,graph,lasers", "--set",
                    "laser_mapper.constraints=" + constraints}),
              0);
    const auto summary = nlohmann::json::parse(urban_nav_input::testing::readFile(out + "/summary.json"));
    EXPECT_EQ(summary.at("pose_graph").contains("planes"), constraints == "true");
  }
}

}  // namespace
}  // namespace urban_nav
