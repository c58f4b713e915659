// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_trust/consistency_test.hpp"

namespace urban_nav_trust {

constexpr const char* kDepthScaleTest = "stereo_laser_scale";
constexpr const char* kExchangeTest = "laser_sides";

/// A stereo point near a surface that a laser measured.
struct SurfaceMatch {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();        ///< from the camera to the stereo point, axes of base_link, m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, surface
  double excess = 0.0;                                ///< m along the normal, from the surface to the stereo point
  double sigma = 0.0;                                 ///< m, of the stereo point along the normal, as far as known
};

/// Matches of the stereo points of one keyframe.
struct KeyframeMatches {
  urban_nav_core::StampNs stamp = 0;
  std::vector<SurfaceMatch> matches;
  int points = 0;                    ///< stereo points on upright surfaces near laser surfaces of either arrangement
  int as_stated = 0, exchanged = 0;  ///< on a surface with lasers as stated, and with left and right exchanged
};

/// Compares depths by stereo with ranges of lasers on the surfaces that both measured, offline. With s the relative
/// error of stereo's lengths, r and t a rotation and translation of its mounting, a match has
///   excess = n . (s q + r x q + t) + noise,   q = p - excess n:
/// q, on the surface, has the laser's error; with p the noise of stereo would multiply itself.
/// Estimated over all keyframes with Huber's weights and priors of a mounting; keyframes are the clusters of a sandwich
/// (Liang and Zeger 1986). Derivation: docs/derivations/trust.md.
struct DepthScale {
  double scale = 0.0, sigma = 0.0;  ///< sigma 0: too little
  std::size_t keyframes = 0, matches = 0;
};
DepthScale estimateDepthScale(const std::vector<KeyframeMatches>& keyframes);

/// Returns the tests that the keyframes allow: stereo's scale, and whether left and right laser are exchanged.
/// `rig_scale`: relative standard deviation of lengths that calibration leaves.
void testDepths(const std::vector<KeyframeMatches>& keyframes, double rig_scale, std::vector<ConsistencyTest>& tests,
                std::vector<AbsentMeasurement>& absent);

}  // namespace urban_nav_trust
