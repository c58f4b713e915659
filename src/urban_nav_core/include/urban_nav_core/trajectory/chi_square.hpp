// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav_core {

/// Returns the probability that a chi-square variable of `dof` degrees of freedom (any positive number) is at most x.
double chiSquareProbability(double x, double dof);
/// Returns the inverse of chiSquareProbability(), 0 < probability < 1, with a relative error of 1e-10.
double chiSquareQuantile(double probability, double dof);

/// Two-sided interval of the mean of `count` independent chi-square variables at a given probability; the test of a
/// mean NEES (Bar-Shalom, Li, Kirubarajan, Estimation with Applications to Tracking and Navigation, section 5.4).
struct Band {
  double low = 0.0, high = 0.0;
  bool contains(double value) const { return value >= low && value <= high; }
};
Band chiSquareMeanBand(double dof, double count, double probability);

}  // namespace urban_nav_core
