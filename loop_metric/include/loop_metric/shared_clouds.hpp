// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/surroundings.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// Closures by clouds whose local clouds (Parameters::cloud_way) overlap at both ends hold the same beams and the same drift of odometry, and so the same error: what
/// they know is shared out among them. The information of each accepted one is divided by how many such there are, itself one, others by the product of the shares of their clouds
/// that they have in common.
void shareClouds(std::vector<urban_nav_core::MetricClosure>& closures, const Surroundings& surroundings,
                 const Parameters& parameters);

}  // namespace loop_metric
