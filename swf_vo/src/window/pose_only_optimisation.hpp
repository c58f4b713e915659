// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "window/sensor_model.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Robust optimisation of the newest pose alone, with landmarks fixed (motion-only bundle adjustment). Gauss-Newton
/// over everything then begins where residuals are of the size of their noise, so that its first factor has the right
/// weights and can serve to the end. Landmarks that only the newest pose has seen move with it.
void optimiseNewestPose(State& state, const SensorModel& sensor, double huber);

}  // namespace swf_vo
