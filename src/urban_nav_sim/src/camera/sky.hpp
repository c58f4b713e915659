// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "camera/lights.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// The sky: blue gradient, clouds, glow of the sun; and its illumination. Linear RGB, 1 = a white sheet in the sun of a
/// clear day. Immutable, hence thread-safe.
class Sky {
 public:
  /// A sky without electric lights below it.
  Sky(const Day& day, std::uint64_t seed);
  /// The sky of a world, with its lights.
  Sky(const World& world, std::uint64_t seed);

  const Day& day() const { return day_; }
  const Lights& lights() const { return lights_; }
  /// Returns the radiance in a direction (unit, `world`); haze below the horizon.
  Eigen::Vector3f radiance(const Eigen::Vector3f& direction) const;
  /// Returns the radiance for mirror reflections: sky above the roofs, dark outline below.
  Eigen::Vector3f mirrored(const Eigen::Vector3f& direction) const;
  /// Returns the radiance of a white surface lit by sky and ground, without the sun. Normal: unit, `world`.
  Eigen::Vector3f ambient(const Eigen::Vector3f& normal) const {
    const float up = 0.5F + 0.5F * normal.z();
    return up * day_.sky + (1.0F - up) * day_.ground;
  }
  /// Returns the colour of the haze.
  const Eigen::Vector3f& haze() const { return haze_; }

 private:
  Eigen::Vector3f evaluate(const Eigen::Vector3f& direction, std::uint64_t seed) const;
  Eigen::Vector3f sample(const Eigen::Vector3f& direction) const;

  Day day_;
  Lights lights_;
  Eigen::Vector3f haze_ = Eigen::Vector3f::Zero();
  std::vector<Eigen::Vector3f> map_;  ///< rows: elevation from the horizon up; columns: azimuth, one more than a turn
};

}  // namespace urban_nav_sim
