// SPDX-License-Identifier: BSD-3-Clause
#include "icp/normal_equations.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::testing::Dice;
using urban_nav_core::testing::numericJacobian;

struct Plane {
  Vector3d point_source, point_target, normal;
  double residual(const Pose& T) const { return normal.dot(T * point_source - point_target); }
};

TEST(NormalEquations, TheJacobianIsThatOfTheResidualFarFromZeroToo) {
  Dice dice(1);
  for (int i = 0; i < 20; ++i) {
    const Plane plane{10.0 * dice.normals<3>(), 10.0 * dice.normals<3>(), dice.normals<3>().normalized()};
    const Pose T = urban_nav_core::expSe3(dice.normals<6>());
    const auto numeric = numericJacobian<1, 6>([&](const Pose& at) { return plane.residual(at); }, T);
    const Vector6d row = planeJacobian(T.q() * plane.point_source, plane.normal);
    EXPECT_LT((numeric.transpose() - row).norm(), 1e-8 * (1.0 + row.norm()));
  }
}

std::vector<Match> randomMatches(int count) {
  Dice dice(2);
  std::vector<Match> matches;
  for (int i = 0; i < count; ++i) {
    Match match;
    match.lever = 5.0 * dice.normals<3>();
    match.target_normal = match.source_normal = dice.normals<3>().normalized();
    match.residual = 0.1 * dice.normal();
    match.weight = dice.uniform();
    matches.push_back(match);
  }
  return matches;
}

TEST(NormalEquations, TheSumsAreTheOnesWrittenOut) {
  const std::vector<Match> matches = randomMatches(3000);
  const double sigma = 0.05;
  const NormalEquations sums = sumUp(matches, sigma);
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  for (const Match& match : matches) {
    const Vector6d row = planeJacobian(match.lever, match.target_normal);
    const double weight = match.weight / (1.0 + std::pow(match.residual / sigma, 2));
    H += weight * row * row.transpose();
    b += weight * match.residual * row;
  }
  EXPECT_LT((sums.H - H).norm(), 1e-10 * H.norm());
  EXPECT_LT((sums.b - b).norm(), 1e-10 * b.norm());
}

/// The right-hand side of the normal equations corresponds to the gradient of the robust cost.
TEST(NormalEquations, TheRightHandSideIsHalfTheGradientOfTheCost) {
  const std::vector<Match> matches = randomMatches(50);
  const double sigma = 0.05;
  const auto cost = [&](const Pose& T) {
    double sum = 0.0;
    for (const Match& match : matches) {
      const double residual = match.residual + match.target_normal.dot(T * match.lever - match.lever);
      sum += match.weight * sigma * sigma * std::log1p(residual * residual / (sigma * sigma));
    }
    return sum;
  };
  const auto gradient = numericJacobian<1, 6>(cost, Pose(), 1e-4);
  EXPECT_LT((0.5 * gradient.transpose() - sumUp(matches, sigma).b).norm(), 1e-6);
}

TEST(NormalEquations, TheSpreadIsTheDeviationOfAGaussian) {
  std::vector<Match> matches = randomMatches(20000);
  EXPECT_NEAR(computeSpread(matches), 0.1, 0.003);
  for (std::size_t i = 0; i < matches.size(); i += 4) matches[i].residual = 50.0;
  EXPECT_LT(computeSpread(matches), 0.2);
  EXPECT_EQ(computeSpread({}), 0.0);
}

}  // namespace
}  // namespace urban_nav_registration
