// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/numeric_jacobian.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_core::testing {
namespace {

using Eigen::Vector2d;

TEST(NumericJacobian, OfVectorsAndNumbers) {
  const auto f = [](const Vector2d& x) -> Vector2d { return {x.x() * x.x() * x.y(), std::sin(x.y())}; };
  Eigen::Matrix2d expected;
  expected << 2.0 * 1.5 * 0.7, 1.5 * 1.5, 0.0, std::cos(0.7);
  EXPECT_LE((numericJacobian<2, 2>(f, Vector2d(1.5, 0.7)) - expected).norm(), 1e-11);
  EXPECT_NEAR((numericJacobian<1, 1>([](double x) { return std::exp(x); }, 1.0)(0, 0)), std::exp(1.0), 1e-11);
}

TEST(NumericJacobian, OfRotationsAndPoses) {
  const Quaterniond q = expSo3({0.3, -0.4, 2.0});
  EXPECT_LE((numericJacobian<3, 3>([](const Quaterniond& x) { return x; }, q) - Matrix3d::Identity()).norm(), 1e-11);
  const Pose T(q, {1, 2, 3});
  EXPECT_LE((numericJacobian<6, 6>([](const Pose& x) { return x; }, T) - Matrix6d::Identity()).norm(), 1e-11);
}

TEST(NumericJacobian, FindsATermThatIsLeftOut) {
  const auto f = [](const Vector2d& x) -> Vector2d { return x + 1e-6 * Vector2d(x.y(), 0.0); };
  EXPECT_GT((numericJacobian<2, 2>(f, Vector2d(1.0, 2.0)) - Eigen::Matrix2d::Identity()).norm(), 0.9e-6);
}

}  // namespace
}  // namespace urban_nav_core::testing
