// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "gravity/spans.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace pose_graph {

/// Gravity in the axes of the first pose, and accelerometer bias in the axes of base_link, m/s2.
struct GravityFit {
  urban_nav_core::Vector6d x = urban_nav_core::Vector6d::Zero();
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Identity();
  /// Standard deviation of a component of a span's force, m/s2; from the median, hence without shocks.
  double scatter = 0.0;

  Eigen::Vector3d gravity() const { return x.head<3>(); }
  Eigen::Vector3d residual(const Span& span) const { return span.force - x.head<3>() - span.rotation * x.tail<3>(); }
};

/// Fits by iteratively reweighted least squares (Huber 1964), starting from the medians of the forces. Requires:
/// `spans` is not empty. Returns nullopt if the values are not finite.
std::optional<GravityFit> fitGravity(const std::vector<Span>& spans);

}  // namespace pose_graph
