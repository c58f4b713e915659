// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace urban_nav_sim {

/// Light and weather of a session. Radiances are linear; 1 is a white sheet in the sun of a clear day.
struct Day {
  int number = 1;
  Eigen::Vector3f to_sun = Eigen::Vector3f::UnitZ();  ///< unit, in `world`
  Eigen::Vector3f sun =
      Eigen::Vector3f(0.80F, 0.76F, 0.68F);  ///< what a white surface that faces the sun sends back of it, RGB
  Eigen::Vector3f sky = Eigen::Vector3f(0.24F, 0.28F, 0.36F);  ///< the same of the sky, for a surface that faces up
  Eigen::Vector3f ground =
      Eigen::Vector3f(0.08F, 0.08F, 0.07F);  ///< of what is thrown back by the ground, for one that faces down
  float clouds = 0.3F;                       ///< share of the sky that clouds cover
  float wet = 0.0F;                          ///< 0 dry ... 1: ground dark and glossy
  float leaves = 1.0F;                       ///< share of the leaves on the trees
};

Day makeDay(std::uint32_t seed, int number);

}  // namespace urban_nav_sim
