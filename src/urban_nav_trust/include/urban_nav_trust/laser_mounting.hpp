// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/depth_comparison.hpp"

namespace urban_nav_trust {

constexpr const char* kMountingTest = "laser_mounting";

/// Angle of a laser in one keyframe.
struct LaserAngle {
  urban_nav_core::StampNs stamp = 0;
  double angle = 0.0, sigma = 0.0;  ///< rad, about the axis of the scan plane, relative to the stated mounting
  double lever = 0.0;               ///< m, root mean square of SurfaceMatch::lever
};

/// Estimates by keyframe the angle by which laser number `laser` is turned about the axis of its scan plane, from the
/// matches of its surfaces with stereo points: turned by phi, its surfaces are displaced by phi lever along their
/// normals, so that excess = -phi lever + noise. Keyframes with too few matches or a short lever are left out.
/// Derivation: docs/derivations/trust.md.
std::vector<LaserAngle> laserAngles(const std::vector<KeyframeMatches>& keyframes, int laser);

/// Tests that no laser has turned about its scan axis: the angle of each must not change over the session, and must be
/// within the accuracy of a measured mounting. `lasers`: their names, by number. If all change together, the stereo
/// head has turned. Returns the numbers of the lasers for which it fails, whose surfaces are no measurement of lengths.
std::vector<int> testLaserMountings(const std::vector<KeyframeMatches>& keyframes,
                                    const std::vector<std::string>& lasers, double false_alarm,
                                    std::vector<ConsistencyTest>& tests, std::vector<AbsentMeasurement>& absent);

}  // namespace urban_nav_trust
