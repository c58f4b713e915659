// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "live/nodelet_parameters.hpp"
#include "segway_drivers/camera/sim_source.hpp"

namespace segway_drivers {

/// Returns the options of a simulated camera for these parameters of its nodelet. Its session starts with those of the
/// other devices of the launch. Throws UserError if they cannot agree on the start.
SimCameraOptions simulatedCameraOptions(const NodeletParameters& parameters, SimCameraOptions::Model model);

}  // namespace segway_drivers
