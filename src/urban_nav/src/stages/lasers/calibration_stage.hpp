// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "stage/stage.hpp"

namespace urban_nav {

/// Returns the stage calibration, with --calibrate: calibrates the lasers of each session along its odometry, before
/// closures are measured with them. Stage lasers does so once more along the relaxed trajectory. Sets
/// MapContext::calibrations.
std::unique_ptr<Stage> makeCalibrationStage();

}  // namespace urban_nav
