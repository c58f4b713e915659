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

/// The same where closures are judged one after another and none can be taken back: an accepted closure by clouds keeps the share of its information
/// that those accepted before it have not told. What a closure rests on is a square in the plane of the two ways, at a and at b, two cloud_way wide; what is new is
/// the part of it that no earlier square covers. So all of them together tell the area that they cover over that of one, whatever their order. What adds nothing keeps a
/// thousandth, which shows that it agrees and weighs nothing. `earlier`: with any verdict and method; those that are not accepted, or not by clouds, take no part.
void keepWhatIsNew(urban_nav_core::MetricClosure& closure, const std::vector<urban_nav_core::MetricClosure>& earlier,
                   const Surroundings& surroundings, const Parameters& parameters);

}  // namespace loop_metric
