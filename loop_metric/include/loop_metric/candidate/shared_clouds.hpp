// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// Discounts the information that closures by clouds share: those whose local clouds (cloud_half_length) overlap at
/// both ends use the same beams and odometry, and have the same error. The information of each accepted one is divided
/// by the number of closures that share it, itself one, others by the product of the overlaps of their clouds.
void discountSharedClouds(std::vector<urban_nav_core::MetricClosure>& closures, const PlaceData& place_data,
                          const Parameters& parameters);

/// Discounts an accepted closure by clouds that arrives after others, whose verdicts are final. A closure covers a
/// square in the plane of the two travelled distances, at a and at b, two cloud_half_length wide. Its information is
/// multiplied by the share of the square that no earlier one covers, at least a thousandth: all closures together have
/// the information of the covered area, whatever their order. `earlier`: closures of any verdict and method; only those
/// accepted by clouds count.
void discountAgainst(urban_nav_core::MetricClosure& closure, const std::vector<urban_nav_core::MetricClosure>& earlier,
                     const PlaceData& place_data, const Parameters& parameters);

}  // namespace loop_metric
