// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ray_tracing/tracer.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// The electric lights of a world that burn at this hour: none by day, rooms at dusk and at night, lamps at night (they
/// are switched on below 70 lx, EN 13201). Linear RGB as Sky. Immutable, hence thread-safe.
class Lights {
 public:
  Lights() = default;
  explicit Lights(const World& world);

  bool hasLamps() const { return !lamps_.empty(); }

  static constexpr int kMostSources = 4;  ///< lamps of a point that cast shadows
  struct Source {
    std::uint32_t lamp = 0;                              ///< index of World::lamps
    Eigen::Vector3f to_lamp = Eigen::Vector3f::UnitZ();  ///< m
    Eigen::Vector3f radiance = Eigen::Vector3f::Zero();  ///< of a white surface there, unless the lamp is hidden
  };
  struct Sources {
    std::array<Source, kMostSources> all;  ///< the strongest first
    int count = 0;
    Eigen::Vector3f scattered = Eigen::Vector3f::Zero();  ///< by streets and walls, whatever is hidden
  };
  /// Returns the light of lamps on the visible side of a point.
  Sources sourcesAt(const SurfacePoint& point) const;

  /// Returns the radiance of the point itself: the glass of a lamp, a lit room seen through a window pane.
  Eigen::Vector3f own(const SurfacePoint& point, const Appearance& surface) const;

 private:
  const std::vector<std::uint32_t>& lampsNear(const Eigen::Vector3f& position) const;

  std::vector<Lamp> lamps_;
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();  ///< m, lower corner of the cells
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::uint32_t>> cells_;             ///< lamps that reach a cell, row by row
  std::unordered_map<std::uint64_t, Eigen::Vector3f> rooms_;  ///< radiance by toKey() the corner of a lit window
};

}  // namespace urban_nav_sim
