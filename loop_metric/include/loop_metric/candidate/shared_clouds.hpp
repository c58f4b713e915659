// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// Discounts the information shared by closures by clouds: those whose local clouds (cloud_half_length) overlap at both
/// ends use the same beams and odometry, so that their errors are equal. The information of each accepted one is
/// divided by the number of closures that share it: itself counts as one, others by the product of the overlaps of
/// their clouds.
void discountSharedClouds(std::vector<urban_nav_core::MetricClosure>& closures, const PlaceData& place_data,
                          const Parameters& parameters);

/// Discounts an accepted closure by clouds relative to earlier closures, whose verdicts are final. A closure covers a
/// square in the plane of the two path distances, at a and at b, with side two cloud_half_length. Its information is
/// multiplied by the share of the square not covered by earlier ones, at least a thousandth: all closures together have
/// the information of the covered area, independent of their order. `earlier`: closures of any verdict and method; only
/// those accepted by clouds count.
void discountAgainst(urban_nav_core::MetricClosure& closure, const std::vector<urban_nav_core::MetricClosure>& earlier,
                     const PlaceData& place_data, const Parameters& parameters);

}  // namespace loop_metric
