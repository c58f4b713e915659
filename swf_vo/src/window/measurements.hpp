// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "observation.hpp"
#include "window/sensor_model.hpp"
#include "window/state.hpp"

namespace swf_vo::measurements {

/// What goes into the state, and out of it again, between two updates. The contracts are those of Window.
bool fixLandmark(State& state, const MapPoint& point);
bool observe(State& state, const SensorModel& sensor, const Observation& observation);
bool withdraw(State& state, LandmarkId landmark, FrameId frame);
/// The measurements of a frame become these.
void replace(State& state, const SensorModel& sensor, FrameId frame, const std::vector<Observation>& observations);

/// Initial values of a landmark are computed via stereo (Newman et al. 2009, section 2.2.1), from the pose as it is
/// estimated now.
void place(State& state, const SensorModel& sensor, int slot, const Measurement& first);
/// The measurement of a camera whose disparity offset is none.
Eigen::Vector3d withoutOffset(const State& state, const Eigen::Vector3d& z);
/// A landmark that nothing holds any more goes back to where it was linearised; true if there was one.
bool undoAbsurd(State& state);

}  // namespace swf_vo::measurements
