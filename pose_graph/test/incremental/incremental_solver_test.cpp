// SPDX-License-Identifier: BSD-3-Clause
#include "incremental/incremental_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "condense/chain_sum.hpp"
#include "pose_graph/graph_file.hpp"
#include "urban_nav_core/testing/street_graph.hpp"

namespace pose_graph {
namespace {

using urban_nav_core::testing::GraphEdge;
using urban_nav_core::testing::GraphEdgeKind;
using urban_nav_core::testing::SimulatedGraph;

/// Tracks for tests, each unbroken except where a step does not join.
class Tracks : public GraphView {
 public:
  void add(std::size_t track, const ChainStep& step) {
    if (map_.size() <= track) {
      map_.resize(track + 1);
      steps_.resize(track + 1);
    }
    if (map_[track].empty()) map_[track].emplace_back();
    steps_[track].push_back(step);
    map_[track].push_back(step.joins ? map_[track].back() * toPose(step.edge.Z) : map_[track].back());
  }

  std::size_t tracks() const override { return map_.size(); }
  const ChainStep* steps(std::size_t track) const override { return steps_[track].data(); }
  Rigid<3> pose(const NodeIndex& place) const override { return toRigid<3>(map_[place.first][place.second]); }
  std::pair<std::size_t, std::size_t> run(const NodeIndex& place) const override {
    std::pair<std::size_t, std::size_t> made{place.second, place.second};
    const std::vector<ChainStep>& steps = steps_[place.first];
    while (made.first > 0 && steps[made.first - 1].joins) --made.first;
    while (made.second < steps.size() && steps[made.second].joins) ++made.second;
    return made;
  }
  void write(const NodeIndex& place, const Rigid<3>& T) override { map_[place.first][place.second] = toPose(T); }

  /// Returns the whole problem with these closures, from the written poses.
  Problem<3> problem(const std::vector<ClosureEdge>& closure_edges) const {
    Problem<3> made;
    std::vector<int> first;
    const auto put = [&made](Edge<3> edge, int from, int to) {
      edge.from = from;
      edge.to = to;
      made.edges.push_back(edge);
    };
    for (std::size_t t = 0; t < map_.size(); ++t) {
      first.push_back(static_cast<int>(made.poses.size()));
      for (const urban_nav_core::Pose& pose : map_[t]) made.poses.push_back(toRigid<3>(pose));
      for (std::size_t i = 0; i < steps_[t].size(); ++i)
        if (steps_[t][i].joins)
          put(steps_[t][i].edge, first[t] + static_cast<int>(i), first[t] + static_cast<int>(i) + 1);
    }
    for (const ClosureEdge& closure_edge : closure_edges)
      put(closure_edge.edge, first[closure_edge.a.first] + static_cast<int>(closure_edge.a.second),
          first[closure_edge.b.first] + static_cast<int>(closure_edge.b.second));
    return made;
  }

 private:
  std::vector<std::vector<urban_nav_core::Pose>> map_;
  std::vector<std::vector<ChainStep>> steps_;
};

Edge<3> toEdge(const GraphEdge& edge) {
  Edge<3> made{0, 0, toRigid<3>(edge.T_a_b), {}};
  TangentMatrix<3> axes = TangentMatrix<3>::Zero();
  axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = made.Z.R;
  made.information = axes.transpose() * edge.information * axes;
  return made;
}

ChainStep toStep(const Edge<3>& edge) {
  ChainStep step;
  step.edge = edge;
  step.invertible = invert<3>(edge.information, step.covariance);
  return step;
}

struct LiveDrive {
  std::vector<ChainStep> steps;
  std::vector<ClosureEdge> closure_edges;  // sorted by the later one of their two nodes
};

const LiveDrive& liveDrive() {
  static const LiveDrive made = [] {
    urban_nav_core::testing::StreetOptions streets;
    streets.step_m = 0.25;
    const SimulatedGraph graph =
        urban_nav_core::testing::streetGraph(3000, 30, urban_nav_core::testing::streetNoise(), 5, streets);
    LiveDrive drive;
    for (const GraphEdge& edge : graph.edges) {
      if (edge.kind == GraphEdgeKind::Chain) drive.steps.push_back(toStep(toEdge(edge)));
      else drive.closure_edges.push_back({{0, edge.a}, {0, edge.b}, toEdge(edge)});
    }
    std::stable_sort(drive.closure_edges.begin(), drive.closure_edges.end(),
                     [](const ClosureEdge& one, const ClosureEdge& other) {
                       return std::max(one.a, one.b) < std::max(other.a, other.b);
                     });
    return drive;
  }();
  return made;
}

// Expects that little further decrease is possible from the written poses, and that no pose would move far (m).
void expectRelaxed(const Tracks& tracks, const std::vector<ClosureEdge>& closure_edges, double cost) {
  SolveOptions options;
  options.start = Start::Vertices;
  const Problem<3> problem = tracks.problem(closure_edges);
  const Solution<3> solution = solve(problem, options);
  EXPECT_NEAR(cost, solution.cost, 0.02 + 1e-4 * solution.cost);
  double farthest = 0.0;
  for (std::size_t i = 0; i < problem.poses.size(); ++i)
    farthest = std::max(farthest, (problem.poses[i].t - solution.poses[i].t).norm());
  EXPECT_LT(farthest, 0.01);
}

TEST(IncrementalSolver, IsTheBatchAfterEachClosure) {
  Tracks tracks;
  std::vector<ClosureEdge> closure_edges;
  std::size_t next = 0;
  std::optional<IncrementalSolver> core;
  double last_cost = 0.0;
  for (const ClosureEdge& closure_edge : liveDrive().closure_edges) {
    for (; next < std::max(closure_edge.a, closure_edge.b).second; ++next) tracks.add(0, liveDrive().steps[next]);
    if (!core) core.emplace(tracks, closure_edges, 100);
    const IncrementalSolver::Offer offer = core->offer(tracks, closure_edge, INFINITY);
    core->keep();
    closure_edges.push_back(closure_edge);
    EXPECT_GE(offer.innovation, -1e-3);
    EXPECT_NEAR(offer.cost - offer.innovation, last_cost, 1e-9 + 1e-9 * last_cost);
    last_cost = offer.cost;
    core->write(tracks);
    if (closure_edges.size() % 10 == 3) expectRelaxed(tracks, closure_edges, offer.cost);
  }
  // A solver that begins at the same written poses has the same cost.
  EXPECT_NEAR(IncrementalSolver(tracks, closure_edges, 100).cost(), core->cost(), 0.01);
}

TEST(IncrementalSolver, WithdrawsClosuresThatAreNotKept) {
  Tracks tracks, untouched;
  for (const ChainStep& step : liveDrive().steps)
    for (Tracks* each : {&tracks, &untouched}) each->add(0, step);
  const std::vector<ClosureEdge> half(liveDrive().closure_edges.begin(), liveDrive().closure_edges.begin() + 15);
  IncrementalSolver core(tracks, half, 100), other(untouched, half, 100);
  for (std::size_t k = 15; k < liveDrive().closure_edges.size(); ++k) {
    ClosureEdge wrong = liveDrive().closure_edges[k];
    wrong.edge.Z.t += Eigen::Vector3d(0.2, 0.1, 0.0);
    const double before = core.cost();
    core.offer(tracks, wrong, INFINITY);
    core.withdraw();
    EXPECT_EQ(core.cost(), before);
    // Above the limit the cost is a prediction, and no chain is updated.
    wrong.edge.Z.t += Eigen::Vector3d(30.0, 0.0, 0.0);
    EXPECT_GT(core.offer(tracks, wrong, 1000.0).innovation, 1000.0);
    core.withdraw();
  }
  for (IncrementalSolver* each : {&core, &other}) {
    Tracks& on = each == &core ? tracks : untouched;
    each->offer(on, liveDrive().closure_edges[20], INFINITY);
    each->keep();
    each->write(on);
  }
  EXPECT_EQ(core.cost(), other.cost());
  for (std::size_t i = 0; i <= liveDrive().steps.size(); i += 7)
    EXPECT_EQ(tracks.pose({0, i}).t, untouched.pose({0, i}).t) << i;
}

TEST(IncrementalSolver, TakesSeveralOnTrialBackOneByOne) {
  Tracks tracks;
  for (const ChainStep& step : liveDrive().steps) tracks.add(0, step);
  const std::vector<ClosureEdge> half(liveDrive().closure_edges.begin(), liveDrive().closure_edges.begin() + 15);
  IncrementalSolver core(tracks, half, 100);
  const auto poses = [&] {
    std::vector<Rigid<3>> made;
    for (std::size_t i = 0; i <= liveDrive().steps.size(); i += 11) made.push_back(core.pose(tracks, {0, i}));
    return made;
  };
  std::vector<double> costs;
  std::vector<std::vector<Rigid<3>>> lay;
  for (std::size_t k = 15; k < 18; ++k) {
    costs.push_back(core.cost());
    lay.push_back(poses());
    core.offer(tracks, liveDrive().closure_edges[k], INFINITY);
    EXPECT_GT(core.cost(), costs.back());
  }
  while (!costs.empty()) {
    core.withdraw();
    EXPECT_EQ(core.cost(), costs.back());
    const std::vector<Rigid<3>> now = poses();
    for (std::size_t i = 0; i < now.size(); ++i) EXPECT_LT((now[i].t - lay.back()[i].t).norm(), 1e-9) << i;
    costs.pop_back();
    lay.pop_back();
  }
}

TEST(IncrementalSolver, ReturnsPosesBeforeTheyAreWritten) {
  Tracks tracks;
  for (const ChainStep& step : liveDrive().steps) tracks.add(0, step);
  IncrementalSolver core(tracks, liveDrive().closure_edges, 100);
  std::vector<Rigid<3>> predicted_poses;
  for (std::size_t i = 0; i <= liveDrive().steps.size(); ++i) predicted_poses.push_back(core.pose(tracks, {0, i}));
  core.write(tracks);
  for (std::size_t i = 0; i < predicted_poses.size(); ++i)
    EXPECT_LT((tracks.pose({0, i}).t - predicted_poses[i].t).norm(), 1e-9) << i;
}

TEST(IncrementalSolver, TakesStepsForAsUncertainAsStated) {
  Tracks tracks, wider;
  for (ChainStep step : liveDrive().steps) {
    tracks.add(0, step);
    step.edge.information /= 4.0;
    step.covariance *= 4.0;
    wider.add(0, step);
  }
  EXPECT_NEAR(IncrementalSolver(tracks, liveDrive().closure_edges, 100, 4.0).cost(),
              IncrementalSolver(wider, liveDrive().closure_edges, 100).cost(), 1e-6);
}

// The second half of the drive as a separate session, which begins at its odometry origin: one closure joins it.
TEST(IncrementalSolver, BringsPartsTogether) {
  const std::size_t half = liveDrive().steps.size() / 2;
  Tracks tracks;
  for (std::size_t i = 0; i < liveDrive().steps.size(); ++i)
    if (i != half) tracks.add(i < half ? 0 : 1, liveDrive().steps[i]);
  std::vector<ClosureEdge> closure_edges;
  std::optional<IncrementalSolver> core;
  const auto placed = [half](const NodeIndex& place) {
    return place.second <= half ? place : NodeIndex{1, place.second - half - 1};
  };
  double cost = 0.0;
  for (ClosureEdge closure_edge : liveDrive().closure_edges) {
    closure_edge.a = placed(closure_edge.a);
    closure_edge.b = placed(closure_edge.b);
    if (!core) core.emplace(tracks, closure_edges, 100);
    closure_edges.push_back(closure_edge);
    cost = core->offer(tracks, closure_edge, INFINITY).cost;
    core->keep();
    core->write(tracks);
  }
  EXPECT_EQ(tracks.pose({0, 0}).t, Eigen::Vector3d::Zero().eval());
  expectRelaxed(tracks, closure_edges, cost);
}

TEST(IncrementalSolver, GoesRoundGapsAndStepsWithoutInformation) {
  Tracks tracks;
  for (std::size_t i = 0; i < liveDrive().steps.size(); ++i) {
    ChainStep step = liveDrive().steps[i];
    if (i == 1500) step.joins = false;
    if (i % 400 == 7) {
      step.edge.information.row(2).setZero();
      step.edge.information.col(2).setZero();
      step.invertible = false;
    }
    tracks.add(0, step);
  }
  std::optional<IncrementalSolver> core;
  std::vector<ClosureEdge> closure_edges;
  double cost = 0.0;
  for (const ClosureEdge& closure_edge : liveDrive().closure_edges) {
    if (!core) core.emplace(tracks, closure_edges, 100);
    closure_edges.push_back(closure_edge);
    cost = core->offer(tracks, closure_edge, INFINITY).cost;
    core->keep();
    core->write(tracks);
    EXPECT_TRUE(std::isfinite(cost));
  }
  SolveOptions options;
  options.start = Start::Vertices;
  EXPECT_NEAR(solve(tracks.problem(closure_edges), options).cost, cost, 0.05 + 1e-3 * cost);
  for (std::size_t i = 0; i <= liveDrive().steps.size(); ++i) ASSERT_TRUE(tracks.pose({0, i}).t.allFinite());
}

}  // namespace
}  // namespace pose_graph
