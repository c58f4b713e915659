// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cloud/surfel_index.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_registration {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

/// A source surfel and its counterpart in the target, in the target frame.
struct Match {
  Vector3d lever = Vector3d::Zero();          ///< R p_source: relative to the source's origin
  Vector3d source_normal = Vector3d::Zero();  ///< rotated to the target frame, on the side of the target normal
  Vector3d target_normal = Vector3d::Zero();
  double residual = 0.0;  ///< target_normal . (T p_source - p_target), m: signed distance from the plane
  double weight = 0.0;    ///< product of the planarities; 0: no match, and the other members are undefined
};

/// Derivative of the residual by (rho, phi) of T_target_source = [Exp(phi) R, t + rho] for a plane of this normal: (n,
/// lever x n).
inline Vector6d planeJacobian(const Vector3d& lever, const Vector3d& normal) {
  const Vector3d turn = lever.cross(normal);
  return (Vector6d() << normal.x(), normal.y(), normal.z(), turn.x(), turn.y(), turn.z()).finished();
}

/// Finds the counterparts of source surfels for successive poses. A counterpart is searched again only if the surfel
/// has moved by more than its margin, which near convergence is rare (Greenspan and Godin 2001). The rotation of its
/// normal in between is neglected: it changes two counterparts in ten thousand, near 45 deg, and the pose by microns.
/// Source and target must outlive this object.
class Matcher {
 public:
  Matcher(const std::vector<Surfel>& source, const SurfelIndex& target) : source_(source), target_(target) {}

  /// Returns matches in the order of the source; surfels of planarity 0 and those without a counterpart have weight 0.
  void match(const Pose& T_target_source, std::vector<Match>& matches);

 private:
  struct Held {
    SurfelIndex::Nearest nearest;
    Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< point at the search
  };
  const std::vector<Surfel>& source_;
  const SurfelIndex& target_;
  std::vector<Held> held_;
};

/// Sums of the robust normal equations H d = -b of the cost weight * sigma^2 log(1 + (r / sigma)^2): Cauchy weights 1 /
/// (1 + (r / sigma)^2).
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double weight = 0.0;  ///< sum of weights, before the robust ones

  NormalEquations& operator+=(const NormalEquations& other);
};
NormalEquations sumUp(const std::vector<Match>& matches, double sigma);

/// Returns 1.4826 times the weighted median of the absolute residuals: the standard deviation of a Gaussian, m. 0
/// without matches.
double computeSpread(const std::vector<Match>& matches);

}  // namespace urban_nav_registration
