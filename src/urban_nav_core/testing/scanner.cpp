// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/scanner.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_core::testing {

using urban_nav_core::PointCloud;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

namespace {

constexpr double kRad = 0.017453292519943295;

/// Returns the distance along a ray to a block, or `far`.
double hit(const Block& block, const Vector3d& from, const Vector3d& ray, double far) {
  const double c = std::cos(block.heading), s = std::sin(block.heading), dx = from.x() - block.x,
               dy = from.y() - block.y;
  const double o[3] = {c * dx + s * dy, -s * dx + c * dy, from.z()};
  const double r[3] = {c * ray.x() + s * ray.y(), -s * ray.x() + c * ray.y(), ray.z()};
  const double low[3] = {-0.5 * block.length, -0.5 * block.width, block.bottom},
               high[3] = {0.5 * block.length, 0.5 * block.width, block.top};
  double near = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(r[i]) < 1e-12) {
      if (o[i] < low[i] || o[i] > high[i]) return far;
      continue;
    }
    const double a = (low[i] - o[i]) / r[i], b = (high[i] - o[i]) / r[i];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far && near > 0.0 ? near : 1e9;
}

}  // namespace

World courtyard(std::uint64_t seed) {
  Dice dice(seed);
  World world;
  const double a = dice.uniform(14.0, 26.0), b = dice.uniform(10.0, 18.0);
  for (int side = 0; side < 4; ++side) {
    const double heading = 90.0 * kRad * side, away = side % 2 == 0 ? b : a, half = side % 2 == 0 ? a : b;
    const auto at = [&](double along, double out, double length, double width, double top) {
      const double x = along * std::cos(heading) - out * std::sin(heading),
                   y = along * std::sin(heading) + out * std::cos(heading);
      world.blocks.push_back({x, y, length, width, 0.0, top, heading});
    };
    at(0.0, away + 2.0, 2.0 * half + dice.uniform(-6.0, 0.0), 4.0, dice.uniform(6.0, 12.0));
    for (int bay = 0; bay < 3; ++bay)
      at(dice.uniform(-half, half), away - 0.3, dice.uniform(0.5, 3.0), dice.uniform(0.6, 2.0), dice.uniform(3.0, 6.0));
  }
  for (int i = 0; i < 6; ++i)  // trunks
    world.blocks.push_back({dice.uniform(-a, a), dice.uniform(-b, b), 0.4, 0.4, 0.0, 4.0, dice.uniform(0.0, 3.0)});
  for (int i = 0; i < 4; ++i)  // cars
    world.blocks.push_back({dice.uniform(-a, a), dice.uniform(-b, b), 4.2, 1.8, 0.3, 1.5, dice.uniform(0.0, 3.0)});
  return world;
}

World facade() { return {{{0.0, 6.0, 400.0, 2.0, 0.0, 15.0, 0.0}}, true}; }

World plain() { return {{}, true}; }

PointCloud scan(const World& world, const Pose& T_world_sensor, const Scanner& scanner, std::uint64_t seed) {
  Dice dice(seed);
  PointCloud cloud;
  for (int ring = 0; ring < scanner.rings; ++ring) {
    const double up =
        kRad * (scanner.lowest + (scanner.highest - scanner.lowest) * ring / std::max(scanner.rings - 1, 1));
    for (int beam = 0; beam < scanner.beams; ++beam) {
      const double around = 360.0 * kRad * beam / scanner.beams;
      const Vector3d direction(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up));
      const Vector3d ray = T_world_sensor.q() * direction;
      double range = 1e9;
      if (world.ground && ray.z() < 0.0) range = -T_world_sensor.t().z() / ray.z();
      for (const Block& block : world.blocks) range = std::min(range, hit(block, T_world_sensor.t(), ray, 1e9));
      if (range > scanner.range || range < 0.3) continue;
      cloud.points.push_back(((range + scanner.sigma * dice.normal()) * direction).cast<float>());
    }
  }
  return cloud;
}

Pose stand(double x, double y, double heading_deg, double roll_deg, double pitch_deg) {
  const Quaterniond q = Quaterniond(Eigen::AngleAxisd(kRad * heading_deg, Vector3d::UnitZ())) *
                        Quaterniond(Eigen::AngleAxisd(kRad * pitch_deg, Vector3d::UnitY())) *
                        Quaterniond(Eigen::AngleAxisd(kRad * roll_deg, Vector3d::UnitX()));
  return Pose(q, {x, y, 1.5});
}

}  // namespace urban_nav_core::testing
