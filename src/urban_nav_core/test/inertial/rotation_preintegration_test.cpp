// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/inertial/rotation_preintegration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace urban_nav_core {
namespace {

constexpr double kStep = 0.005;  // s

Vector3d rateAt(double t) { return {0.4 * std::sin(1.3 * t), 0.3 * std::cos(2.1 * t), 0.8 + 0.5 * std::sin(0.7 * t)}; }

RotationPreintegration integrate(double seconds, const Vector3d& bias, double density = 1e-6) {
  RotationPreintegration integrated(bias);
  for (double t = 0.0; t < seconds - 0.5 * kStep; t += kStep) integrated.add(rateAt(t + 0.5 * kStep), kStep, density);
  return integrated;
}

TEST(RotationPreintegration, TurnsAboutOneAxisByTheRate) {
  RotationPreintegration integrated(Vector3d(0.0, 0.0, 0.1));
  for (int i = 0; i < 100; ++i) integrated.add({0.0, 0.0, 0.6}, 0.02, 4e-6);
  EXPECT_LT((logSo3(integrated.rotation()) - Vector3d(0.0, 0.0, 1.0)).norm(), 1e-12);
  EXPECT_NEAR(integrated.seconds(), 2.0, 1e-12);
  EXPECT_LT((integrated.covariance() - 8e-6 * Matrix3d::Identity()).norm(), 1e-8);
}

TEST(RotationPreintegration, AnotherBiasNeedsNoSecondIntegration) {
  const Vector3d bias(0.01, -0.02, 0.03), d(2e-4, -1e-4, 3e-4);
  const RotationPreintegration integrated = integrate(3.0, bias), again = integrate(3.0, bias + d);
  EXPECT_LT(integrated.rotation(bias + d).angularDistance(again.rotation()), 2e-7);
  EXPECT_GT(integrated.rotation().angularDistance(again.rotation()), 5e-4);
}

// A turn of 40 deg and a bias error of 0.1 rad/s make the residual large.
TEST(RotationPreintegration, ResidualHasExactJacobiansFarFromZero) {
  const RotationPreintegration integrated = integrate(1.5, Vector3d(0.01, 0.02, -0.01));
  const Quaterniond from = expSo3({0.3, -0.8, 1.9});
  const Quaterniond to = from * integrated.rotation() * expSo3({0.5, -0.4, 0.3});
  const Vector3d bias(0.11, -0.06, 0.07);
  const RotationResidual residual = rotationResidual(integrated, from, to, bias);
  EXPECT_GT(residual.e.norm(), 0.5);
  constexpr double kSmall = 1e-6;
  for (int c = 0; c < 3; ++c) {
    const Vector3d d = kSmall * Vector3d::Unit(c);
    const auto difference = [&](const auto& at) -> Vector3d { return (at(d).e - at(-d).e) / (2.0 * kSmall); };
    const Vector3d by_from =
        difference([&](const Vector3d& x) { return rotationResidual(integrated, expSo3(x) * from, to, bias); });
    const Vector3d by_to =
        difference([&](const Vector3d& x) { return rotationResidual(integrated, from, expSo3(x) * to, bias); });
    const Vector3d by_bias =
        difference([&](const Vector3d& x) { return rotationResidual(integrated, from, to, bias + x); });
    EXPECT_LT((by_from - residual.from.col(c)).norm(), 1e-7);
    EXPECT_LT((by_to - residual.to.col(c)).norm(), 1e-7);
    EXPECT_LT((by_bias - residual.bias.col(c)).norm(), 1e-7);
  }
}

TEST(RotationPreintegration, CovarianceIsThatOfNoisyRates) {
  constexpr double kDensity = 1e-4;  // rad^2/s
  constexpr int kTrials = 400;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const RotationPreintegration exact = integrate(1.0, Vector3d::Zero(), kDensity);
  double nees = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RotationPreintegration noisy;
    for (double t = 0.0; t < 1.0 - 0.5 * kStep; t += kStep) {
      const Vector3d noise = std::sqrt(kDensity / kStep) * Vector3d(normal(random), normal(random), normal(random));
      noisy.add(rateAt(t + 0.5 * kStep) + noise, kStep, kDensity);
    }
    const Vector3d d = logSo3(noisy.rotation().conjugate() * exact.rotation());
    nees += d.dot(noisy.covariance().inverse() * d);
  }
  // The mean of 400 chi-squares of 3 degrees of freedom: 3 +- 0.12.
  EXPECT_NEAR(nees / kTrials, 3.0, 0.5);
}

}  // namespace
}  // namespace urban_nav_core
