// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dense_stereo/points.hpp"

namespace dense_stereo {

/// Why there is a ground plane, or none.
enum class GroundVerdict : int {
  Found = 0,
  TooFewPoints,  ///< fewer points within range than a plane needs
  NoPlane,       ///< no plane near the expected direction has enough support
  NotPlanar,     ///< steps or a break in the slope: much of the ground is off the best plane
};
const char* toString(GroundVerdict verdict);

/// The plane up . p + height = 0 through the ground, in the left optical frame: `height` is that of the camera above
/// it.
///
/// WARNING: `covariance` is of (up, height) and singular, since `up` has unit length. It counts a window of alignment
/// as one measurement, and holds the errors of the disparities only, not those of the calibration.
struct GroundPlane {
  GroundVerdict verdict = GroundVerdict::TooFewPoints;
  std::string sentence;                                  ///< why there is none; empty if found
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();        ///< unit normal, away from the ground
  double height = 0.0;                                   ///< m
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of (up, height), 1 and m
  double support = 0.0;                                  ///< share of the ground's area that lies on the plane

  bool isFound() const { return verdict == GroundVerdict::Found; }
};

/// What the search starts from.
struct GroundOptions {
  /// Opposite of gravity in the left optical frame, where an inertial unit or a levelled map gives it; else the
  /// camera's own upright is assumed.
  std::optional<Eigen::Vector3d> up;
  double max_tilt_known = 10.0;    ///< deg, between the plane's normal and `up`: slopes
  double max_tilt_assumed = 25.0;  ///< deg, between the normal and the image's vertical: slopes and mounting
  double tolerance = 0.025;        ///< m, by how much ground is rough
  std::uint32_t seed = 1;          ///< of the random samples
};

/// Finds the ground (Newman et al. 2009, section 6.2) by RANSAC (Fischler and Bolles 1981) around the direction of
/// gravity, in disparity space, where planes are planes and the noise is that of the disparities; the final plane is
/// the robust least-squares fit to all points on it. Deterministic; pure.
GroundPlane findGround(const std::vector<DensePoint>& points, const urban_nav_core::StereoCamera& camera,
                       const GroundOptions& options = {});

/// Height of a point above the plane, m.
inline double heightAbove(const GroundPlane& plane, const Eigen::Vector3f& p_cam) {
  return plane.up.dot(p_cam.cast<double>()) + plane.height;
}

}  // namespace dense_stereo
