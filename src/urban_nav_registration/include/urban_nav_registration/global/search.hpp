// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// Candidate pose, accurate to half a metre and a few degrees.
struct PoseCandidate {
  urban_nav_core::Pose T_target_source;
  double score = 0.0;  ///< 0...1, approximate overlap of the vertical structures
};

/// Resolution of a search.
struct SearchResolution {
  double cell;       ///< m, of the grid seen from above
  int headings;      ///< number of headings in a full turn
  std::size_t most;  ///< maximum number of pieces of the source
};
/// Within the convergence basin of the alignment: 2 deg are half a metre at 15 m, the median distance of surfaces.
constexpr SearchResolution kFineResolution{0.5, 180, 1200};
/// Thirty times faster; for the detection of alternatives.
constexpr SearchResolution kCoarseResolution{1.0, 72, 300};

/// Vertical surfaces of a cloud (walls, trunks, cars), projected to the horizontal plane: input of the search.
struct VerticalStructure {
  struct Piece {
    double x, y, bearing;  ///< m, m, rad of its normal; z up
  };
  std::vector<Piece> pieces;
  Eigen::Matrix3f level = Eigen::Matrix3f::Identity();  ///< rotation that aligns z with the vertical
  float ground = 0.0F;                                  ///< height of the ground around the sensor, m
  bool has_ground = false;
};
/// Extracts the vertical structure for a search at a resolution. Thread-safe.
VerticalStructure extractVerticalStructure(const Surfels& surfels, const SearchResolution& grain);

/// Returns distinct candidate poses for alignment, best first: any heading, the origin of the source within `radius`
/// (m) of `centre`. The structure of the source, rotated to each heading, is correlated with that of the target at
/// every shift; pieces match if the directions of their walls agree. Integer arithmetic: the result does not depend on
/// the order of operations. Requires that both structures have this resolution. Thread-safe.
std::vector<PoseCandidate> searchGlobally(const VerticalStructure& source, const VerticalStructure& target,
                                          const Eigen::Vector3d& centre, double radius, const SearchResolution& grain);

}  // namespace urban_nav_registration
