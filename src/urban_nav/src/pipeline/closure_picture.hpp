// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "loop_metric/evidence.hpp"
#include "loop_metric/surroundings.hpp"
#include "report/page.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Were two views matched for this closure?
bool hasViews(const urban_nav_core::MetricClosure& closure);

/// The two views that decided, or that were tried first where none did, with their matches, from the evidence of the closure. Empty where no views were
/// matched, or what is known of them is damaged.
std::optional<PagePicture> pictureOf(const urban_nav_core::MetricClosure& closure,
                                     const loop_metric::Surroundings& surroundings);
/// The same of one try; `keyframe` gives the views, of a and of b.
std::optional<PagePicture> pictureOf(const loop_metric::Evidence::Try& views,
                                     const std::function<loop_metric::Keyframe(bool of_a)>& keyframe);

}  // namespace urban_nav
