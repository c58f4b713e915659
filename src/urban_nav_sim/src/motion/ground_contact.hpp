// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Ground under the wheels: a smooth height plus roughness: stones, joints of slabs, ruts. As tyres filter it, no
/// wavelength is below 0.24 m. Immutable, so thread-safe.
class RoughGround {
 public:
  /// `roughness` 1: standard deviation 1.2 mm at wavelengths of about 0.3 m and 6 mm at 1 m, which gives the roll of
  /// the New College log on gravel (about its trend over 3.5 s: 0.45 deg, in the log 0.5). An empty function means
  /// level ground.
  RoughGround(std::function<double(double, double)> smooth, double roughness, const Noise& noise);

  double height(double x, double y) const;           ///< m
  Eigen::Vector3d normal(double x, double y) const;  ///< unit, upward; of the smooth ground
  /// Slope of the smooth ground in the direction `yaw`, rad, uphill positive.
  double slope(double x, double y, double yaw) const;

 private:
  Eigen::Vector2d gradient(double x, double y) const;

  std::function<double(double, double)> smooth_;
  double roughness_;
  Noise short_, long_;
};

/// Pose of the axle with both wheels on the ground.
struct AxleOnGround {
  double height = 0.0;  ///< of its centre, m, in `world`
  double roll = 0.0;    ///< rad: of Rz(yaw) Ry(pitch) Rx(roll)
};

/// `middle`: horizontal position of the centre of the axle, m.
AxleOnGround layOnGround(const RoughGround& ground, const Eigen::Vector2d& middle, double yaw, double pitch);

}  // namespace urban_nav_sim
