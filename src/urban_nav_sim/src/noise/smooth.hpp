// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Noise that changes slowly: one normal number at every whole `x` (and `y`) under cubic B-splines, so twice
/// differentiable with hardly anything above half a cycle per unit. Mean 0 and, over many places, variance 1; |x| <
/// 2^31.
double smoothNoise(const Noise& noise, double x);
double smoothNoise(const Noise& noise, double x, double y);

}  // namespace urban_nav_sim
