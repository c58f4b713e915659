// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "gravity/spans.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace pose_graph {

/// Gravity in the axes of the first pose, and the accelerometer's fault in base_link's, m/s2.
struct GravityFit {
  urban_nav_core::Vector6d x = urban_nav_core::Vector6d::Zero();
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Identity();
  double scatter = 0.0;  ///< of a number of a span's force about it, m/s2: from the median, so shocks are not in it

  Eigen::Vector3d gravity() const { return x.head<3>(); }
  Eigen::Vector3d residual(const Span& span) const { return span.force - x.head<3>() - span.rotation * x.tail<3>(); }
};

/// Least squares, reweighted (Huber 1964), from the medians of the forces. `spans` must not be empty; nothing where
/// they are not finite.
std::optional<GravityFit> fitGravity(const std::vector<Span>& spans);

}  // namespace pose_graph
