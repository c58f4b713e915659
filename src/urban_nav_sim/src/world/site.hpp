// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "materials/material_library.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// Appearance of an object: material, colour variant, and seed of the instance.
struct Finish {
  MaterialKind stuff = MaterialKind::Render;
  std::uint64_t variant = 0;
  std::uint32_t seed = 0;
};

/// Light of a lamp: that of streets, and that of rooms.
enum class Bulb { Sodium, Neutral };

/// Assembles a world: triangles are sorted into parts by their appearance.
class Site {
 public:
  Site(World& world, std::uint64_t seed) : world_(world), stock_(seed) {}

  World& world() { return world_; }
  double ground(double x, double y) const { return world_.ground(x, y); }

  /// Returns the part of this appearance. Valid until the next call.
  Part& part(const Finish& finish);
  /// Corners counter-clockwise as seen from outside; the texture runs with a-b and a-d, in m, from `origin` at a.
  void quad(const Finish& finish, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
            const Eigen::Vector3d& d, const Eigen::Vector2d& origin = Eigen::Vector2d::Zero());
  /// The same with the texture stretched to the square of 2 m of windows.
  void pane(const Finish& finish, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
            const Eigen::Vector3d& d);
  /// Adds a box with sides along (cos yaw, sin yaw), its left and up. No underside.
  void box(const Finish& finish, const Eigen::Vector3d& centre_below, const Eigen::Vector3d& size, double yaw = 0.0);
  /// Adds a post or trunk of `sides` sides from `below` (radius r0) to `above` (radius r1).
  void pole(const Finish& finish, const Eigen::Vector3d& below, const Eigen::Vector3d& above, double r0, double r1,
            int sides = 8);

  /// Subsequent windows belong to another house.
  void beginHouse() { ++house_; }
  /// Adds a light without geometry, at `height` above the ground: a street lamp, or a lamp at a wall.
  void lamp(const Eigen::Vector3d& position, Bulb bulb = Bulb::Sodium);
  void wallLamp(double x, double y, double height);

  /// Subsequent parts belong to a mover, in its frame; `take` returns it, `release` adds it to the world; both continue
  /// with the static world.
  void beginMover();
  Mover take();
  void release(std::function<urban_nav_core::Pose(double)> path);

 private:
  World& world_;
  MaterialLibrary stock_;
  std::map<std::pair<MaterialKind, std::uint64_t>, std::uint32_t> materials_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> parts_, mover_parts_;
  Mover mover_;
  bool moving_ = false;
  std::uint32_t house_ = 0;
};

}  // namespace urban_nav_sim
