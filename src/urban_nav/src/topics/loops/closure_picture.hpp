// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "base/page.hpp"
#include "loop_metric/evidence.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Is there a try of this closure that can be shown?
bool hasPicture(const urban_nav_core::MetricClosure& closure);

/// The try that decided, or the first where none did, from the evidence of the closure: two views with their matches,
/// or two clouds before and after their alignment. `way`: loop_metric's cloud_half_length. Empty where nothing was
/// tried, or what is known of it is damaged.
std::optional<PagePicture> toPicture(const urban_nav_core::MetricClosure& closure,
                                     const loop_metric::PlaceData& place_data, double way);
/// The same of one try.
std::optional<PagePicture> toPicture(const loop_metric::Evidence::Try& tried, const loop_metric::PlaceData& place_data,
                                     double way);

}  // namespace urban_nav
