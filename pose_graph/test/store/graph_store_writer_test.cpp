// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph_store_writer.hpp"

#include "../support/driven.hpp"
#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/testing/small_disk.hpp"

namespace pose_graph {
namespace {

using testing::closureAt;
using testing::drive;
using testing::expectSameMap;
using testing::kLap;
using testing::StoreFolder;
using urban_nav_core::testing::SmallDisk;
using urban_nav_store::Access;
using urban_nav_store::Store;

class GraphStoreWriterTest : public ::testing::Test {
 protected:
  GraphStoreWriter open(const std::string& name = "s.db") {
    return {std::make_shared<urban_nav_store::LiveWriter>(Store(place.file(name), Access::Write),
                                                          GraphStoreWriter::writerOptions()),
            0};
  }
  static urban_nav_store::Session session(const SessionId& id) { return {id, "by name", "robot", "monday", 7, false}; }
  static void settle(GraphStoreWriter& writer, const PoseGraph& graph, bool exactly = false) {
    for (int i = 0; i < 50 && !writer.isUpToDate(graph); ++i) {
      writer.sync(graph, exactly);
      writer.writer()->flush();
    }
    EXPECT_TRUE(writer.isUpToDate(graph)) << writer.counts().fault;
  }
  std::size_t relaxedPoses(const SessionId& id, std::int64_t revision = -1) {
    Store store(place.file(), Access::Read);
    std::size_t count = 0;
    store.graph().forEachRelaxed(id, [&](const urban_nav_store::RelaxedPose& pose) {
      if (revision < 0 || pose.revision == revision) ++count;
    });
    return count;
  }

  const StoreFolder place;
  PoseGraph graph{Parameters()};
};

TEST_F(GraphStoreWriterTest, AGraphComesBackAndRelaxesToTheSameBits) {
  {
    GraphStoreWriter writer = open();
    for (const char* id : {"a", "b"}) {
      graph.beginSession(id);
      writer.put(session(id), listParameters(Parameters()));
      for (int i = 0; i < 2 * kLap; i += 20) {
        drive(graph, id, i, i + 20);
        writer.sync(graph);
      }
    }
    for (int i = 5; i < kLap; i += 30) {
      graph.addClosure(closureAt("a", i, "a", i + kLap));
      graph.addClosure(closureAt("a", i, "b", i + kLap));
      graph.relax();
      writer.sync(graph, true);
    }
    settle(writer, graph, true);
    EXPECT_EQ(writer.counts().refused, 0);
    for (const auto& [id, closure] : graph.closures()) EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted);
  }
  Store store(place.file(), Access::Read);
  const StoredGraph stored = readGraph(store);
  EXPECT_EQ(stored.revision, graph.revision());
  ASSERT_EQ(stored.chains.size(), 2u);
  EXPECT_EQ(stored.chains[0].session, session("a"));
  EXPECT_EQ(store.sessions().parameters("a").size(), table().rows().size());
  PoseGraph again{Parameters()};
  for (const StoredGraph::Chain& chain : stored.chains) {
    again.beginSession(chain.session.id);
    for (const auto& step : chain.steps) EXPECT_TRUE(again.addOdometry(chain.session.id, step));
  }
  for (const Closure& closure : stored.closures) {
    EXPECT_TRUE(closure.odometry_gate == false) << "no evidence was given";
    again.addClosure(closure);
  }
  again.relax();
  expectSameMap(again, graph);
  std::size_t i = 0;
  store.graph().forEachRelaxed("b", [&](const urban_nav_store::RelaxedPose& pose) {
    EXPECT_EQ(pose.T_map_base.t(), graph.tracks()[1].map[i++].t());
  });
  EXPECT_EQ(i, graph.tracks()[1].map.size());
  EXPECT_EQ(store.sessions().anchor("b")->map, "a") << "joined by closures";
}

TEST_F(GraphStoreWriterTest, ConstantsOfTheRigComeBackWithTheSteps) {
  const urban_nav_core::Vector6d sensitivity = urban_nav_core::Vector6d::LinSpaced(1.0 / 3.0, 2.0);
  {
    GraphStoreWriter writer = open();
    graph.beginSession("a");
    writer.put(session("a"));
    for (int i = 0; i < 3; ++i) {
      urban_nav_core::RelativePose step = testing::stepAt(i);
      step.constants = {{"disparity", 0.1 * i, 0.2, 0.01, sensitivity}};
      graph.addOdometry("a", step);
    }
    settle(writer, graph);
  }
  Store store(place.file(), Access::Read);
  const StoredGraph stored = readGraph(store);
  ASSERT_EQ(stored.chains.front().steps.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(isApprox(stored.chains.front().steps[i].constants.at(0), graph.stepTo(0, i + 1)->constants.at(0), 0.0));
  PoseGraph again{Parameters()};
  for (const urban_nav_core::RelativePose& step : stored.chains.front().steps) again.addOdometry("a", step);
  ASSERT_EQ(again.commonErrors().size(), 2U);
  EXPECT_EQ(again.commonErrors()[0].of_edge, graph.commonErrors()[0].of_edge);
  EXPECT_EQ(again.commonErrors()[1].of_edge, graph.commonErrors()[1].of_edge);
}

TEST_F(GraphStoreWriterTest, NothingMoreThanOdometryWhileNothingIsRelaxed) {
  GraphStoreWriter writer = open();
  graph.beginSession("a");
  writer.put(session("a"));
  drive(graph, "a", 0, kLap);
  settle(writer, graph);
  EXPECT_EQ(relaxedPoses("a"), 0u);
  Store store(place.file(), Access::Read);
  EXPECT_EQ(store.graph().nodes("a"), kLap + 1);
  EXPECT_FALSE(store.sessions().anchor("a"));
  EXPECT_EQ(store.graph().node({"a", 3 * testing::kPeriod})->T_odom_base.t(), graph.tracks()[0].odom[3].t());
}

TEST_F(GraphStoreWriterTest, OnlyPosesThatMoveAreWrittenAgain) {
  GraphStoreWriter writer = open();
  graph.beginSession("a");
  writer.put(session("a"));
  drive(graph, "a", 0, 2 * kLap);
  graph.addClosure(closureAt("a", 0, "a", kLap));
  graph.relax();
  settle(writer, graph);
  EXPECT_EQ(relaxedPoses("a", 1), 2u * kLap + 1);
  drive(graph, "a", 2 * kLap, 3 * kLap);
  graph.addClosure(closureAt("a", 2 * kLap, "a", 3 * kLap));
  graph.update();
  settle(writer, graph);
  EXPECT_EQ(relaxedPoses("a"), 3u * kLap + 1);
  EXPECT_GT(relaxedPoses("a", 1), 0u);
  EXPECT_GE(relaxedPoses("a", 2), static_cast<std::size_t>(kLap));
}

TEST_F(GraphStoreWriterTest, ClosuresCarryTheirVerdictsAndGoWhenTheyAreRemoved) {
  GraphStoreWriter writer = open();
  graph.beginSession("a");
  writer.put(session("a"));
  drive(graph, "a", 0, 2 * kLap);
  const ClosureId first = graph.addClosure(closureAt("a", 0, "a", kLap));
  graph.addClosure(closureAt("a", 30, "a", 30 + kLap));
  writer.putEvidence(toEdge(graph.closures().at(first)), toEvidence(true) + "seen by eye");
  const auto edges = [&] {
    Store store(place.file(), Access::Read);
    std::vector<urban_nav_store::Edge> found;
    store.graph().forEachEdge("a", [&](const urban_nav_store::Edge& edge) {
      if (edge.kind != EdgeKind::Odometry) found.push_back(edge);
    });
    return found;
  };
  settle(writer, graph);
  ASSERT_EQ(edges().size(), 2u);
  EXPECT_EQ(edges()[0].verdict, ClosureVerdict::Waiting) << "it is there before it is judged";
  graph.relax();
  settle(writer, graph);
  EXPECT_EQ(edges()[0].verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(edges()[0].weight, graph.closures().at(first).weight);
  {
    Store store(place.file(), Access::Read);
    const StoredGraph stored = readGraph(store);
    EXPECT_TRUE(stored.closures[0].odometry_gate);
    EXPECT_FALSE(stored.closures[1].odometry_gate);
  }
  graph.removeClosure(first);
  graph.relax();
  settle(writer, graph);
  ASSERT_EQ(edges().size(), 1u);
  EXPECT_EQ(edges()[0].a.stamp, 30 * testing::kPeriod);
}

TEST_F(GraphStoreWriterTest, WhatItsStageRejectedIsEvidenceAndNoPartOfTheGraph) {
  GraphStoreWriter writer = open();
  graph.beginSession("a");
  writer.put(session("a"));
  drive(graph, "a", 0, 10);
  urban_nav_store::Edge edge = toEdge(closureAt("a", 1, "a", 7));
  edge.measured.information.setZero();
  edge.verdict = ClosureVerdict::Rejected;
  edge.weight = 0.0;
  edge.reason = "TooFewMatches: 9";
  writer.putRejected(edge, "nine points");
  settle(writer, graph);
  Store store(place.file(), Access::Read);
  EXPECT_EQ(store.graph().evidence(edge), "nine points");
  EXPECT_TRUE(readGraph(store).closures.empty());
}

TEST_F(GraphStoreWriterTest, AGapStaysAGap) {
  GraphStoreWriter writer = open();
  graph.beginSession("a");
  writer.put(session("a"));
  drive(graph, "a", 0, 10);
  drive(graph, "a", 20, 30);
  settle(writer, graph);
  Store store(place.file(), Access::Read);
  PoseGraph again{Parameters()};
  const StoredGraph stored = readGraph(store);
  for (const auto& step : stored.chains[0].steps) again.addOdometry("a", step);
  expectSameMap(again, graph);
  EXPECT_NE(again.tracks()[0].part.front(), again.tracks()[0].part.back());
}

TEST_F(GraphStoreWriterTest, GoesOnWhereThereIsRoomAgain) {
  GraphStoreWriter writer = open();
  graph.beginSession("a");
  writer.put(session("a"));
  drive(graph, "a", 0, 100);
  settle(writer, graph);
  {
    const SmallDisk disk(300'000);
    for (int i = 100; i < 3000; ++i) {
      drive(graph, "a", i, i + 1);
      writer.sync(graph);
      if (i % 500 == 0) writer.writer()->flush();
    }
    EXPECT_NE(writer.counts().fault.find("disk is full"), std::string::npos) << writer.counts().fault;
    EXPECT_LE(writer.counts().waiting, 100u) << "the rest waits in the graph";
    EXPECT_EQ(writer.counts().dropped, 0);
    Store reader(place.file(), Access::Read);
    EXPECT_GE(reader.graph().nodes("a"), 101);
  }
  settle(writer, graph);
  EXPECT_EQ(writer.counts().fault, "");
  Store reader(place.file(), Access::Read);
  EXPECT_EQ(reader.graph().nodes("a"), 3001);
  EXPECT_EQ(writer.lost(), 0);
}

TEST_F(GraphStoreWriterTest, TheRevisionsOfAnotherGraphContinueAfterThoseOfTheFirst) {
  GraphStoreWriter writer = open();
  for (const char* id : {"a", "b"}) {
    graph = PoseGraph(Parameters(), graph.revision());
    graph.beginSession(id);
    writer.put(session(id));
    drive(graph, id, 0, 2 * kLap);
    graph.addClosure(closureAt(id, 0, id, kLap));
    graph.relax();
    graph.relax();
    settle(writer, graph, true);
    writer.reset();
  }
  EXPECT_EQ(relaxedPoses("a", 2), 2u * kLap + 1);
  EXPECT_EQ(relaxedPoses("b", 4), 2u * kLap + 1);
}

}  // namespace
}  // namespace pose_graph
