// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/closure_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pose_graph {
namespace {

// Of one standard deviation as stated, in one direction.
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

TEST(TrueResidual, IsNormalWhereInformationIsRightOrBoasts) {
  for (const double variance : {1.0, 4.0})
    for (const double residual : {0.0, 1.0, 10.0})
      EXPECT_NEAR(std::log(density(residual, variance)),
                  -0.5 * std::log(2.0 * M_PI * variance) - 0.5 * residual * residual / variance, 1e-12);
}

TEST(TrueResidual, FarOutIsWhatModestInformationStates) {
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

}  // namespace
}  // namespace pose_graph
