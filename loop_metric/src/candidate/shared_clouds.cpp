// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/shared_clouds.hpp"

#include <algorithm>

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;

void shareClouds(std::vector<MetricClosure>& closures, const Surroundings& surroundings, const Parameters& parameters) {
  const double length = 2.0 * parameters.cloud_way;
  // Share of the cloud around one moment that is in the cloud around the other.
  const auto common = [&](const PoseRef& x, const PoseRef& y) {
    const auto way = surroundings.between(x, y);
    return way ? std::max(0.0, 1.0 - way->length / length) : 0.0;
  };
  std::vector<std::size_t> of_clouds;
  for (std::size_t i = 0; i < closures.size(); ++i)
    if (closures[i].verdict == ClosureVerdict::Accepted && closures[i].method == ClosureMethod::Icp)
      of_clouds.push_back(i);
  std::vector<double> sharing(of_clouds.size(), 1.0);
  for (std::size_t i = 0; i < of_clouds.size(); ++i)
    for (std::size_t j = i + 1; j < of_clouds.size(); ++j) {
      const MetricClosure &one = closures[of_clouds[i]], &other = closures[of_clouds[j]];
      const double both =
          std::max(common(one.a, other.a) * common(one.b, other.b), common(one.a, other.b) * common(one.b, other.a));
      sharing[i] += both;
      sharing[j] += both;
    }
  for (std::size_t i = 0; i < of_clouds.size(); ++i) closures[of_clouds[i]].measured.information /= sharing[i];
}

}  // namespace loop_metric
