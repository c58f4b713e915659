// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_pose_graph.hpp"

#include <fstream>
#include <thread>

#include "../support/driven.hpp"
#include "../support/gps_drive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using testing::kLap;
using testing::kPeriod;
using testing::StoreFolder;
using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

TEST(LivePoseGraph, RefusesReferenceSolvers) {
  Parameters parameters;
  for (const char* solver : {"relative_pcg", "ceres"}) {
    parameters.solver = solver;
    EXPECT_THROW(LivePoseGraph(parameters, "robot", "recording"), UserError) << solver;
  }
  parameters.solver = "gauss_newton";
  EXPECT_NO_THROW(LivePoseGraph(parameters, "robot", "recording"));
}

urban_nav_core::MetricClosure seenAgain(int a, int b, const SessionId& session_a = "") {
  const Closure closure = testing::closureAt(session_a, a, "", b);
  urban_nav_core::MetricClosure made;
  made.a = {session_a, closure.a.stamp};
  made.b = {"", closure.b.stamp};
  made.measured = closure.measured;
  made.method = urban_nav_core::ClosureMethod::Stereo;
  made.odometry_gate = true;
  made.verdict = urban_nav_core::ClosureVerdict::Accepted;
  made.source = "loop_metric";
  made.evidence = "47 matches";
  return made;
}

class LivePoseGraphTest : public ::testing::Test {
 protected:
  std::unique_ptr<LivePoseGraph> begin(const std::string& recording = "monday", const std::string& file = "s.db") {
    auto graph = std::make_unique<LivePoseGraph>(Parameters(), "lisa", recording, file.empty() ? "" : place.file(file));
    graph->syncStore();
    return graph;
  }
  static void drive(LivePoseGraph& graph, int first, int end) { drive(graph, first, end, nullptr); }
  static void drive(LivePoseGraph& graph, int first, int end, const urban_nav_core::OdometrySessionPtr& session) {
    for (int i = first; i < end; ++i) {
      graph.add(urban_nav_core::SessionStep(testing::stepAt(i), session));
    }
    graph.syncStore();
  }
  /// Returns the announced session of one lap of the recording.
  static urban_nav_core::OdometrySessionPtr announce(int round) {
    const std::string recording = "monday (" + std::to_string(round) + ")";
    return std::make_shared<const urban_nav_core::OdometrySession>(urban_nav_core::OdometrySession{
        urban_nav_store::makeSessionId({"lisa", recording, 0, ""}), recording, "lisa", recording, 0});
  }
  /// Adds samples of an accelerometer that lies on its side at rest: inconsistent with the path, but gravity dominates.
  static void feel(LivePoseGraph& graph, int end) {
    for (int i = -5; i < end + 5; ++i) graph.add(SpecificForce{i * kPeriod, Eigen::Vector3d(0.0, 0.5, 9.79)});
  }
  /// Adds normals of level ground while the robot drives a circle that is tilted in the axes of its first pose.
  static void seeGround(LivePoseGraph& graph, int end) {
    Pose T;
    for (int i = 0; i < end; ++i) {
      graph.add(GroundNormal{i * kPeriod, T.R().transpose() * kUp, 1e-3, 0.0, 0.9});
      T = T * testing::stepAt(i).T_from_to;
    }
  }
  /// Returns the tilt of the map, rad.
  static double tilt(const LivePoseGraph& graph) {
    const Pose first = graph.trajectory(0, 0, 0).segments[0].poses[0].T_map_base;
    return (first.R() * kUp - Eigen::Vector3d::UnitZ()).norm();
  }
  static std::size_t countPoses(const LivePoseGraph& graph) {
    std::size_t poses = 0;
    for (const auto& run : graph.trajectory(0, 0, 0).segments) poses += run.poses.size();
    return poses;
  }
  static void relaxAll(LivePoseGraph& graph) {
    relaxNew(graph);
    batch(graph);
    graph.syncStore();
  }
  static void relaxNew(LivePoseGraph& graph) {
    while (graph.isRelaxationPending()) graph.relax();
  }
  static std::optional<LiveGraph::Outcome> batch(LivePoseGraph& graph) {
    const auto work = graph.beginBatch();
    work->run(std::atomic<bool>{false});
    return graph.finishBatch(*work);
  }
  StoredGraph stored(const std::string& file = "s.db") {
    Store store(place.file(file), Access::Read);
    return readGraph(store);
  }
  static void expectSame(const LiveGraph::Trajectory& a, const LiveGraph::Trajectory& b) {
    ASSERT_EQ(a.segments.size(), b.segments.size());
    for (std::size_t r = 0; r < a.segments.size(); ++r) {
      EXPECT_EQ(a.segments[r].session, b.segments[r].session);
      ASSERT_EQ(a.segments[r].poses.size(), b.segments[r].poses.size());
      for (std::size_t i = 0; i < a.segments[r].poses.size(); ++i) {
        EXPECT_EQ(a.segments[r].poses[i].T_map_base.t(), b.segments[r].poses[i].T_map_base.t());
        EXPECT_EQ(a.segments[r].poses[i].T_map_base.q().coeffs(), b.segments[r].poses[i].T_map_base.q().coeffs());
      }
    }
  }

  static inline const Eigen::Vector3d kUp = Eigen::Vector3d(0.1, -0.05, 1.0).normalized();
  const StoreFolder place;
};

TEST_F(LivePoseGraphTest, TheIdOfASessionHasRobotAndRecording) {
  const auto id = [](const std::string& robot, const std::string& recording) {
    LivePoseGraph graph(Parameters(), robot, recording);
    drive(graph, 0, 1);
    return graph.trajectory(0, 0, 0).segments.at(0).session;
  };
  EXPECT_EQ(id("lisa", "monday"), id("lisa", "monday"));
  EXPECT_NE(id("lisa", "monday"), id("bart", "monday"));
  EXPECT_NE(id("lisa", "monday"), id("lisa", "tuesday"));
}

TEST_F(LivePoseGraphTest, ARecordingThatIsPlayedAgainGoesOnWhereItWasCutOff) {
  auto whole = begin("monday", "");
  drive(*whole, 0, 2 * kLap);
  for (int i : {10, 60}) whole->add(seenAgain(i, i + kLap));
  relaxAll(*whole);

  auto cut = begin();
  drive(*cut, 0, kLap + 20);
  cut->add(seenAgain(10, 10 + kLap));
  relaxNew(*cut);
  cut->syncStore();
  cut.reset();
  cut = begin();
  EXPECT_EQ(countPoses(*cut), kLap + 21u);
  drive(*cut, 0, 2 * kLap);
  for (int i : {10, 60}) cut->add(seenAgain(i, i + kLap));
  relaxAll(*cut);
  expectSame(cut->trajectory(0, 0, 0), whole->trajectory(0, 0, 0));
}

TEST_F(LivePoseGraphTest, ASessionResumesAfterItsNewestPose) {
  begin()->add(testing::stepAt(0));
  auto graph = begin();
  drive(*graph, 1, 30);
  EXPECT_EQ(countPoses(*graph), 31u);
  graph.reset();
  ASSERT_EQ(stored().chains.size(), 1u);
  EXPECT_TRUE(stored().chains[0].session.complete);
  EXPECT_EQ(stored().chains[0].steps.size(), 30u);
}

TEST_F(LivePoseGraphTest, AnotherRecordingIsAnotherSessionThatJoinsTheMapByClosures) {
  auto first = begin();
  drive(*first, 0, 2 * kLap);
  const SessionId earlier = first->trajectory(0, 0, 0).segments[0].session;
  first.reset();
  auto second = begin("tuesday");
  EXPECT_TRUE(second->isBatchPending());
  drive(*second, 0, 2 * kLap);
  relaxAll(*second);
  EXPECT_EQ(second->trajectory(0, 0, 0).segments.size(), 2u);
  EXPECT_EQ(second->status().reason, static_cast<int>(Trouble::Separate));
  for (int i : {10, 60, 90}) second->add(seenAgain(i, i + kLap, earlier));
  relaxAll(*second);
  EXPECT_EQ(second->status().health, urban_nav_core::Health::Ok) << second->status().sentence;
  second.reset();
  Store store(place.file(), Access::Read);
  ASSERT_EQ(store.sessions().all().size(), 2u);
  for (const auto& session : store.sessions().all())
    EXPECT_EQ(store.sessions().anchor(session.id)->map, earlier) << session.id;
}

TEST_F(LivePoseGraphTest, ABagThatIsLoopedIsASessionEachTime) {
  auto graph = begin();
  for (int round = 0; round < 3; ++round) drive(*graph, 0, 30);
  EXPECT_EQ(graph->trajectory(0, 0, 0).segments.size(), 3u);
  graph->reset();
  EXPECT_EQ(countPoses(*graph), 0u);
  drive(*graph, 0, 5);
  graph.reset();
  EXPECT_EQ(stored().chains.size(), 4u) << "the store forgets nothing";
  std::size_t steps = 0;
  for (const auto& chain : stored().chains) steps += chain.steps.size();
  EXPECT_EQ(steps, 95u);
}

TEST_F(LivePoseGraphTest, SessionsAreThoseOfTheOdometry) {
  auto graph = begin("own name");
  for (int round = 1; round <= 3; ++round) drive(*graph, 0, 20, announce(round));
  graph->add(testing::stepAt(25));  // from odometry without an announced session: continues the session, after a gap
  graph.reset();
  const StoredGraph kept = stored();
  ASSERT_GE(kept.chains.size(), 3u);
  for (int round = 1; round <= 3; ++round) {
    const auto chain = std::find_if(kept.chains.begin(), kept.chains.end(),
                                    [&](const auto& each) { return each.session.id == announce(round)->id; });
    ASSERT_NE(chain, kept.chains.end()) << round;
    EXPECT_EQ(chain->session.recording, announce(round)->recording);
  }
}

TEST_F(LivePoseGraphTest, ASessionOfTheOdometryGoesOnAfterARestartWhateverWasLost) {
  begin()->add(urban_nav_core::SessionStep(testing::stepAt(0), announce(1)));
  auto graph = begin();
  drive(*graph, 5, 30, announce(1));
  graph.reset();
  ASSERT_EQ(stored().chains.size(), 1u);
  EXPECT_EQ(stored().chains[0].session.id, announce(1)->id);
}

TEST_F(LivePoseGraphTest, MissingOdometryIsReportedAtOnce) {
  auto graph = begin();
  drive(*graph, 60, 65, announce(1));  // kPeriod is 50 ms
  EXPECT_EQ(graph->warning(), "the graph lacks the first 3 s of the session, from before it received odometry");
  drive(*graph, 0, 5, announce(2));
  EXPECT_EQ(graph->warning(), "");
  relaxAll(*graph);
  drive(*graph, 5, 8, announce(2));
  EXPECT_FALSE(graph->isRelaxationPending());
  drive(*graph, 9, 10, announce(2));
  ASSERT_TRUE(graph->isRelaxationPending());
  EXPECT_EQ(graph->relax().reason_name, toString(Trouble::BrokenChain));
  graph.reset();
  graph = begin();
  drive(*graph, 60, 65, announce(2));
  EXPECT_EQ(graph->warning(), "") << "its first poses are stored";
}

TEST_F(LivePoseGraphTest, AClosureOfTheNextSessionWaitsForItsOdometry) {
  auto graph = begin();
  drive(*graph, 0, kLap, announce(1));
  auto closure = seenAgain(10, 20, announce(1)->id);
  closure.b.session = announce(2)->id;
  EXPECT_NO_THROW(graph->add(closure));
  drive(*graph, 0, kLap, announce(2));
  relaxAll(*graph);
  graph.reset();
  EXPECT_EQ(stored().closures.size(), 1u);
}

TEST_F(LivePoseGraphTest, AfterAResetTheSessionOfTheOdometryHasAnIdOfItsOwnHere) {
  auto graph = begin();
  drive(*graph, 0, 20, announce(1));
  graph->reset();
  drive(*graph, 20, 20 + kLap, announce(1));
  const SessionId own = graph->trajectory(0, 0, 0).segments.at(0).session;
  EXPECT_NE(own, announce(1)->id) << "the store has poses of that id";
  auto closure = seenAgain(25, 30, announce(1)->id);
  closure.b.session = announce(1)->id;
  EXPECT_NO_THROW(graph->add(closure)) << "that is the running one";
}

TEST_F(LivePoseGraphTest, WhatLoopClosureRejectedIsKeptWithItsReason) {
  auto graph = begin();
  urban_nav_core::MetricClosure rejected = seenAgain(3, 8);
  rejected.verdict = urban_nav_core::ClosureVerdict::Rejected;
  rejected.method = urban_nav_core::ClosureMethod::None;
  rejected.reason_name = "TooFewMatches";
  rejected.sentence = "9 of 20";
  graph->add(rejected);  // before the first odometry
  drive(*graph, 0, kLap);
  graph->add(seenAgain(0, kLap));
  relaxAll(*graph);
  graph.reset();
  ASSERT_EQ(stored().closures.size(), 1u);
  EXPECT_TRUE(stored().closures[0].odometry_gate);
  Store store(place.file(), Access::Read);
  std::string reasons;
  store.graph().forEachEdge(store.sessions().all()[0].id, [&](const urban_nav_store::Edge& edge) {
    if (edge.kind != EdgeKind::Odometry && edge.verdict == ClosureVerdict::Rejected && edge.weight == 0.0 &&
        store.graph().evidence(edge)->find("47 matches") != std::string::npos)
      reasons += edge.reason;
  });
  EXPECT_EQ(reasons.rfind("TooFewMatches: 9 of 20", 0), 0u) << reasons;
}

TEST_F(LivePoseGraphTest, AStoreThatCannotBeUsedIsNamedAndTheGraphGoesOn) {
  std::ofstream(place.file("damaged.db")) << "SQLite format 3, or so it seems";
  for (const std::string file : {"damaged.db", "no/such/folder/s.db"}) {
    auto graph = begin("monday", file);
    drive(*graph, 0, 10);
    EXPECT_EQ(countPoses(*graph), 11u);
    EXPECT_NE(graph->storeState().fault.find(file), std::string::npos) << graph->storeState().fault;
    EXPECT_EQ(graph->status().reason, static_cast<int>(Trouble::NotStored));
    EXPECT_NE(graph->status().sentence.find(file), std::string::npos);
  }
  auto writer = begin();
  auto second = begin();
  EXPECT_NE(second->storeState().fault.find("another program"), std::string::npos) << second->storeState().fault;
}

TEST_F(LivePoseGraphTest, SavesWithAndWithoutAStoreAndLoadsIntoAnotherGraph) {
  for (const std::string file : {"", "s.db"}) {
    auto graph = begin("monday", file);
    drive(*graph, 0, 2 * kLap);
    for (int i : {10, 60}) graph->add(seenAgain(i, i + kLap));
    relaxAll(*graph);
    graph->save(place.file("saved.db"))();
    graph->save(place.file("saved.db"))();
    if (!file.empty()) {
      EXPECT_EQ(graph->save(place.file(file))(), "already committed");
    }
    auto other = begin("tuesday", "");
    EXPECT_NE(other->load(stored("saved.db")).find("1 sessions with 201 poses and 2 closures"), std::string::npos);
    relaxAll(*other);
    expectSame(other->trajectory(0, 0, 0), graph->trajectory(0, 0, 0));
    EXPECT_NE(other->load(stored("saved.db")).find("1 sessions were already loaded"), std::string::npos);
    drive(*other, 0, 10);
    other->reset();
    drive(*other, 0, 10);
    EXPECT_THROW(other->save(place.file("saved.db"))(), UserError) << "it holds a session that would be lost";
    EXPECT_EQ(stored("saved.db").chains.size(), 1u);
  }
}

TEST_F(LivePoseGraphTest, TakesInWhileABatchIsAtWork) {
  auto graph = begin("monday", ""), still = begin("monday", "");
  for (LivePoseGraph* each : {graph.get(), still.get()}) {
    drive(*each, 0, 2 * kLap);
    each->add(seenAgain(10, 10 + kLap));
  }
  const auto work = graph->beginBatch();
  std::atomic<bool> stop{false};
  std::thread elsewhere([&] { work->run(stop); });
  drive(*graph, 2 * kLap, 3 * kLap);
  graph->add(seenAgain(60, 60 + 2 * kLap));
  relaxNew(*graph);
  elsewhere.join();
  const auto taken = graph->finishBatch(*work);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->figures.poses, 3 * kLap + 1);
  EXPECT_FALSE(graph->isRelaxationPending()) << "what came was judged with it";
  drive(*still, 2 * kLap, 3 * kLap);
  still->add(seenAgain(60, 60 + 2 * kLap));
  batch(*graph);
  batch(*still);
  expectSame(graph->trajectory(0, 0, 0), still->trajectory(0, 0, 0));
}

TEST_F(LivePoseGraphTest, TheBatchOfAGraphThatIsNoMoreIsNotTaken) {
  auto graph = begin("monday", "");
  drive(*graph, 0, 2 * kLap);
  graph->add(seenAgain(10, 10 + kLap));
  const auto work = graph->beginBatch();
  graph->reset();
  drive(*graph, 0, 5);
  work->run(std::atomic<bool>{false});
  EXPECT_FALSE(graph->finishBatch(*work));
  EXPECT_EQ(countPoses(*graph), 6u);
}

TEST_F(LivePoseGraphTest, ASessionEndsWithABatch) {
  auto graph = begin("monday", "");
  drive(*graph, 0, 2 * kLap);
  EXPECT_FALSE(graph->isBatchPending());
  graph->newSession("");
  EXPECT_TRUE(graph->isBatchPending());
  batch(*graph);
  EXPECT_FALSE(graph->isBatchPending());
}

TEST_F(LivePoseGraphTest, LevelsOnceTheUpwardDirectionIsKnown) {
  auto graph = begin("monday", "");
  feel(*graph, 3 * kLap);
  drive(*graph, 0, 100);
  EXPECT_FALSE(graph->isRelaxationPending());
  drive(*graph, 100, 3 * kLap);
  ASSERT_TRUE(graph->isRelaxationPending());
  const LiveGraph::Outcome outcome = graph->relax();
  ASSERT_EQ(outcome.corrections.size(), 1u);
  EXPECT_EQ(outcome.corrections[0].reason_name, "Levelled");
  ASSERT_TRUE(outcome.update);
  EXPECT_GT(outcome.update->segments[0].poses.size(), 100u) << "all of them";
  EXPECT_FALSE(graph->isRelaxationPending()) << "once";
}

TEST_F(LivePoseGraphTest, ForcesLevelTheMapAfterARestartToo) {
  auto graph = begin();
  feel(*graph, 4 * kLap);
  drive(*graph, 0, 3 * kLap);
  relaxAll(*graph);
  const LiveGraph::Trajectory before = graph->trajectory(0, 0, 0);
  EXPECT_FALSE(isApprox(before.segments[0].poses[0].T_map_base, Pose(), 1e-3));
  graph.reset();
  ASSERT_EQ(stored().chains.size(), 1u);
  EXPECT_EQ(stored().chains[0].forces.size(), 3u * kLap + 1);
  graph = begin();
  EXPECT_TRUE(graph->isBatchPending());
  relaxAll(*graph);
  expectSame(graph->trajectory(0, 0, 0), before);
}

TEST_F(LivePoseGraphTest, TheGroundLevelsTheMapWithoutAnAccelerometer) {
  auto graph = begin("monday", "");
  seeGround(*graph, 2 * kLap);
  drive(*graph, 0, 2 * kLap);
  ASSERT_TRUE(graph->isRelaxationPending());
  const LiveGraph::Outcome outcome = graph->relax();
  ASSERT_EQ(outcome.corrections.size(), 1u);
  EXPECT_EQ(outcome.corrections[0].reason_name, "Levelled");
  EXPECT_LT(tilt(*graph), 0.02);
  relaxAll(*graph);
  EXPECT_LT(tilt(*graph), 0.02);
}

TEST_F(LivePoseGraphTest, AnAccelerometerHasPriorityOverTheGround) {
  auto graph = begin("monday", ""), alone = begin("monday", "");
  for (LivePoseGraph* each : {graph.get(), alone.get()}) {
    feel(*each, 3 * kLap);
    if (each == graph.get()) seeGround(*each, 2 * kLap);
    drive(*each, 0, 2 * kLap);
    relaxAll(*each);
  }
  expectSame(graph->trajectory(0, 0, 0), alone->trajectory(0, 0, 0));
  EXPECT_GT(tilt(*graph), 0.05);
}

TEST_F(LivePoseGraphTest, TheGroundLevelsTheMapAfterARestartToo) {
  auto graph = begin();
  seeGround(*graph, 2 * kLap);
  drive(*graph, 0, 2 * kLap);
  relaxAll(*graph);
  const LiveGraph::Trajectory before = graph->trajectory(0, 0, 0);
  graph.reset();
  ASSERT_EQ(stored().chains.size(), 1u);
  const std::vector<GroundNormal> ground = stored().chains[0].ground;
  EXPECT_GT(ground.size(), 2u * kLap / 4u) << "0.1 m a step";
  EXPECT_LT(ground.size(), 2u * kLap / 2u);
  EXPECT_EQ(ground[0].support, 0.9);
  graph = begin();
  relaxAll(*graph);
  expectSame(graph->trajectory(0, 0, 0), before);
}

TEST_F(LivePoseGraphTest, FixesCorrectThePathAlsoAfterARestart) {
  testing::GpsDrive gps_drive;
  gps_drive.turn_drift = 0.003;
  gps_drive.white = 0.3;
  testing::makeDrive(3, 700.0, gps_drive);
  Parameters parameters;
  parameters.gps = true;
  const auto start = [&] { return std::make_unique<LivePoseGraph>(parameters, "lisa", "monday", place.file("s.db")); };
  auto graph = start();
  graph->syncStore();
  graph->add(gps_drive.fixes[0]);  // before any odometry
  std::size_t next = 1;
  for (const urban_nav_core::RelativePose& step : gps_drive.odometry) {
    for (; next < gps_drive.fixes.size() && gps_drive.fixes[next].reading.stamp <= step.to; ++next)
      graph->add(gps_drive.fixes[next]);
    graph->add(step);
    if (graph->isBatchPending()) batch(*graph);
  }
  batch(*graph);
  graph->syncStore();
  const LiveGraph::Trajectory before = graph->trajectory(0, 0, 0);
  Track track;
  for (const auto& pose : before.segments.at(0).poses) track.map.push_back(pose.T_map_base);
  EXPECT_LT(testing::positionError(gps_drive, track),
            0.5 * testing::positionError(gps_drive, testing::relaxDrive(gps_drive, false).tracks()[0]));
  graph.reset();
  ASSERT_EQ(stored().chains.size(), 1u);
  EXPECT_EQ(stored().chains[0].fixes.size(), gps_drive.fixes.size());
  graph = start();
  relaxAll(*graph);
  batch(*graph);
  expectSame(graph->trajectory(0, 0, 0), before);
}

TEST_F(LivePoseGraphTest, MapFromOdomIsThatOfTheStampWhereverOdomBegins) {
  auto graph = begin("monday", "");
  const Pose T_odom_first(urban_nav_core::expSo3(Eigen::Vector3d(0.1, 0.2, 0.9)), Eigen::Vector3d(30.0, -7.0, 1.0));
  Pose T;
  std::vector<Pose> odometry;
  for (int i = 0; i < 2 * kLap; ++i) {
    odometry.push_back(T_odom_first * T);
    graph->add(urban_nav_core::StampedPose{i * kPeriod, odometry.back()});
    EXPECT_EQ(graph->T_map_odom().has_value(), i > 25);
    if (i >= 25) graph->add(testing::stepAt(i - 25));
    T = T * testing::stepAt(i).T_from_to;
  }
  graph->add(seenAgain(10, 10 + kLap - 40));
  relaxAll(*graph);
  const auto newest = graph->trajectory(0, 0, 0).segments[0].poses.back();
  EXPECT_TRUE(isApprox(*graph->T_map_odom() * odometry[static_cast<std::size_t>(newest.stamp / kPeriod)],
                       newest.T_map_base, 1e-9));
}

}  // namespace
}  // namespace pose_graph
