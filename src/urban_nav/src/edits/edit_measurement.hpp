// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>

#include "base/parameter_set.hpp"
#include "edits/edited_map.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Measures the transform between two stored poses from the views and scans that the store holds, as stage loops does.
/// `a` and `b`: sessions by their ids.
urban_nav_core::MetricClosure measurePair(urban_nav_store::Store& store, const StoredMeasurements& measurements,
                                          const ParameterSet& parameters, const urban_nav_store::NodeRef& a,
                                          const urban_nav_store::NodeRef& b);

/// Returns the stamp of the stored view of the left camera nearest to a pose; nullopt if it is further away than
/// `within`, s.
std::optional<urban_nav_core::StampNs> findNearestView(urban_nav_store::Store& store,
                                                       const urban_nav_store::NodeRef& at, double within);

/// Returns the stored view of the left camera nearest to a pose, its stamp, and the point in base_link that it shows at
/// a pixel. Throws UserError if there is no view within 1 s, or no point within some pixels.
struct SeenPoint {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector3d p_base = Eigen::Vector3d::Zero();
};
SeenPoint findSeenPoint(urban_nav_store::Store& store, const StoredMeasurements& measurements,
                        const urban_nav_store::NodeRef& at, double u, double v);

}  // namespace urban_nav
