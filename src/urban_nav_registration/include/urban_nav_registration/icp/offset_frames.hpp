// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_registration/icp/align.hpp"

namespace urban_nav_registration {

/// Origins of two clouds in the coordinates of their files, m: align() is exact near the origin only, files are not
/// bound to it.
struct CloudOffsets {
  urban_nav_core::Vector3d source = urban_nav_core::Vector3d::Zero(), target = urban_nav_core::Vector3d::Zero();
};

/// Returns T_target_source of the clouds relative to their offsets, from that of their files.
urban_nav_core::Pose relativeToOffsets(const urban_nav_core::Pose& T_target_source, const CloudOffsets& offsets);

/// Returns the alignment of the files, from that of the clouds relative to their offsets: poses, information,
/// covariance and free directions. A small rotation moves a far origin a long way: information and covariance follow
/// it.
Alignment toFileFrames(Alignment alignment, const CloudOffsets& offsets);

}  // namespace urban_nav_registration
