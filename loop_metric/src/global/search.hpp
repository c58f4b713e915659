// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cloud/surfels.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace loop_metric {

/// A pose that may be right to half a metre and a few degrees.
struct Candidate {
  urban_nav_core::Pose T_target_source;
  double score = 0.0;  ///< 0...1, the share of the source's upright pieces that fall on one of the target's, roughly
};

/// Poses from which an alignment is worth a try, best first, different from each other: any heading, the source's origin within `radius` (m) of
/// `centre`. What stands upright in the source (walls, trunks, cars: pieces whose normals are level), seen from above and turned to each
/// heading, is laid over that of the target at every shift; pieces count where the direction of their walls agrees. Whole numbers
/// throughout: the result does not depend on the order of work.
std::vector<Candidate> searchGlobally(const Surfels& source, const Surfels& target, const Eigen::Vector3d& centre,
                                      double radius);

}  // namespace loop_metric
