// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "swf_vo/frame.hpp"
#include "urban_nav_core/motion/motion_sensors.hpp"
#include "window/process_model.hpp"

namespace swf_vo {

/// Returns the motion of the left camera between two stamps from the motion sensors in use, with zero information in
/// the remaining directions; nullopt without any. `T_odom_camera`: at `from`.
std::optional<ProcessInput> predictCamera(const urban_nav_core::MotionSensors& sensors, urban_nav_core::StampNs from,
                                          urban_nav_core::StampNs to, const urban_nav_core::Pose& T_odom_camera,
                                          const urban_nav_core::Pose& T_base_camera);

/// Conversions to a step of base_link: of a settled frame, and of the left camera (`T_from_to`).
urban_nav_core::MeasuredStep toMeasuredStep(const Settled& settled);
urban_nav_core::MeasuredStep toMeasuredStep(urban_nav_core::StampNs from, urban_nav_core::StampNs to,
                                            const urban_nav_core::Pose& T_from_to,
                                            const urban_nav_core::Pose& T_base_camera);

}  // namespace swf_vo
