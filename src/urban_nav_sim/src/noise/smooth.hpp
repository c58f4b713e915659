// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Returns band-limited noise: a cubic B-spline with one normal coefficient at every integer `x` (and `y`), hence twice
/// differentiable with little power above half a cycle per unit. Mean 0 and, over many positions, variance 1; |x| <
/// 2^31.
double smoothNoise(const Noise& noise, double x);
double smoothNoise(const Noise& noise, double x, double y);

}  // namespace urban_nav_sim
