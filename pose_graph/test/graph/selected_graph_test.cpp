// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/pose_graph.hpp"
#include "support/drawn.hpp"
#include "urban_nav_core/testing/false_closures.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph {
namespace {

using urban_nav_core::testing::addFalseClosures;
using urban_nav_core::testing::FalseClosures;
using urban_nav_core::testing::GraphEdge;
using urban_nav_core::testing::SimulatedGraph;

constexpr StampNs kBetweenPoses = 100'000'000;

SimulatedGraph drawSphere(std::uint64_t seed) {
  return urban_nav_core::testing::sphereGraph(12, 24, 20.0, urban_nav_core::testing::evenNoise(0.05, 0.01), seed);
}

bool isChain(const GraphEdge& edge) { return edge.b == edge.a + 1; }

NodeRef toNode(std::size_t pose) { return {"a", static_cast<StampNs>(pose + 1) * kBetweenPoses}; }

// Steps and closures of a simulated graph as a session; closures need no confirmation.
PoseGraph makeGraph(const SimulatedGraph& simulated) {
  PoseGraph graph{Parameters()};
  for (const GraphEdge& edge : simulated.edges) {
    if (!isChain(edge)) continue;
    urban_nav_core::RelativePose step;
    step.from = toNode(edge.a).stamp;
    step.to = toNode(edge.b).stamp;
    step.T_from_to = edge.T_a_b;
    step.covariance = edge.information.inverse();
    EXPECT_TRUE(graph.addOdometry("a", step));
  }
  for (const GraphEdge& edge : simulated.edges) {
    if (isChain(edge)) continue;
    Closure closure;
    closure.a = toNode(edge.a);
    closure.b = toNode(edge.b);
    closure.source = "test";
    closure.measured.T_a_b = edge.T_a_b;
    closure.measured.information = edge.information;
    closure.odometry_gate = true;
    graph.addClosure(closure);
  }
  return graph;
}

RobustSolution<3> runSelection(const PoseGraph& graph) {
  const Batch batch = graph.batch();
  std::vector<EdgeRole> roles(batch.problem.edges.size() - batch.closures.size(), EdgeRole::Trusted);
  roles.resize(batch.problem.edges.size(), EdgeRole::Candidate);
  return relaxSelected(batch.problem, roles, {});
}

void expectVerdicts(const RobustSolution<3>& selected, const PoseGraph& graph) {
  std::size_t e = selected.edges.size() - graph.closures().size();
  for (const auto& [id, closure] : graph.closures()) EXPECT_EQ(closure.verdict, selected.edges[e++].verdict) << id;
}

void keepFalseAlone(SimulatedGraph& graph) {
  graph.edges.erase(std::remove_if(graph.edges.begin(), graph.edges.end(),
                                   [](const GraphEdge& edge) { return !isChain(edge) && !edge.wrong; }),
                    graph.edges.end());
}

TEST(SelectedGraph, FalseClosuresAloneLeaveTheMapToOdometry) {
  for (const std::size_t wrong : {20, 80}) {
    SimulatedGraph simulated = drawSphere(wrong);
    addFalseClosures(simulated, FalseClosures::Random, wrong, wrong + 10);
    keepFalseAlone(simulated);
    PoseGraph graph = makeGraph(simulated);
    const Relaxed relaxed = graph.relax();
    EXPECT_EQ(relaxed.accepted, 0u) << wrong;
    EXPECT_TRUE(relaxed.selection.undecided) << wrong;
    EXPECT_EQ(graph.odometryVariance(), 1.0) << wrong;
    EXPECT_EQ(graph.status().reason, static_cast<int>(Trouble::Undecided)) << wrong;
    const Track& track = graph.tracks()[0];
    for (std::size_t i = 0; i < track.map.size(); ++i)
      EXPECT_LT(distanceBetween(track.map[i], track.odom[i]), 1e-6) << wrong << ' ' << i;
    expectVerdicts(runSelection(graph), graph);
  }
}

TEST(SelectedGraph, VerdictsAreThoseOfTheSelectionOfFiles) {
  for (const std::size_t wrong : {0, 60}) {
    SimulatedGraph simulated = drawSphere(3);
    addFalseClosures(simulated, FalseClosures::Random, wrong, 5);
    PoseGraph graph = makeGraph(simulated);
    const Relaxed relaxed = graph.relax();
    const RobustSolution<3> selected = runSelection(graph);
    EXPECT_FALSE(relaxed.selection.undecided);
    EXPECT_EQ(relaxed.selection.contested, selected.selection.contested);
    EXPECT_GT(relaxed.accepted, 100u);
    expectVerdicts(selected, graph);
  }
}

// One step is too long by 2 m and rotated by 1 rad.
TEST(SelectedGraph, AStepThatSlippedFollowsTheClosures) {
  SimulatedGraph simulated = drawSphere(7);
  constexpr std::size_t kSlipped = 130;
  for (GraphEdge& edge : simulated.edges)
    if (isChain(edge) && edge.a == kSlipped)
      edge.T_a_b = edge.T_a_b * Pose(urban_nav_core::expSo3(Eigen::Vector3d(0.0, 0.0, 1.0)), {2.0, 0.0, 0.0});
  const auto late = std::find_if(simulated.edges.rbegin(), simulated.edges.rend(),
                                 [](const GraphEdge& edge) { return !isChain(edge); });
  const GraphEdge newest = *late;
  simulated.edges.erase(std::next(late).base());
  PoseGraph graph = makeGraph(simulated);
  const Relaxed relaxed = graph.relax();
  ASSERT_EQ(relaxed.slips.size(), 1u);
  EXPECT_EQ(relaxed.slips[0].from.stamp, toNode(kSlipped).stamp);
  EXPECT_EQ(relaxed.slips[0].to.stamp, toNode(kSlipped + 1).stamp);
  EXPECT_EQ(relaxed.rejected, 0u);
  EXPECT_EQ(graph.status().reason, static_cast<int>(Trouble::Slipped));
  const auto expectNearTruth = [&] {
    const Pose T_truth_map = simulated.truth[0] * graph.tracks()[0].map[0].inverse();
    for (std::size_t i = 0; i < simulated.truth.size(); ++i)
      EXPECT_LT(distanceBetween(T_truth_map * graph.tracks()[0].map[i], simulated.truth[i]), 1.0) << i;
  };
  expectNearTruth();
  // The live graph continues from the replaced step, and the next batch from the measurement.
  Closure closure;
  closure.a = toNode(newest.a);
  closure.b = toNode(newest.b);
  closure.source = "late";
  closure.measured.T_a_b = newest.T_a_b;
  closure.measured.information = newest.information;
  const ClosureId id = graph.addClosure(closure);
  graph.update();
  EXPECT_EQ(graph.closures().at(id).verdict, ClosureVerdict::Accepted);
  expectNearTruth();
  graph.removeClosure(id);
  graph.relax();
  PoseGraph again = makeGraph(simulated);
  again.relax();
  for (std::size_t i = 0; i < graph.tracks()[0].map.size(); ++i)
    EXPECT_EQ(graph.tracks()[0].map[i].t(), again.tracks()[0].map[i].t()) << i;
}

// One closure at a time, as in the live graph; a batch follows on request.
TEST(SelectedGraph, OneAtATimeEndsWithTheVerdictsOfTheBatch) {
  SimulatedGraph simulated = drawSphere(4);
  addFalseClosures(simulated, FalseClosures::Random, 30, 9);
  keepFalseAlone(simulated);
  PoseGraph batch = makeGraph(simulated), live = batch;
  for (const auto& [id, closure] : batch.closures()) live.removeClosure(id);
  for (const auto& [id, closure] : batch.closures()) {
    live.addClosure(closure);
    if (live.update().needs_batch) live.relax();
  }
  batch.relax();
  auto other = live.closures().begin();
  for (const auto& [id, closure] : batch.closures()) EXPECT_EQ((other++)->second.verdict, closure.verdict) << id;
  for (std::size_t i = 0; i < batch.tracks()[0].map.size(); ++i)
    EXPECT_LT(distanceBetween(batch.tracks()[0].map[i], live.tracks()[0].map[i]), 1e-6) << i;
}

// A drive without revisits in which two sections are confused: odometry with larger variances fits these closures.
TEST(SelectedGraph, ARowThatIsAMetreOffIsNotJoinedSilently) {
  for (const std::uint64_t seed : {1, 2, 3})
    for (const int length : {10, 30}) {
      test::Dice dice(seed);
      SimulatedGraph simulated;
      std::vector<Rigid<3>> truth(1);
      const auto add = [&](std::size_t a, std::size_t b, const Rigid<3>& Z, double metres, double radians) {
        GraphEdge edge;
        edge.a = a;
        edge.b = b;
        edge.T_a_b = toPose(moved(Z, test::drawTangent<3>(dice, metres, radians)));
        Eigen::Matrix<double, 6, 1> deviation;
        deviation << metres, metres, metres, radians, radians, radians;
        edge.information = deviation.cwiseAbs2().cwiseInverse().asDiagonal();
        simulated.edges.push_back(edge);
      };
      for (std::size_t i = 0; i + 1 < 154; ++i) {
        Rigid<3> step;
        step.t = Eigen::Vector3d(0.45, 0.0, 0.0);
        truth.push_back(truth.back() * step);
        add(i, i + 1, step, 0.005, 0.0005);
      }
      const std::size_t first = 5 + 3 * seed;
      Rigid<3> off;
      off.t = Eigen::Vector3d(std::cos(2.0 * static_cast<double>(seed)), std::sin(2.0 * static_cast<double>(seed)), 0);
      for (std::size_t k = 0; k < static_cast<std::size_t>(length); ++k)
        add(first + k, first + 100 + k, truth[first + k].inverse() * truth[first + 100 + k] * off, 0.05, 0.01);
      PoseGraph graph = makeGraph(simulated);
      const Relaxed relaxed = graph.relax();
      double off_odometry = 0.0, moved_by = 0.0;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        off_odometry = std::max(off_odometry, (graph.tracks()[0].odom[i].t() - truth[i].t).norm());
        moved_by = std::max(moved_by, (graph.tracks()[0].map[i].t() - truth[i].t).norm());
      }
      EXPECT_TRUE(moved_by < 1.1 * off_odometry + 0.02 || graph.status().health != urban_nav_core::Health::Ok)
          << seed << ' ' << length << ": " << moved_by << " m, odometry " << off_odometry << ", " << relaxed.accepted
          << " accepted";
    }
}

}  // namespace
}  // namespace pose_graph
