// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_sim::bench {

/// Values of one figure by frame, beam or second, unordered.
using Values = std::vector<double>;

double mean(const Values& values);
/// Standard deviation.
double spread(const Values& values);
/// Returns the quantile at `share`, 0 ... 1, with linear interpolation; 0 without values.
double quantile(Values values, double share);

/// Returns the earth mover's distance of two sets of values, in units of the spread of `real`. At most 0.5 is hardly
/// distinguishable within the spread. Infinite for an empty set, or if `real` has no spread and the sets differ.
double distributionDistance(const Values& simulated, const Values& real);

/// Returns "median (first ... ninth decile)" for a table cell.
std::string summary(const Values& values, int decimals);

}  // namespace urban_nav_sim::bench
