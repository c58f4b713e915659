// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "icp/observability.hpp"
#include "icp/refine.hpp"
#include "urban_nav_registration/icp/align.hpp"

namespace urban_nav_registration {

/// How well an alignment fits: what the classifier looks at.
struct Fit {
  double matches = 0.0;  ///< pieces of the source with a counterpart
  double inliers =
      0.0;  ///< share, by planarity, of the source's pieces within the inlier distance of their counterpart's plane
  double upright_inliers = 0.0;  ///< the same among those whose normals are level
  double upright = 0.0;          ///< the number of those
  double score() const;          ///< to compare alignments of the same clouds by
};
Fit computeFit(const std::vector<Surfel>& source, const Refined& refined, const Parameters& parameters);

/// What the matches of an alignment hold. `bias`: what all of a cloud's points may be off together, m.
/// `scan_plane`: normal of the plane of two planar scans, in the target frame.
Observability computeObservability(const Refined& refined, double bias, double voxel, const Parameters& parameters,
                                   const std::optional<Vector3d>& scan_plane);

/// What is known of an alignment beside how its surfaces fall upon each other.
struct ValidationContext {
  double misfit = 0.0;          ///< residual, as a multiple of what noise and bend explain
  double upright_misfit = 0.0;  ///< the same of upright surfaces
  /// Share of upright surfaces that beams of the other cloud went through; only of clouds that were gathered by
  /// odometry and know the origins of their beams and by how much they may be bent.
  std::optional<double> seen_through;
  /// Of clouds that know neither: a search found no other pose that fits nearly as well.
  bool is_alone = false;
};

/// Planar scans show some dozens of pieces of wall, of which a third falls upon those of any other place: what says
/// that the places are one.
struct PlanarEvidence {
  double evidence = 0.0;  ///< log-likelihood ratio of the pose to chance, or to the best different pose
  double least = 0.0;     ///< logarithm of the number of poses that were looked at
};
/// Log-likelihood ratio of as many pieces of wall within the inlier distance to as many as chance puts there.
double computePlanarEvidence(const Fit& fit, double share);
bool isPlausible(const ValidationContext& plausibility, const Parameters& parameters);

/// `plausibility`: none where only the surfaces are to be judged. Fills in the verdict, its reason, the tests,
/// information and covariance. `planar`: of planar scans.
void judge(const Fit& fit, const std::optional<ValidationContext>& plausibility,
           const std::optional<PlanarEvidence>& planar, const Refined& refined, const Observability& observed,
           const Parameters& parameters, Alignment& alignment);

/// No pose: nothing is known of any direction.
void reject(Alignment& alignment, AlignmentReason reason, const std::string& sentence);

}  // namespace urban_nav_registration
