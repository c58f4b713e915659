// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "base/page.hpp"
#include "loop_metric/evidence.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Returns whether the closure has a registration attempt that can be drawn.
bool hasPicture(const urban_nav_core::MetricClosure& closure);

/// Draws the decisive registration attempt of a closure, or the first one without, from its evidence: two views with
/// their matches, or two clouds before and after alignment. `way`: registration.cloud_half_length, m. nullopt without
/// an attempt or with damaged evidence.
std::optional<PagePicture> toPicture(const urban_nav_core::MetricClosure& closure,
                                     const loop_metric::PlaceData& place_data, double way);
/// Draws one registration attempt.
std::optional<PagePicture> toPicture(const loop_metric::Evidence::Try& tried, const loop_metric::PlaceData& place_data,
                                     double way);

}  // namespace urban_nav
