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

/// How closely a search looks.
struct Grain {
  double cell;       ///< m of the pictures from above
  int headings;      ///< all around
  std::size_t most;  ///< pieces of the source
};
/// What the alignment that follows mends, with room to spare: 2 deg are half a metre at 15 m, where half of a scan's surfaces are.
constexpr Grain kFine{0.5, 180, 1200};
/// A look around that costs a thirtieth: is there anything else at all?
constexpr Grain kCoarse{1.0, 72, 300};

/// What stands upright in a cloud (walls, trunks, cars: pieces whose normals are level), seen from above: all that a search looks at.
struct Outline {
  struct Piece {
    double x, y, bearing;  ///< m, m, rad of its normal; z up
  };
  std::vector<Piece> pieces;
  Eigen::Matrix3f level = Eigen::Matrix3f::Identity();  ///< turns the cloud so that z is up
  float ground = 0.0F;                                  ///< m, of the ground around the sensor
  bool has_ground = false;
};
Outline outlineOf(const Surfels& surfels, const Grain& grain);

/// Poses from which an alignment is worth a try, best first, different from each other: any heading, the source's origin within `radius` (m) of
/// `centre`. The outline of the source, turned to each heading, is laid over that of the target at every shift; pieces count where the direction of their walls agrees. Whole
/// numbers throughout: the result does not depend on the order of work. Both outlines are of this grain.
std::vector<Candidate> searchGlobally(const Outline& source, const Outline& target, const Eigen::Vector3d& centre,
                                      double radius, const Grain& grain);

}  // namespace loop_metric
