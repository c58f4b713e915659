// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/image/patch.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/specific_force.hpp"

namespace urban_nav_core {

/// Archive functions of the plain structs in types/. They are declared here rather than beside each struct, so that
/// code which only passes the structs on does not depend on Archive.
void archive(Archive& archive, Status& status);
void archive(Archive& archive, PoseWithCovariance& value);
void archive(Archive& archive, ConsideredConstant& value);
void archive(Archive& archive, ConsideredConstants& values);
/// Reads or writes all members but the constants, which states of earlier versions lack.
void archive(Archive& archive, RelativePose& value);
void archive(Archive& archive, MotionInput& input);
void archive(Archive& archive, SpecificForce& value);
void archive(Archive& archive, Pinhole& camera);
void archive(Archive& archive, StereoCamera& camera);
void archive(Archive& archive, PatchSource& source);
void archive(Archive& archive, PatchTemplate& patch);

}  // namespace urban_nav_core
