// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "icp/observability.hpp"
#include "icp/refine.hpp"
#include "urban_nav_registration/icp/align.hpp"

namespace urban_nav_registration {

/// Fit of an alignment: input of the classifier.
struct Fit {
  double matches = 0.0;  ///< surfels of the source with a counterpart
  double inliers = 0.0;  ///< share of the source's surfels, weighted by planarity, within the inlier distance of the
                         ///< counterpart's plane
  double upright_inliers = 0.0;  ///< the same share among surfels with horizontal normals
  double upright = 0.0;          ///< number of these
  double score() const;          ///< score for the comparison of alignments of the same clouds
};
Fit computeFit(const std::vector<Surfel>& source, const Refined& refined, const Parameters& parameters);

/// Computes the observability of an alignment. `bias`: error common to all points of a cloud, m. `scan_plane`: normal
/// of the plane of two planar scans, in the target frame.
Observability computeObservability(const Refined& refined, double bias, double voxel, const Parameters& parameters,
                                   const std::optional<Vector3d>& scan_plane);

/// Information on an alignment besides the fit of its surfaces.
struct ValidationContext {
  double misfit = 0.0;          ///< ratio of the residual to that expected from noise and deformation
  double upright_misfit = 0.0;  ///< the same ratio for vertical surfaces
  /// Share of vertical surfaces that beams of the other cloud passed through; only for local clouds, which have beam
  /// origins and a known deformation.
  std::optional<double> seen_through;
  /// For other clouds: a search found no other pose with a similar fit.
  bool is_alone = false;
};

/// Evidence that two planar scans show the same place: they have a few dozen pieces of wall, of which a third coincide
/// with those of any other place.
struct PlanarEvidence {
  double evidence = 0.0;  ///< log-likelihood ratio of the pose to chance, or to the best different pose
  double least = 0.0;     ///< logarithm of the number of poses tested
};
/// Returns the log-likelihood ratio of the number of wall pieces within the inlier distance to the number expected by
/// chance.
double computePlanarEvidence(const Fit& fit, double share);
bool isPlausible(const ValidationContext& plausibility, const Parameters& parameters);

/// Sets verdict, reason, tests, information and covariance. `plausibility`: nullopt if only the surfaces are tested.
/// `planar`: for planar scans.
void judge(const Fit& fit, const std::optional<ValidationContext>& plausibility,
           const std::optional<PlanarEvidence>& planar, const Refined& refined, const Observability& observed,
           const Parameters& parameters, Alignment& alignment);

/// Sets a rejected result without information in any direction.
void reject(Alignment& alignment, AlignmentReason reason, const std::string& sentence);

}  // namespace urban_nav_registration
