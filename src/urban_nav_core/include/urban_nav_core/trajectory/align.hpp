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
  /// The pose with its position moved and its rotation turned.
  Pose operator*(const Pose& pose) const;
};

/// First pose onto first pose.
Similarity alignFirst(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);

/// The rigid motion, or similarity, that brings the estimated positions closest to the true ones in the mean square
/// (Umeyama, "Least-squares estimation of transformation parameters between two point patterns", PAMI 1991). Where the
/// positions lie on a line or in one point, the rotation that they leave open is the one that brings the first pose's
/// heading closest to the truth's; where the estimate stands still, the scale is 1. Both vectors equally long and not
/// empty.
Similarity alignSe3(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);
Similarity alignSim3(const std::vector<Pose>& truth, const std::vector<Pose>& estimate);

bool isApprox(const Similarity& a, const Similarity& b, double tolerance);
std::ostream& operator<<(std::ostream& out, const Similarity& similarity);

}  // namespace urban_nav_core
