// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "window/sensor_model.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Robust optimisation of the newest pose with fixed landmarks (motion-only bundle adjustment). Gauss-Newton over the
/// window then starts with residuals at the level of the noise, so that its first factor has the right weights and can
/// be reused in all iterations. Landmarks observed by the newest pose only move with it.
void optimiseNewestPose(State& state, const SensorModel& sensor, double huber);

}  // namespace swf_vo
