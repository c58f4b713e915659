// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/closure_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "robust/generators/admission.hpp"
#include "robust/generators/inner_selection.hpp"
#include "support/drawn.hpp"

namespace pose_graph {
namespace {

// Density of a residual with the stated standard deviation of one, in one dimension.
double density(double residual, double variance) {
  return std::exp(logInlierLikelihood(-0.5 * std::log(2.0 * M_PI), 1, residual * residual, variance));
}

TEST(TrueResidual, IsADensity) {
  for (const double variance : {0.01, 0.3, 1.0, 4.0}) {
    double sum = 0.0;
    for (int i = -50000; i <= 50000; ++i) sum += 1e-3 * density(1e-3 * i, variance);
    EXPECT_NEAR(sum, 1.0, 1e-6) << variance;
  }
}

TEST(TrueResidual, IsNormalWhereInformationIsRightOrOverconfident) {
  for (const double variance : {1.0, 4.0})
    for (const double residual : {0.0, 1.0, 10.0})
      EXPECT_NEAR(std::log(density(residual, variance)),
                  -0.5 * std::log(2.0 * M_PI * variance) - 0.5 * residual * residual / variance, 1e-12);
}

TEST(TrueResidual, HasTheStatedTailsWhereInformationIsLow) {
  const double stated = -0.5 * std::log(2.0 * M_PI) - 0.5 * 9.0;
  EXPECT_NEAR(std::log(density(3.0, 0.01)), std::log(0.05) + stated, 1e-9) << "thirty deviations of the others";
  EXPECT_GT(density(0.0, 0.01), 9.0 * density(0.0, 1.0)) << "and near by it is nearly as sharp as the others";
}

TEST(TrueResidual, FallsWithTheResidualAndStaysFinite) {
  for (const double variance : {1e-9, 0.1, 1.0, 1e6}) {
    double before = logInlierLikelihood(0.0, 6, 0.0, variance);
    for (double chi2 = 1e-3; chi2 < 1e12; chi2 *= 10.0) {
      const double now = logInlierLikelihood(0.0, 6, chi2, variance);
      EXPECT_TRUE(std::isfinite(now));
      EXPECT_LT(now, before);
      before = now;
    }
  }
}

// A straight drive there and back, closures between both directions, one of them with an error.
struct ThereAndBack {
  static constexpr int kPoses = 60, kErring = 70;  // edge number
  Problem<2> problem;
  std::vector<int> candidates;
  std::vector<char> in;
  std::vector<int> row;

  explicit ThereAndBack(double error) {
    problem.poses.resize(1);
    for (int i = 1; i < kPoses; ++i) {
      Rigid<2> step;
      step.t = {1.0, 0.0};
      if (i == kPoses / 2) step.R = expRotation(RotationVector<2>(M_PI));
      problem.poses.push_back(problem.poses.back() * step);
      measure(i - 1, i);
    }
    for (int i = 3; i < kPoses / 2 - 3; ++i) measure(i, kPoses - 1 - i);
    problem.edges[kErring].Z.t[0] += error;
    for (int e = 0; e < static_cast<int>(problem.edges.size()); ++e) {
      if (e >= kPoses - 1) candidates.push_back(e);
      in.push_back(1);
      row.push_back(-1);
    }
  }
  void measure(int from, int to) {
    const auto at = [&](int pose) { return problem.poses[static_cast<std::size_t>(pose)]; };
    problem.edges.push_back({from, to, at(from).inverse() * at(to), TangentMatrix<2>::Identity() * 1e4});
  }
  Evidence evaluate(double own) const {
    const DeadReckoning<2> reckoning(problem, rolesByNumbers(problem));
    const ClosureEvaluator<2> evaluator(problem, candidates, reckoning);
    AcceptedGraph<2> graph(problem);
    std::vector<Rigid<2>> poses = problem.poses;
    graph.take(in);
    graph.settle(poses);
    return evaluator.evaluate(graph, in, poses, 1.0, row, kSettled, own);
  }
};

// A covariance from 24 samples has an error of 30 %.
TEST(OwnVariance, IsThatOfTheClosureInQuestionAlone) {
  ThereAndBack inside(0.3), outside = inside, wider = inside;
  outside.in[ThereAndBack::kErring] = wider.in[ThereAndBack::kErring] = 0;
  for (const double own : {1.0, 25.0, 900.0}) {
    const double without = outside.evaluate(own).chi2[ThereAndBack::kErring];
    EXPECT_LT(std::abs(std::log(inside.evaluate(own).chi2[ThereAndBack::kErring] / without)), std::log(1.8)) << own;
    wider.problem.edges[ThereAndBack::kErring].information = inside.problem.edges[0].information / own;
    EXPECT_NEAR(wider.evaluate(1.0).chi2[ThereAndBack::kErring], without, 1e-6 * without) << own;
  }
}

// Ten closures in a row with an error of 2 m, which their deviations of 0.1 m do not explain.
TEST(OwnVariance, OfARowIsThatOfAllItsClosures) {
  ThereAndBack alone(0.0), row(0.0);
  for (int e = ThereAndBack::kErring - 5; e < ThereAndBack::kErring + 5; ++e) {
    row.problem.edges[static_cast<std::size_t>(e)].Z.t[1] += 2.0;
    row.row[static_cast<std::size_t>(e)] = ThereAndBack::kErring;
  }
  const double stated = row.evaluate(1.0).group_chi2[ThereAndBack::kErring];
  const double wider = row.evaluate(100.0).group_chi2[ThereAndBack::kErring];
  EXPECT_GT(wider, 50.0);
  EXPECT_LT(wider, stated);
  EXPECT_LT(alone.evaluate(100.0).group_chi2[ThereAndBack::kErring], 1e-6);
}

TEST(OwnVariance, ARowContradictsTheRestUnlessItsOwnVarianceExplainsIt) {
  const auto contradicts = [](double metres, double own) {
    ThereAndBack drive(0.0);
    for (int e = ThereAndBack::kErring - 5; e < ThereAndBack::kErring + 5; ++e) {
      drive.problem.edges[static_cast<std::size_t>(e)].Z.t[1] += metres;
      drive.row[static_cast<std::size_t>(e)] = ThereAndBack::kErring;
    }
    return contradictsItself(drive.problem, rolesByNumbers(drive.problem), drive.in, drive.problem.poses, drive.row,
                             own);
  };
  EXPECT_FALSE(contradicts(0.0, 1.0));
  EXPECT_TRUE(contradicts(2.0, 1.0));
  EXPECT_TRUE(contradicts(2.0, 100.0));
  EXPECT_FALSE(contradicts(2.0, 1e6));
}

}  // namespace
}  // namespace pose_graph
