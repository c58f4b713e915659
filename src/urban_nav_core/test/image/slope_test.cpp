// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/slope.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace urban_nav_core {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Slope seen(const Vector2d& at, const Matrix2d& information) {
  Slope slope;
  slope.see(information * at, information);
  return slope;
}

/// Mean of the posterior under a bivariate Cauchy prior, by summing over a grid.
Vector2d exactMean(const Vector2d& at, const Matrix2d& information, double usual) {
  Vector2d sum = Vector2d::Zero();
  double total = 0.0;
  const double reach = 10.0, step = 0.02;
  for (double x = -reach; x < reach; x += step)
    for (double y = -reach; y < reach; y += step) {
      const Vector2d s(x, y);
      const double p = std::exp(-0.5 * (s - at).dot(information * (s - at))) *
                       std::pow(1.0 + s.squaredNorm() / (usual * usual), -1.5);
      sum += p * s;
      total += p;
    }
  return sum / total;
}

TEST(Slope, UnseenIsUsual) {
  const Slope::Estimate estimate = Slope().under(0.3);
  EXPECT_EQ(estimate.mean.norm(), 0.0);
  EXPECT_LT((estimate.covariance - 0.09 * Matrix2d::Identity()).norm(), 1e-9);
}

TEST(Slope, MeanIsThatOfTheCauchyPosterior) {
  Matrix2d information;
  information << 9.0, 3.0, 3.0, 4.0;
  for (const Vector2d& at : {Vector2d(0.2, 0.1), Vector2d(1.0, -0.5), Vector2d(3.0, 2.0), Vector2d(0.0, 5.0)}) {
    const Vector2d mean = seen(at, information).under(1.0).mean, exact = exactMean(at, information, 1.0);
    EXPECT_LT((mean - exact).norm(), 0.05 + 0.05 * exact.norm()) << at.transpose() << " gives " << mean.transpose();
  }
}

TEST(Slope, SteepOnesKeepTheirSlopeWhereAGaussianPriorWouldFlattenThem) {
  const Vector2d road(0.0, 8.0);
  const Matrix2d information = Matrix2d::Identity();  // a standard deviation of one
  EXPECT_LT((seen(road, information).under(1.0).mean - road).norm(), 0.5);
  EXPECT_LT(seen({0.0, 0.5}, information).under(1.0).mean.norm(), 0.25);  // and noise makes no slope
}

TEST(Slope, ObservationsAddUpInWhateverUnits) {
  Matrix2d first, second;
  first << 2.0, 0.5, 0.5, 1.0;
  second << 1.0, -0.2, -0.2, 3.0;
  const Vector2d a(1.0, 2.0), b(0.5, 2.5);
  Slope both = seen(a, first);
  both.see(second * b, second);
  const Slope at_once = seen((first + second).inverse() * (first * a + second * b), first + second);
  EXPECT_LT((both.under(0.7).mean - at_once.under(0.7).mean).norm(), 1e-12);
  const Slope::Estimate in_other = both.scaled(10.0).under(7.0), estimate = both.under(0.7);
  EXPECT_LT((in_other.mean - 10.0 * estimate.mean).norm(), 1e-9);
  EXPECT_LT((in_other.covariance - 100.0 * estimate.covariance).norm(), 1e-9);
}

}  // namespace
}  // namespace urban_nav_core
