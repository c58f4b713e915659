// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "materials/material_library.hpp"
#include "motion/motion.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// A parallelogram: from `corner` along `a`, then `b`; seen from where a x b points to.
inline void addQuad(Part& part, const Eigen::Vector3f& corner, const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const auto n = static_cast<std::uint32_t>(part.vertices.size());
  const float along = a.norm(), up = b.norm();
  part.vertices.insert(part.vertices.end(), {corner, corner + a, corner + a + b, corner + b});
  part.texture.insert(part.texture.end(), {{0.0F, 0.0F}, {along, 0.0F}, {along, up}, {0.0F, up}});
  part.triangles.push_back({n, n + 1, n + 2});
  part.triangles.push_back({n, n + 2, n + 3});
}

inline Part quad(std::uint32_t material, const Eigen::Vector3f& corner, const Eigen::Vector3f& a,
                 const Eigen::Vector3f& b) {
  Part part;
  part.material = material;
  part.seed = material + 7;
  addQuad(part, corner, a, b);
  return part;
}

/// Materials of the worlds below, by index.
enum Stuffs : std::uint32_t { kWall, kGround, kLeaves, kCar };

inline World emptyWorld() {
  World world;
  MaterialLibrary stock(5);
  world.materials = {stock.make(MaterialKind::Brick), stock.make(MaterialKind::Gravel),
                     stock.make(MaterialKind::Leaves), stock.make(MaterialKind::Brick, 2)};
  world.day.to_sun = Eigen::Vector3f(-0.5F, 0.3F, 0.8F).normalized();
  return world;
}

/// A yard: ground at z = 0, a wall at x = 6 that faces the origin, one at y = 4 slanted by 20 deg, a hedge of leaves at
/// y = -3, and a box that moves along y in front of the wall.
inline World yard() {
  World world = emptyWorld();
  world.parts.push_back(quad(kGround, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}));
  world.parts.push_back(quad(kWall, {6, 20, 0}, {0, -40, 0}, {0, 0, 7}));
  world.parts.push_back(quad(kWall, {-20, 4, 0}, {40 * std::cos(0.35F), 40 * std::sin(0.35F), 0}, {0, 0, 5}));
  Part hedge;
  hedge.material = kLeaves;
  for (int i = 0; i < 60; ++i) {
    const auto x = static_cast<float>(i) * 0.15F - 4.0F;
    addQuad(hedge, {x, -3.0F - 0.1F * std::sin(x * 5.0F), 0.2F}, {0.4F, 0.1F, 0}, {0.05F, 0.1F, 1.2F});
  }
  world.parts.push_back(hedge);
  Mover box;
  box.parts.push_back(quad(kCar, {0, 0.5F, 0}, {0, -1, 0}, {0, 0, 1.4F}));
  box.T_world_mover = [](double t) {
    return urban_nav_core::Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(4.0, t, 0.0));
  };
  world.movers.push_back(box);
  return world;
}

/// Straight on at a constant speed and turn.
class SteadyMotion : public Motion {
 public:
  explicit SteadyMotion(double speed = 0.0, double rate = 0.0) : speed_(speed), rate_(rate) {}
  double duration() const override { return 100.0; }
  MotionState at(double t) const override {
    const double yaw = rate_ * t, straight = std::abs(rate_) < 1e-9;
    const Eigen::Vector3d place = straight != 0.0
                                      ? Eigen::Vector3d(speed_ * t, 0.0, 0.0)
                                      : Eigen::Vector3d(std::sin(yaw), 1.0 - std::cos(yaw), 0.0) * speed_ / rate_;
    MotionState motion_state;
    motion_state.T_world_base =
        urban_nav_core::Pose(Eigen::Quaterniond(std::cos(yaw / 2), 0.0, 0.0, std::sin(yaw / 2)), place);
    motion_state.velocity_world = speed_ * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0.0);
    motion_state.acceleration_world = speed_ * rate_ * Eigen::Vector3d(-std::sin(yaw), std::cos(yaw), 0.0);
    motion_state.rate_base = Eigen::Vector3d(0.0, 0.0, rate_);
    motion_state.rate_change_base.setZero();
    return motion_state;
  }

 private:
  double speed_, rate_;
};

}  // namespace urban_nav_sim
