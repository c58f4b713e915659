// SPDX-License-Identifier: BSD-3-Clause
#include "icp/free_space_violation.hpp"

#include <cmath>

namespace urban_nav_registration {

namespace {

/// Returns the planarity of vertical surfels in free space; poses relate them to the frame of the free space.
double within(const std::vector<Surfel>& surfels, const FreeSpace& space, const Pose& T_space_surfels) {
  const Eigen::Matrix3f R = T_space_surfels.R().cast<float>();
  const Eigen::Vector3f t = T_space_surfels.t().cast<float>();
  double sum = 0.0;
  for (const Surfel& surfel : surfels) {
    if (!(surfel.planarity > 0.0F) || !(std::abs(R.row(2).dot(surfel.normal)) < 0.5F)) continue;
    if (space.isFree(R * surfel.mean + t)) sum += static_cast<double>(surfel.planarity);
  }
  return sum;
}

}  // namespace

SeenThrough freeSpaceViolation(const std::vector<Surfel>& source, const std::vector<Surfel>& target,
                               const FreeSpace& of_source, const FreeSpace& of_target, const Refined& refined,
                               double inlier_distance) {
  SeenThrough seen;
  for (const Match& match : refined.matches)
    if (match.weight > 0.0 && std::abs(match.residual) < inlier_distance && std::abs(match.source_normal.z()) < 0.5)
      seen.confirmed += match.weight;
  seen.contradicted = 0.5 * (within(source, of_target, refined.T_target_source) +
                             within(target, of_source, refined.T_target_source.inverse()));
  return seen;
}

}  // namespace urban_nav_registration
