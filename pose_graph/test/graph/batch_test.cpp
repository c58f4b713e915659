// SPDX-License-Identifier: BSD-3-Clause
#include <thread>

#include "../support/driven.hpp"

namespace pose_graph {
namespace {

using testing::closureAt;
using testing::drive;
using testing::kLap;

PoseGraph driven(int laps) {
  PoseGraph graph{Parameters()};
  drive(graph, "a", 0, laps * kLap);
  for (int i = 10; i < (laps - 1) * kLap; i += 30) graph.addClosure(closureAt("a", i, "a", i + kLap));
  return graph;
}

// The live graph equals a batch of the same inputs.
void expectBatch(PoseGraph& live, PoseGraph& fresh) {
  live.relax();
  fresh.relax();
  testing::expectSameMap(live, fresh);
}

TEST(Batch, TakenAtOnceIsRelax) {
  PoseGraph in_steps = driven(3), at_once = driven(3);
  Batch batch = in_steps.batch();
  run(batch);
  const Relaxed relaxed = in_steps.take(batch);
  EXPECT_EQ(relaxed.cost_after, at_once.relax().cost_after);
  testing::expectSameMap(in_steps, at_once);
}

TEST(Batch, WhatCameMeanwhileFollows) {
  PoseGraph live = driven(2);
  Batch batch = live.batch();
  std::thread elsewhere([&] { run(batch); });
  drive(live, "a", 2 * kLap, 3 * kLap);
  const ClosureId late = live.addClosure(closureAt("a", 120, "a", 120 + kLap));
  live.update();
  elsewhere.join();
  const Relaxed taken = live.take(batch);
  EXPECT_EQ(taken.poses, 3u * kLap + 1);
  EXPECT_EQ(live.closures().at(late).verdict, ClosureVerdict::Accepted) << "it was judged beside what the batch made";
  EXPECT_TRUE(taken.needs_batch) << "it was not weighed";
  PoseGraph whole = driven(2);
  drive(whole, "a", 2 * kLap, 3 * kLap);
  whole.addClosure(closureAt("a", 120, "a", 120 + kLap));
  whole.relax();
  for (std::size_t i = 0; i < whole.tracks()[0].map.size(); ++i)
    EXPECT_TRUE(isApprox(live.tracks()[0].map[i], whole.tracks()[0].map[i], 1e-2)) << i;
  expectBatch(live, whole);
}

TEST(Batch, PosesAreTheBatchSToTheLastDigitAndNewOnesTheirOdometry) {
  PoseGraph live = driven(2), still = driven(2);
  Batch batch = live.batch();
  drive(live, "a", 2 * kLap, 2 * kLap + 20);
  run(batch);
  live.take(batch);
  still.relax();
  const Track &more = live.tracks()[0], &less = still.tracks()[0];
  for (std::size_t i = 0; i < less.map.size(); ++i) EXPECT_EQ(more.map[i].t(), less.map[i].t());
  for (std::size_t i = less.map.size(); i < more.map.size(); ++i)
    EXPECT_TRUE(isApprox(more.map[i - 1].inverse() * more.map[i], more.odom[i - 1].inverse() * more.odom[i], 1e-9));
}

TEST(Batch, ASessionThatBeganAndJoinedMeanwhileStaysInTheMap) {
  PoseGraph live = driven(2);
  live.relax();
  Batch batch = live.batch();
  drive(live, "b", 0, kLap);
  for (const int i : {10, 60}) live.addClosure(closureAt("a", i, "b", i));
  EXPECT_EQ(live.update().parts, 1);
  const Pose before = live.tracks()[1].map.back();
  run(batch);
  const Relaxed taken = live.take(batch);
  EXPECT_EQ(taken.parts, 1);
  EXPECT_FALSE(taken.correction);
  EXPECT_TRUE(isApprox(live.tracks()[1].map.back(), before, 1e-2));
}

TEST(Batch, AClosureRemovedOrMeasuredAgainKeepsNoVerdictOfTheBatch) {
  PoseGraph live = driven(2);
  Batch batch = live.batch();
  ASSERT_TRUE(live.removeClosure(1));
  Closure second_closure = closureAt("a", 40, "a", 40 + kLap);
  second_closure.measured.information *= 2.0;
  const ClosureId id = live.addClosure(second_closure);
  ASSERT_EQ(batch.closures.count(id), 1u);
  run(batch);
  live.take(batch);
  EXPECT_EQ(live.closures().count(1), 0u);
  EXPECT_TRUE(live.closures().at(id).judged);
  EXPECT_EQ(live.closures().at(id).measured.information, second_closure.measured.information);
  EXPECT_EQ(live.closures().at(id).reason, "consistent with the accepted edges");
}

TEST(Batch, OfNothingIsNothing) {
  PoseGraph graph{Parameters()};
  Batch batch = graph.batch();
  run(batch);
  EXPECT_EQ(graph.take(batch).revision, 0);
}

}  // namespace
}  // namespace pose_graph
