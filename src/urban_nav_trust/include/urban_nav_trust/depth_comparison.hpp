// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_trust/consistency_test.hpp"

namespace urban_nav_trust {

constexpr const char* kDepthScaleTest = "stereo_laser_scale";
constexpr const char* kExchangeTest = "laser_sides";

/// Stereo point near a surface measured by a laser.
struct SurfaceMatch {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();        ///< from the camera to the stereo point, axes of base_link, m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit normal of the surface
  double excess = 0.0;                                ///< m along the normal from the surface to the stereo point
  double sigma = 0.0;                                 ///< m, of the stereo point along the normal, as estimated
  int laser = -1;                                     ///< number of the laser that measured the surface; -1: unknown
  /// Displacement of the surface along its normal, m per rad, if this laser turns about the axis of its scan plane.
  double lever = 0.0;
};

/// Matches of the stereo points of one keyframe.
struct KeyframeMatches {
  urban_nav_core::StampNs stamp = 0;
  std::vector<SurfaceMatch> matches;
  int points = 0;                    ///< stereo points on upright surfaces near laser surfaces in either arrangement
  int as_stated = 0, exchanged = 0;  ///< points on a surface with lasers as stated, and with left and right exchanged
};

/// Compares stereo depths with laser ranges on surfaces measured by both, offline. With s the relative error of stereo
/// lengths, and r and t a rotation and translation of its mounting, a match has
///   excess = n . (s q + r x q + t) + noise,   q = p - excess n:
/// q lies on the surface and has the laser's error; with p instead, stereo noise would be multiplied by itself.
/// Estimated over all keyframes with Huber weights and priors of the mounting; the sandwich covariance is clustered by
/// keyframe (Liang and Zeger 1986). Derivation: docs/derivations/trust.md.
struct DepthScale {
  double scale = 0.0, sigma = 0.0;  ///< sigma 0: too few matches
  std::size_t keyframes = 0, matches = 0;
};
DepthScale estimateDepthScale(const std::vector<KeyframeMatches>& keyframes);

/// Computes the tests that the keyframes permit: stereo scale, and exchanged left and right lasers. `rig_scale`:
/// relative standard deviation of lengths after calibration.
void testDepths(const std::vector<KeyframeMatches>& keyframes, double rig_scale, std::vector<ConsistencyTest>& tests,
                std::vector<AbsentMeasurement>& absent);

}  // namespace urban_nav_trust
