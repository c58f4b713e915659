// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "map/stage.hpp"
#include "topics/lasers/session_calibration.hpp"

namespace urban_nav {

/// Calibrations of the sessions of a run along odometry, from stage calibration for stage lasers.
using SharedCalibrations = std::shared_ptr<std::vector<SessionCalibration>>;

/// Returns the stage calibration, with --calibrate: calibrates the lasers of each session along its odometry, before
/// closures are measured with them. Stage lasers repeats the calibration along the relaxed trajectory. Appends to
/// `calibrations`.
std::unique_ptr<Stage> makeCalibrationStage(SharedCalibrations calibrations);

/// Returns the stage that stores sweeps of 3D LiDARs for the map, closures and localization, and images of depth
/// cameras for the map.
std::unique_ptr<Stage> makeSweepsStage();

/// Returns the stage that renders the laser scans of all sessions along their trajectories into map.ply.
/// `along_odometry`: calibrations of stage calibration in the same run.
std::unique_ptr<Stage> makeLasersStage(SharedCalibrations along_odometry);

}  // namespace urban_nav
