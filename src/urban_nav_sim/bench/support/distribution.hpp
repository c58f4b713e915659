// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_sim::bench {

/// Values of one figure: what frames, beams or seconds said, in no order.
using Values = std::vector<double>;

double mean(const Values& values);
/// Standard deviation.
double spread(const Values& values);
/// `share`: 0 ... 1; linear between neighbours. 0 of no values.
double quantile(Values values, double share);

/// Earth mover's distance of two sets of values, in units of the spread of `real`: how far a value has to go on average
/// to make one set of the other. 0.5 and less is hard to see beside the spread. Infinite where a set is empty, or
/// `real` has no spread and the other is elsewhere.
double distributionDistance(const Values& simulated, const Values& real);

/// "median (tenth ... ninth decile)", for a cell.
std::string summary(const Values& values, int decimals);

}  // namespace urban_nav_sim::bench
