// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dense_stereo/points.hpp"

namespace dense_stereo {

/// Result of the ground plane search.
enum class GroundVerdict : int {
  Found = 0,
  TooFewPoints,  ///< too few points within range for a plane
  NoPlane,       ///< no plane near the expected direction has enough support
  NotPlanar,     ///< steps or a break in slope: much of the ground is not on the best plane
};
const char* toString(GroundVerdict verdict);

/// Ground plane up . p + height = 0 in the left optical frame; `height` is that of the camera above it.
///
/// WARNING: `covariance` is of (up, height) and singular, since `up` has unit length. It counts a window of alignment
/// as one measurement, and includes only errors of the disparities, not those of the calibration.
struct GroundPlane {
  GroundVerdict verdict = GroundVerdict::TooFewPoints;
  std::string sentence;                                  ///< reason why there is none; empty if found
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();        ///< unit normal, away from the ground
  double height = 0.0;                                   ///< m
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of (up, height), 1 and m
  double support = 0.0;                                  ///< share of the ground's area on the plane

  bool isFound() const { return verdict == GroundVerdict::Found; }
};

/// Initial values of the search.
struct GroundOptions {
  /// Opposite of gravity in the left optical frame, if an inertial unit or a levelled map provides it; otherwise the
  /// camera is assumed upright.
  std::optional<Eigen::Vector3d> up;
  double max_tilt_known = 10.0;    ///< deg, between the plane's normal and `up`: slopes
  double max_tilt_assumed = 25.0;  ///< deg, between the normal and the image's vertical: slopes and mounting
  double tolerance = 0.025;        ///< m, roughness of the ground
  std::uint32_t seed = 1;          ///< of random sampling
};

/// Finds the ground (Newman et al. 2009, section 6.2) by RANSAC (Fischler and Bolles 1981) around the direction of
/// gravity, in disparity space, in which planes remain planes and noise is that of the disparities; the final plane is
/// the robust least-squares fit to all of its points. Deterministic; pure.
GroundPlane findGround(const std::vector<DensePoint>& points, const urban_nav_core::StereoCamera& camera,
                       const GroundOptions& options = {});

/// Returns the height of a point above the plane, m.
inline double heightAbove(const GroundPlane& plane, const Eigen::Vector3f& p_cam) {
  return plane.up.dot(p_cam.cast<double>()) + plane.height;
}

}  // namespace dense_stereo
