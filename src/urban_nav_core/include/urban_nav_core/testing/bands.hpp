// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "urban_nav_core/trajectory/chi_square.hpp"

namespace urban_nav_core::testing {

/// EXPECT_TRUE(meanChiSquareFits(mean_nees, 6, 50)): tests whether the mean of `count` independent chi-square variables
/// of `dof` degrees of freedom is within its two-sided interval of this probability. Use a larger probability for tests
/// with few runs.
inline ::testing::AssertionResult meanChiSquareFits(double mean, double dof, double count, double probability = 0.99) {
  const Band band = chiSquareMeanBand(dof, count, probability);
  if (band.contains(mean)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "mean of " << count << " values is " << mean << ", expected " << band.low
                                       << "..." << band.high;
}

}  // namespace urban_nav_core::testing
