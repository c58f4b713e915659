// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "urban_nav_core/trajectory/chi_square.hpp"

namespace urban_nav_core::testing {

/// EXPECT_TRUE(meanChiSquareFits(mean_nees, 6, 50)): is the mean of `count` independent chi-square variables of `dof`
/// degrees of freedom where it lies in 99 % of all cases? A wider band for tests with few runs: give the probability.
inline ::testing::AssertionResult meanChiSquareFits(double mean, double dof, double count, double probability = 0.99) {
  const Band band = chiSquareMeanBand(dof, count, probability);
  if (band.contains(mean)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "mean of " << count << " values is " << mean << ", expected " << band.low
                                       << "..." << band.high;
}

}  // namespace urban_nav_core::testing
