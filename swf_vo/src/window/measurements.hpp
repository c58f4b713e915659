// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "observation.hpp"
#include "window/sensor_model.hpp"
#include "window/state.hpp"

namespace swf_vo::measurements {

/// Changes of the state between two updates. The contracts are those of Window.
bool fixLandmark(State& state, const MapPoint& point);
bool observe(State& state, const SensorModel& sensor, const Observation& observation);
bool withdraw(State& state, LandmarkId landmark, FrameId frame);
/// Replaces the measurements of a frame.
void replace(State& state, const SensorModel& sensor, FrameId frame, const std::vector<Observation>& observations);

/// Initialises a landmark by stereo triangulation (Newman et al. 2009, section 2.2.1) from the current estimate of the
/// pose.
void place(State& state, const SensorModel& sensor, int slot, const Measurement& first);
/// Returns the measurement corrected by the disparity offset.
Eigen::Vector3d withoutOffset(const State& state, const Eigen::Vector3d& z);
/// Resets diverged landmarks that are no longer constrained to their linearisation points; returns whether there was
/// one.
bool undoAbsurd(State& state);

}  // namespace swf_vo::measurements
