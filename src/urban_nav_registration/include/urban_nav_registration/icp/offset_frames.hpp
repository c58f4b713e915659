// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_registration/icp/align.hpp"

namespace urban_nav_registration {

/// Origins of two clouds in the coordinates of their files, m. align() is accurate near the origin only, and files may
/// have large coordinates.
struct CloudOffsets {
  urban_nav_core::Vector3d source = urban_nav_core::Vector3d::Zero(), target = urban_nav_core::Vector3d::Zero();
};

/// Returns T_target_source of the clouds relative to their offsets, from that of their files.
urban_nav_core::Pose relativeToOffsets(const urban_nav_core::Pose& T_target_source, const CloudOffsets& offsets);

/// Returns the alignment in the coordinates of the files, from that relative to the offsets: poses, information,
/// covariance and free directions. A small rotation displaces a distant origin by a large amount, which is included in
/// information and covariance.
Alignment toFileFrames(Alignment alignment, const CloudOffsets& offsets);

}  // namespace urban_nav_registration
