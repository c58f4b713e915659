// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace urban_nav_core {

/// Returns the probability that a standard normal variable exceeds z.
inline double normalUpperTail(double z) { return 0.5 * std::erfc(z * M_SQRT1_2); }

/// Returns the probability that a standard normal variable is at least |z| from zero, on either side.
inline double normalTwoSidedTail(double z) { return std::erfc(std::abs(z) * M_SQRT1_2); }

}  // namespace urban_nav_core
