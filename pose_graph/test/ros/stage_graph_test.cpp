// SPDX-License-Identifier: BSD-3-Clause
#include "stage_graph.hpp"

#include <fstream>

#include "../support/driven.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using testing::kLap;
using testing::kPeriod;
using testing::Place;
using testing::stepAt;
using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

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

class Stage : public ::testing::Test {
 protected:
  std::unique_ptr<StageGraph> begin(const std::string& recording = "monday", const std::string& file = "s.db") {
    auto graph = std::make_unique<StageGraph>(Parameters(), "lisa", recording, file.empty() ? "" : place.file(file));
    graph->keep();
    return graph;
  }
  static void drive(StageGraph& graph, int first, int end) {
    for (int i = first; i < end; ++i) graph.add(stepAt(i));
    graph.keep();
  }
  static std::size_t posesOf(const StageGraph& graph) {
    std::size_t poses = 0;
    for (const auto& run : graph.trajectory(0, 0, 0).runs) poses += run.poses.size();
    return poses;
  }
  static void relaxAll(StageGraph& graph) {
    while (graph.wantsRelaxation()) graph.relax(false);
    graph.relax(true);
    graph.keep();
  }
  StoredGraph stored(const std::string& file = "s.db") {
    Store store(place.file(file), Access::Read);
    return readGraph(store);
  }
  static void expectSame(const LiveGraph::Trajectory& a, const LiveGraph::Trajectory& b) {
    ASSERT_EQ(a.runs.size(), b.runs.size());
    for (std::size_t r = 0; r < a.runs.size(); ++r) {
      EXPECT_EQ(a.runs[r].session, b.runs[r].session);
      ASSERT_EQ(a.runs[r].poses.size(), b.runs[r].poses.size());
      for (std::size_t i = 0; i < a.runs[r].poses.size(); ++i) {
        EXPECT_EQ(a.runs[r].poses[i].T_map_base.t(), b.runs[r].poses[i].T_map_base.t());
        EXPECT_EQ(a.runs[r].poses[i].T_map_base.q().coeffs(), b.runs[r].poses[i].T_map_base.q().coeffs());
      }
    }
  }

  const Place place;
};

TEST_F(Stage, aRecordingThatIsPlayedAgainGoesOnWhereItWasCutOff) {
  auto whole = begin("monday", "");
  drive(*whole, 0, 2 * kLap);
  for (int i : {10, 60}) whole->add(seenAgain(i, i + kLap));
  relaxAll(*whole);

  auto cut = begin();
  drive(*cut, 0, kLap + 20);
  cut->add(seenAgain(10, 10 + kLap));
  while (cut->wantsRelaxation()) cut->relax(false);
  cut->keep();
  cut.reset();
  cut = begin();
  EXPECT_EQ(posesOf(*cut), kLap + 21u);
  drive(*cut, 0, 2 * kLap);
  for (int i : {10, 60}) cut->add(seenAgain(i, i + kLap));
  relaxAll(*cut);
  expectSame(cut->trajectory(0, 0, 0), whole->trajectory(0, 0, 0));
}

TEST_F(Stage, aSessionGoesOnBehindItsNewestPose) {
  begin()->add(stepAt(0));
  auto graph = begin();
  drive(*graph, 1, 30);
  EXPECT_EQ(posesOf(*graph), 31u);
  graph.reset();
  ASSERT_EQ(stored().chains.size(), 1u);
  EXPECT_TRUE(stored().chains[0].session.complete);
  EXPECT_EQ(stored().chains[0].steps.size(), 30u);
}

TEST_F(Stage, anotherRecordingIsAnotherSessionThatJoinsTheMapByClosures) {
  auto first = begin();
  drive(*first, 0, 2 * kLap);
  const SessionId earlier = first->trajectory(0, 0, 0).runs[0].session;
  first.reset();
  auto second = begin("tuesday");
  EXPECT_TRUE(second->wantsRelaxation());
  drive(*second, 0, 2 * kLap);
  relaxAll(*second);
  EXPECT_EQ(second->trajectory(0, 0, 0).runs.size(), 2u);
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

TEST_F(Stage, aBagThatIsLoopedIsASessionEachTime) {
  auto graph = begin();
  for (int round = 0; round < 3; ++round) drive(*graph, 0, 30);
  EXPECT_EQ(graph->trajectory(0, 0, 0).runs.size(), 3u);
  graph->reset();
  EXPECT_EQ(posesOf(*graph), 0u);
  drive(*graph, 0, 5);
  graph.reset();
  EXPECT_EQ(stored().chains.size(), 4u) << "the store forgets nothing";
  std::size_t steps = 0;
  for (const auto& chain : stored().chains) steps += chain.steps.size();
  EXPECT_EQ(steps, 95u);
}

TEST_F(Stage, whatLoopClosureRejectedIsKeptWithItsReason) {
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

TEST_F(Stage, aStoreThatCannotBeUsedIsNamedAndTheGraphGoesOn) {
  std::ofstream(place.file("damaged.db")) << "SQLite format 3, or so it seems";
  for (const std::string file : {"damaged.db", "no/such/folder/s.db"}) {
    auto graph = begin("monday", file);
    drive(*graph, 0, 10);
    EXPECT_EQ(posesOf(*graph), 11u);
    EXPECT_NE(graph->storeState().fault.find(file), std::string::npos) << graph->storeState().fault;
    EXPECT_EQ(graph->status().reason, static_cast<int>(Trouble::NotStored));
    EXPECT_NE(graph->status().sentence.find(file), std::string::npos);
  }
  auto writer = begin();
  auto second = begin();
  EXPECT_NE(second->storeState().fault.find("another program"), std::string::npos) << second->storeState().fault;
}

TEST_F(Stage, savesWithAndWithoutAStoreAndLoadsIntoAnotherGraph) {
  for (const std::string file : {"", "s.db"}) {
    auto graph = begin("monday", file);
    drive(*graph, 0, 2 * kLap);
    for (int i : {10, 60}) graph->add(seenAgain(i, i + kLap));
    relaxAll(*graph);
    graph->save(place.file("saved.db"))();
    graph->save(place.file("saved.db"))();
    if (!file.empty()) {
      EXPECT_EQ(graph->save(place.file(file))(), "all of it is committed");
    }
    auto other = begin("tuesday", "");
    EXPECT_NE(other->load(stored("saved.db")).find("1 sessions with 201 poses and 2 closures"), std::string::npos);
    relaxAll(*other);
    expectSame(other->trajectory(0, 0, 0), graph->trajectory(0, 0, 0));
    EXPECT_NE(other->load(stored("saved.db")).find("1 sessions were there already"), std::string::npos);
    drive(*other, 0, 10);
    other->reset();
    drive(*other, 0, 10);
    EXPECT_THROW(other->save(place.file("saved.db"))(), UserError) << "it holds a session that would be lost";
    EXPECT_EQ(stored("saved.db").chains.size(), 1u);
  }
}

}  // namespace
}  // namespace pose_graph
