// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/sensors/sight.hpp"

namespace urban_nav_input {

/// Finds the delay of a sensor's stamps relative to those of the images, s, by the turns of both: the delay within 0.5
/// s with the least sum of squared differences, after subtraction of a constant rate (a bias). Returns nullopt if no
/// delay explains the turns significantly better than one that a transfer takes (up to 50 ms), or the turns are not
/// correlated. `headings`: integrated heading of the sensor, rad, at `stamps`, in order of time.
std::optional<double> findTurnDelay(const std::vector<urban_nav_core::StampNs>& stamps,
                                    const std::vector<double>& headings, const std::vector<SeenMotion>& seen);

}  // namespace urban_nav_input
