// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"
#include "urban_nav_input/sensors/sight.hpp"

namespace urban_nav_input {

/// Measures motion and ground from ORB features of stereo pairs, without an estimator. Deterministic. Not thread-safe.
class SightMeter {
 public:
  SightMeter(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_camera)
      : camera_(camera), T_base_camera_(T_base_camera) {
    sight_.camera = T_base_camera.t();
  }
  /// Adds the measurements of a pair and a later one: a motion if enough points of the first are found in the left
  /// image of the second, and the ground if most points below the camera are on one plane.
  void add(const urban_nav_core::StereoPair& before, const urban_nav_core::StereoPair& after);
  const Sight& sight() const { return sight_; }

 private:
  urban_nav_core::StereoCamera camera_;
  urban_nav_core::Pose T_base_camera_;
  Sight sight_;
};

/// Returns the plane of most of the points below the camera; nullopt if there are few or they are not on one plane, or
/// if it is inclined by more than 60 deg to the axes of the base. Points in m, relative to the camera in the axes of
/// base_link.
std::optional<SeenGround> findGround(const std::vector<urban_nav_core::Vector3d>& points);

}  // namespace urban_nav_input
