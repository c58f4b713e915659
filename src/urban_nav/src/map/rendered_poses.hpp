// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/store.hpp"

namespace urban_nav {

// An edit moves poses without rendering: the chunks of a point map remain at the poses of their rendering. The store
// keeps a digest of those poses.

/// Records the stored poses as those at which the chunks of a session were rendered, unless a digest is recorded
/// already. Does not commit.
void noteRenderedPoses(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Removes the digest: the chunks of a session agree with its poses. Does not commit.
void forgetRenderedPoses(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns whether the poses of a session have changed since its chunks were rendered.
bool isRenderingOutdated(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav
