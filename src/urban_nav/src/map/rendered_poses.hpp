// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

// An edit moves poses without rendering: the chunks of a point map remain at the poses of their rendering. The store
// keeps those poses and their digest.

/// Records the stored poses as those at which the chunks of a session were rendered, unless a digest is recorded
/// already. Does not commit.
void noteRenderedPoses(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Removes the record: the chunks of a session agree with its poses. Does not commit.
void forgetRenderedPoses(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns whether the poses of a session have changed since its chunks were rendered.
bool isRenderingOutdated(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns the poses at which the chunks of a session were rendered, one for each pose of `current`, its stored
/// trajectory; nullopt if they are unknown, because the first edit was made by a program that recorded a digest only.
std::optional<std::vector<urban_nav_core::Pose>> renderedPoses(urban_nav_store::Store& store,
                                                               const urban_nav_store::StoredTrajectory& current);

}  // namespace urban_nav
