// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

#include "noise/noise.hpp"

namespace urban_nav_sim {

/// What wheels roll on: a smooth height and, on it, what is too small for it: stones, joints of slabs, ruts. As tyres
/// feel it, nothing is shorter than 0.24 m. Immutable, so thread-safe.
class RoughGround {
 public:
  /// `roughness` 1: 1.2 mm (standard deviation) of some 0.3 m length and 6 mm of 1 m, which rocks the robot as the
  /// gravel of the New College log does (roll about its trend over 3.5 s: 0.45 deg, there 0.5). An empty function is
  /// level ground.
  RoughGround(std::function<double(double, double)> smooth, double roughness, const Noise& noise);

  double height(double x, double y) const;           ///< m
  Eigen::Vector3d normal(double x, double y) const;  ///< unit, up; of the smooth ground
  /// Of the smooth ground in the direction `yaw`, rad, uphill positive.
  double slope(double x, double y, double yaw) const;

 private:
  Eigen::Vector2d gradient(double x, double y) const;

  std::function<double(double, double)> smooth_;
  double roughness_;
  Noise short_, long_;
};

/// How the axle lies above the ground when both wheels touch it.
struct AxleOnGround {
  double height = 0.0;  ///< of its middle, m, in `world`
  double roll = 0.0;    ///< rad: of Rz(yaw) Ry(pitch) Rx(roll)
};

/// `middle`: horizontal place of the axle's middle, m.
AxleOnGround layOnGround(const RoughGround& ground, const Eigen::Vector2d& middle, double yaw, double pitch);

}  // namespace urban_nav_sim
