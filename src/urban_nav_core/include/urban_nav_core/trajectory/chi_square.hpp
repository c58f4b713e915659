// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav_core {

/// Probability that a chi-square variable of `dof` degrees of freedom (any number above zero) is at most x.
double chiSquareProbability(double x, double dof);
/// The x at which that probability is reached, 0 < probability < 1; exact to 1e-10 of its value.
double chiSquareQuantile(double probability, double dof);

/// Where the mean of `count` independent chi-square variables lies with the given probability, the rest shared between
/// both ends: what a mean NEES is held against (Bar-Shalom, Li, Kirubarajan, Estimation with Applications to Tracking
/// and Navigation, section 5.4).
struct Band {
  double low = 0.0, high = 0.0;
  bool contains(double value) const { return value >= low && value <= high; }
};
Band chiSquareMeanBand(double dof, double count, double probability);

}  // namespace urban_nav_core
