// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/patch.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/specific_force.hpp"

namespace urban_nav_core {

/// The plain structs that states are made of, for Archive. They stand here and not beside each struct, so that what
/// only hands structs on needs no archive.
void archive(Archive& archive, Status& status);
void archive(Archive& archive, PoseWithCovariance& value);
void archive(Archive& archive, ConsideredConstant& value);
void archive(Archive& archive, ConsideredConstants& values);
/// Without the constants, which states of earlier versions lack.
void archive(Archive& archive, RelativePose& value);
void archive(Archive& archive, MotionInput& input);
void archive(Archive& archive, SpecificForce& value);
void archive(Archive& archive, Pinhole& camera);
void archive(Archive& archive, StereoCamera& camera);
void archive(Archive& archive, PatchSource& source);
void archive(Archive& archive, PatchTemplate& patch);

}  // namespace urban_nav_core
