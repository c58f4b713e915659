// SPDX-License-Identifier: BSD-3-Clause
#include "world/site.hpp"

#include <cmath>

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

void addQuad(Part& part, const std::array<Vector3d, 4>& corners, const std::array<Vector2d, 4>& texture) {
  const auto first = static_cast<std::uint32_t>(part.vertices.size());
  for (std::size_t i = 0; i < 4; ++i) {
    part.vertices.push_back(corners[i].cast<float>());
    part.texture.push_back(texture[i].cast<float>());
  }
  part.triangles.push_back({first, first + 1, first + 2});
  part.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

Part& Site::part(const Finish& finish) {
  const auto [material, is_new] =
      materials_.try_emplace({finish.stuff, finish.variant}, static_cast<std::uint32_t>(world_.materials.size()));
  if (is_new) world_.materials.push_back(stock_.make(finish.stuff, finish.variant));
  auto& known = moving_ ? mover_parts_ : parts_;
  auto& parts = moving_ ? mover_.parts : world_.parts;
  const auto [index, first] = known.try_emplace({material->second, finish.seed}, parts.size());
  if (first) {
    parts.emplace_back();
    parts.back().material = material->second;
    parts.back().seed = finish.seed;
  }
  return parts[index->second];
}

void Site::quad(const Finish& finish, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
                const Vector2d& origin) {
  const Vector3d u = (b - a).normalized();
  Vector3d v = d - a;
  v = (v - v.dot(u) * u).normalized();
  const auto on = [&](const Vector3d& p) { return Vector2d(origin + Vector2d((p - a).dot(u), (p - a).dot(v))); };
  addQuad(part(finish), {a, b, c, d}, {on(a), on(b), on(c), on(d)});
}

void Site::pane(const Finish& finish, const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  if (!moving_) world_.windows.push_back({a.cast<float>(), house_});
  addQuad(part(finish), {a, b, c, d}, {Vector2d(0, 0), Vector2d(2, 0), Vector2d(2, 2), Vector2d(0, 2)});
}

void Site::box(const Finish& finish, const Vector3d& centre_below, const Vector3d& size, double yaw) {
  const Vector3d x = 0.5 * size.x() * Vector3d(std::cos(yaw), std::sin(yaw), 0),
                 y = 0.5 * size.y() * Vector3d(-std::sin(yaw), std::cos(yaw), 0);
  const Vector3d up = size.z() * Vector3d::UnitZ(), o = centre_below;
  const std::array<Vector3d, 4> low = {o - x - y, o + x - y, o + x + y, o - x + y};
  double along = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d &a = low[i], &b = low[(i + 1) % 4];
    quad(finish, a, b, b + up, a + up, {along, 0});
    along += (b - a).norm();
  }
  quad(finish, low[0] + up, low[1] + up, low[2] + up, low[3] + up, {0.3, 0.7});
}

void Site::pole(const Finish& finish, const Vector3d& below, const Vector3d& above, double r0, double r1, int sides) {
  const Vector3d axis = (above - below).normalized();
  const Vector3d x = axis.unitOrthogonal(), y = axis.cross(x);
  const double length = (above - below).norm(), turn = 2.0 * M_PI / sides;
  Part& p = part(finish);
  for (int i = 0; i < sides; ++i) {
    const auto spoke = [&](int k) { return Vector3d(std::cos(k * turn) * x + std::sin(k * turn) * y); };
    const double u0 = i * turn * r0, u1 = (i + 1) * turn * r0;
    addQuad(p, {below + r0 * spoke(i), below + r0 * spoke(i + 1), above + r1 * spoke(i + 1), above + r1 * spoke(i)},
            {Vector2d(u0, 0), Vector2d(u1, 0), Vector2d(u1, length), Vector2d(u0, length)});
  }
}

void Site::lamp(const Vector3d& position, Bulb bulb) {
  // A lantern with 2500 cd downwards gives 135 lx below a post of 4.3 m. A white surface in 100 000 lx, the
  // sun of a clear day, has a radiance of 1.
  constexpr float kCandela = 2500.0F, kWhite = 100000.0F;
  const Eigen::Vector3f colour =
      bulb == Bulb::Sodium ? Eigen::Vector3f(1.40F, 0.92F, 0.42F) : Eigen::Vector3f(1.10F, 1.00F, 0.82F);
  world_.lamps.push_back({position.cast<float>(), kCandela / kWhite * colour});
}

void Site::wallLamp(double x, double y, double height) { lamp({x, y, ground(x, y) + height}); }

void Site::beginMover() {
  moving_ = true;
  mover_ = Mover();
  mover_parts_.clear();
}

Mover Site::take() {
  moving_ = false;
  return std::move(mover_);
}

void Site::release(std::function<urban_nav_core::Pose(double)> path) {
  world_.movers.push_back(take());
  world_.movers.back().T_world_mover = std::move(path);
}

}  // namespace urban_nav_sim
