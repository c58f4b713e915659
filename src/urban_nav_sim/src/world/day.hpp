// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "urban_nav_sim/light.hpp"

namespace urban_nav_sim {

/// Light and weather of a session. Radiances are linear; 1 is a white surface in the sun of a clear day.
struct Day {
  int number = 1;
  Light light = Light::Day;
  Eigen::Vector3f to_sun = Eigen::Vector3f::UnitZ();           ///< unit, in `world`
  Eigen::Vector3f sun = Eigen::Vector3f(0.80F, 0.76F, 0.68F);  ///< radiance of a white surface that faces the sun, RGB
  Eigen::Vector3f sky = Eigen::Vector3f(0.24F, 0.28F, 0.36F);  ///< same by the sky, for a surface facing up
  Eigen::Vector3f ground =
      Eigen::Vector3f(0.08F, 0.08F, 0.07F);  ///< same by light from the ground, for a surface facing down
  float clouds = 0.3F;                       ///< share of the sky covered by clouds
  float wet = 0.0F;                          ///< 0 dry ... 1: ground dark and glossy
  float leaves = 1.0F;                       ///< share of the leaves on the trees
};

/// Weather, wetness and leaves of a day are the same in each light.
Day makeDay(std::uint32_t seed, int number, Light light = Light::Day);

}  // namespace urban_nav_sim
