// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/store.hpp"

namespace urban_nav {

// An edit moves poses and renders nothing: the chunks of a map of points stay where the poses were when they were
// rendered. What a store notes of that is a digest of those poses.

/// Notes that the chunks of a session lie along the poses that the store holds, unless it is noted already where they
/// lie. Does not commit.
void noteRenderedPoses(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Declares that the chunks of a session lie where its poses are. Does not commit.
void forgetRenderedPoses(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);
/// Returns whether the poses of a session have changed since its chunks were rendered.
bool isRenderingOutdated(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav
