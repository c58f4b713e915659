// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_core {

/// Estimates the upward direction in `odom` from specific forces along steps measured by images or sweeps. The force
/// rotated to `odom` is gravity plus the acceleration of base_link, whose integral is the change of the velocity,
/// measured by the steps. Averaged over the last 20 s, since orientation drifts. Derivation:
/// docs/derivations/motion_sensors.md. Not thread-safe.
class UpDirection {
 public:
  struct Estimate {
    Vector3d up = Vector3d::UnitZ();  ///< in `odom`
    double sigma = 0.0;               ///< of each tilt, rad
  };

  /// Adds the force of an input, if it has a plausible one.
  void add(const MotionInput& input);
  /// Adds a measured step. `q_odom_to`: orientation of base_link at its end; `T_from_to`: of base_link;
  /// `follows`: it begins at the end of the last one.
  void addStep(StampNs from, StampNs to, const Pose& T_from_to, const Quaterniond& q_odom_to, bool follows);
  /// Returns nullopt before enough forces.
  std::optional<Estimate> estimate() const;
  void archive(Archive& archive);

 private:
  struct Force {
    StampNs stamp = 0;
    Vector3d force = Vector3d::Zero();  // in base_link, m/s^2
    void archive(Archive& archive) { archive(stamp, force); }
  };
  std::vector<Force> forces_;             // since the end of the last step, in order of time
  Vector3d impulse_ = Vector3d::Zero();   // of gravity, faded, m/s
  Vector3d velocity_ = Vector3d::Zero();  // at the end of the last step, in `odom`
  double seconds_ = 0.0;                  // faded
};

}  // namespace urban_nav_core
