// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// p_truth = scale R p_estimate + t.
struct Similarity {
  double scale = 1.0;
  Pose T_truth_estimate;

  Vector3d operator*(const Vector3d& p) const { return scale * (T_truth_estimate.q() * p) + T_truth_estimate.t(); }
  /// Returns the transformed pose: position and rotation.
  Pose operator*(const Pose& pose) const;
};

/// Returns the transform that aligns the first poses.
Similarity alignFirst(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);

/// Return the rigid motion or similarity that minimises the mean squared distance of estimated and true positions
/// (Umeyama, "Least-squares estimation of transformation parameters between two point patterns", PAMI 1991). If the
/// positions are collinear or coincide, the undetermined rotation aligns the heading of the first poses; if the
/// estimate does not move, the scale is 1. Both vectors must be equally long and not empty.
Similarity alignSe3(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);
Similarity alignSim3(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);

bool isApprox(const Similarity& a, const Similarity& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const Similarity& similarity);

}  // namespace urban_nav_core
