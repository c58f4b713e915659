// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "robust/generators/admission.hpp"
#include "support/drawn.hpp"

namespace pose_graph {
namespace {

using test::Dice;

constexpr int kCirclePoses = 100;       // poses of a circle
constexpr double kOdometryStep = 0.5;   // m
constexpr std::size_t kFirstFalse = 8;  // index of the first of ten false candidates, after the true ones

Rigid<2> step() {
  Rigid<2> made;
  made.R = expRotation(RotationVector<2>(2.0 * M_PI / kCirclePoses));
  made.t = {kOdometryStep, 0.0};
  return made;
}

// Three laps of a circle with odometry of low information. Closures join the beginning and the middle of the second lap
// to the first; ten in a row join the third lap to places a quarter of a lap away.
struct Laps {
  Problem<2> problem;
  std::vector<EdgeRole> roles;
  std::vector<int> candidates, group;

  explicit Laps(double off_rad) {
    Dice dice(5);
    const TangentMatrix<2> vague = Eigen::Vector3d(400.0, 400.0, 4000.0).asDiagonal();
    const TangentMatrix<2> sharp = Eigen::Vector3d(1e6, 1e6, 1e7).asDiagonal();
    problem.poses.resize(3 * kCirclePoses);
    for (std::size_t i = 1; i < problem.poses.size(); ++i) problem.poses[i] = problem.poses[i - 1] * step();
    for (int i = 1; i < 3 * kCirclePoses; ++i) problem.edges.push_back({i - 1, i, noisy(step(), vague, dice), vague});
    roles.assign(problem.edges.size(), EdgeRole::Trusted);
    group.assign(problem.edges.size(), -1);
    for (int i = 0; i < static_cast<int>(kFirstFalse); ++i)
      add(i < 4 ? i : 50 + i, kCirclePoses + (i < 4 ? i : 50 + i), {}, sharp, dice);
    const int quarter = static_cast<int>(off_rad / (2.0 * M_PI) * kCirclePoses);
    for (int i = 0; i < 10; ++i) add(20 + i, 2 * kCirclePoses + 20 + i + quarter, {}, sharp, dice);
    for (std::size_t k = 0; k < candidates.size(); ++k)
      group.push_back(candidates[k < 4 ? 0 : k < kFirstFalse ? 4 : kFirstFalse]);
  }

  static Rigid<2> noisy(const Rigid<2>& T, const TangentMatrix<2>& information, Dice& dice) {
    Tangent<2> d;
    for (int a = 0; a < 3; ++a) d[a] = dice.normal() / std::sqrt(information(a, a));
    return moved(T, d);
  }
  void add(int from, int to, const Rigid<2>& Z, const TangentMatrix<2>& information, Dice& dice) {
    candidates.push_back(static_cast<int>(problem.edges.size()));
    problem.edges.push_back({from, to, noisy(Z, information, dice), information});
    roles.push_back(EdgeRole::Candidate);
  }
};

// Statistics with all candidates accepted and the graph relaxed with them.
struct LapSummary {
  bool changed = false;
  std::vector<char> in;
  double group_chi2 = 0.0;  // of the last group before relaxation, as in a round of admission
};
LapSummary summariseLaps(const Laps& laps) {
  const DeadReckoning<2> reckoning(laps.problem, laps.roles);
  const ClosureEvaluator<2> evaluator(laps.problem, laps.candidates, reckoning);
  const Thresholds thresholds(laps.candidates.size(), 3);
  AdmissionState<2> state;
  state.in.assign(laps.problem.edges.size(), 1);
  state.poses = laps.problem.poses;
  AcceptedGraph<2> graph(laps.problem);
  graph.take(state.in);
  graph.settle(state.poses);
  const std::vector<int> group = laps.group;
  LapSummary summary;
  summary.group_chi2 = evaluator.evaluate(graph, state.in, state.poses, 1.0, group, kUncontrolled).group_chi2.back();
  std::vector<int> expelled(laps.problem.edges.size(), 0);
  summary.changed = validateFinally(evaluator, group, group, thresholds, {}, expelled, graph, state);
  summary.in = state.in;
  return summary;
}

TEST(LastWord, ExpelsAGroupThatBendsTheGraphUntilItFits) {
  const Laps laps(M_PI / 2.0);
  const LapSummary summary = summariseLaps(laps);
  EXPECT_LT(summary.group_chi2, sampledMargin() * Thresholds(laps.candidates.size(), 3).limit.back())
      << "nothing else controls it, and a round does not see it";
  EXPECT_TRUE(summary.changed);
  for (std::size_t k = kFirstFalse; k < laps.candidates.size(); ++k)
    EXPECT_EQ(summary.in[static_cast<std::size_t>(laps.candidates[k])], 0) << k;
}

TEST(LastWord, LeavesTrueOnesAlone) {
  const LapSummary summary = summariseLaps(Laps(0.0));
  EXPECT_FALSE(summary.changed);
  EXPECT_EQ(std::count(summary.in.begin(), summary.in.end(), 0), 0);
}

}  // namespace
}  // namespace pose_graph
