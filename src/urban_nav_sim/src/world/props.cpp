// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "noise/hash.hpp"
#include "world/props.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;
using urban_nav_core::Pose;

namespace {

Pose poseAt(const Vector3d& t, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), t};
}

/// Motion along a line and back, rotating on the spot at its ends, hence continuous. `bob`: vertical amplitude, m, once
/// per step.
std::function<Pose(double)> toAndFro(const std::vector<Vector2d>& line, double speed, double phase,
                                     const std::function<double(double, double)>& ground, double bob) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return [=](double t) {
    double s = std::fmod(speed * t + 2.0 * length * phase, 2.0 * length);
    const bool back = s > length;
    if (back) s = 2.0 * length - s;
    std::size_t i = 1;
    while (i + 1 < line.size() && s > (line[i] - line[i - 1]).norm()) s -= (line[i] - line[i - 1]).norm(), ++i;
    const Vector2d d = (line[i] - line[i - 1]).normalized(), p = line[i - 1] + s * d;
    const double up = bob * std::abs(std::sin(3.5 * speed * t));
    return poseAt({p.x(), p.y(), ground(p.x(), p.y()) + up}, std::atan2(d.y(), d.x()) + (back ? M_PI : 0.0));
  };
}

/// Motion from one position to the other and back underground, out of view of every sensor; for ends out of sight.
std::function<Pose(double)> straightMotion(const Vector2d& from, const Vector2d& to, double speed, double phase,
                                           const std::function<double(double, double)>& ground) {
  constexpr double kDepth = 8.0;  // m
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  return [=](double t) {
    const double s = std::fmod(speed * t + 2.0 * length * phase, 2.0 * length);
    const bool back = s > length;
    const Vector2d p = from + (back ? 2.0 * length - s : s) * along;
    return poseAt({p.x(), p.y(), ground(p.x(), p.y()) - (back ? kDepth : 0.0)}, std::atan2(along.y(), along.x()));
  };
}

/// Adds a prism: `outline` counter-clockwise in the x-z plane as seen from the right (-y).
void prism(Site& site, const Finish& finish, const std::vector<Vector2d>& outline, double half_width, double narrower) {
  const std::size_t n = outline.size();
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& p : outline) middle += p / static_cast<double>(n);
  double top = 0.0;
  for (const Vector2d& p : outline) top = std::max(top, p.y());
  const auto at = [&](const Vector2d& p, double side) {
    return Vector3d(p.x(), side * (half_width - narrower * p.y() / top), p.y());
  };
  double along = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d &a = outline[i], &b = outline[(i + 1) % n];
    site.quad(finish, at(a, -1), at(a, 1), at(b, 1), at(b, -1), {0, along});
    const Vector3d right = at(middle, -1), left = at(middle, 1);
    site.quad(finish, at(a, -1), at(b, -1), right, right, {along, 0});
    site.quad(finish, at(b, 1), at(a, 1), left, left, {along, 0});
    along += (b - a).norm();
  }
}

}  // namespace

void placeLamp(Site& site, double x, double y, double yaw) {
  const Vector3d foot(x, y, site.ground(x, y));
  const Finish iron{MaterialKind::Iron, 0, 1};
  site.pole(iron, foot, foot + Vector3d(0, 0, 0.9), 0.1, 0.08);
  site.pole(iron, foot + Vector3d(0, 0, 0.9), foot + Vector3d(0, 0, 4.2), 0.05, 0.04);
  const Vector3d arm = foot + Vector3d(0.9 * std::cos(yaw), 0.9 * std::sin(yaw), 4.35);
  site.pole(iron, foot + Vector3d(0, 0, 4.15), arm, 0.035, 0.03, 6);
  site.box({MaterialKind::PaintedWood, 1, 2}, arm - Vector3d(0, 0, 0.1), {0.45, 0.22, 0.14}, yaw);
  site.lamp(arm - Vector3d(0, 0, 0.14));  // just below the lantern
}

void placeBench(Site& site, double x, double y, double yaw) {
  const Vector3d o(x, y, site.ground(x, y)), along(std::cos(yaw), std::sin(yaw), 0),
      back(-std::sin(yaw), std::cos(yaw), 0);
  const Finish wood{MaterialKind::Boards, 1, 4};
  for (const double s : {-0.75, 0.75}) {
    site.box(wood, o + s * along - 0.2 * back, {0.07, 0.07, 0.42}, yaw);
    site.box(wood, o + s * along + 0.2 * back, {0.07, 0.07, 0.9}, yaw);
  }
  for (const double s : {-0.17, -0.03, 0.11})
    site.box(wood, o + s * back + Vector3d(0, 0, 0.42), {1.7, 0.11, 0.035}, yaw);
  for (const double z : {0.55, 0.68, 0.81}) site.box(wood, o + 0.22 * back + Vector3d(0, 0, z), {1.7, 0.03, 0.09}, yaw);
}

void placeBin(Site& site, double x, double y) {
  const Vector3d o(x, y, site.ground(x, y));
  site.pole({MaterialKind::Iron, 1, 3}, o, o + Vector3d(0, 0, 0.95), 0.27, 0.3, 12);
  site.pole({MaterialKind::Iron, 1, 3}, o + Vector3d(0, 0, 0.95), o + Vector3d(0, 0, 1.1), 0.31, 0.02, 12);
}

void makeCar(Site& site, bool van, std::uint64_t seed) {
  Draw draw(hash(seed, 0xCA7));
  const auto paint = static_cast<std::uint64_t>(draw.index(14));
  const auto look = static_cast<std::uint32_t>(seed % 251);
  const Finish body{MaterialKind::CarPaint, paint, look}, glass{MaterialKind::CarGlass, 0, look},
      tyre{MaterialKind::Rubber, 0, look}, bright{MaterialKind::PaintedWood, 2, look};
  const double h = 0.5 * kCarLength, w = 0.5 * kCarWidth, up = van ? 0.55 : draw.uniform(-0.05, 0.2);
  // The lower body and the cabin, as seen from the right with the front to +x.
  prism(site, body,
        {{-h + 0.05, 0.25},
         {h - 0.1, 0.25},
         {h, 0.45},
         {h - 0.05, 0.72},
         {h - 0.3, 0.82},
         {0.75, 0.95},
         {-h + 0.15, 0.97},
         {-h, 0.6}},
        w, 0.06);
  const double rear = van ? -h + 0.1 : -h + draw.uniform(0.15, 0.9), roof = 1.42 + up;
  prism(site, body, {{rear, 0.93}, {1.05, 0.93}, {0.25, roof - 0.03}, {0.1, roof}, {rear + (van ? 0.1 : 0.55), roof}},
        w - 0.09, 0.12);
  const auto side = [&](double z) { return w - 0.09 - 0.12 * z / roof + 0.006; };
  const double z0 = 1.0, z1 = roof - 0.12;
  for (const double s : {-1.0, 1.0}) {
    for (const auto& [x0, x1, t0, t1] : {std::array<double, 4>{-0.15, 0.85, -0.15, 0.3},
                                         {van ? -0.2 : rear + 0.3, -0.25, van ? -0.2 : rear + 0.6, -0.25}}) {
      const Vector3d a(x0, s * side(z0), z0), b(x1, s * side(z0), z0), c(t1, s * side(z1), z1), d(t0, s * side(z1), z1);
      if (s < 0) site.quad(glass, a, b, c, d);
      if (s > 0) site.quad(glass, b, a, d, c);
    }
    for (const double x : {-h + 0.75, h - 0.8}) {
      site.pole(tyre, {x, s * (w - 0.2), 0.31}, {x, s * (w + 0.01), 0.31}, 0.31, 0.31, 14);
      site.pole(tyre, {x, s * (w + 0.01), 0.31}, {x, s * (w + 0.011), 0.31}, 0.31, 0.0, 14);
      site.pole(bright, {x, s * (w + 0.012), 0.31}, {x, s * (w + 0.02), 0.31}, 0.19, 0.0, 10);
    }
    site.box(bright, {h - 0.08, s * (w - 0.28), 0.58}, {0.1, 0.3, 0.14});
    site.box({MaterialKind::Door, 1, 5}, {-h + 0.03, s * (w - 0.2), 0.62}, {0.08, 0.22, 0.2});
  }
  const auto screen = [&](const Vector2d& low, const Vector2d& high, double out) {
    const double a = side(low.y()) - 0.1, b = side(high.y()) - 0.1;
    const Vector3d off(out * 0.008, 0, 0.008);
    if (out > 0)
      site.quad(glass, off + Vector3d(low.x(), -a, low.y()), off + Vector3d(low.x(), a, low.y()),
                off + Vector3d(high.x(), b, high.y()), off + Vector3d(high.x(), -b, high.y()));
    if (out < 0)
      site.quad(glass, off + Vector3d(low.x(), a, low.y()), off + Vector3d(low.x(), -a, low.y()),
                off + Vector3d(high.x(), -b, high.y()), off + Vector3d(high.x(), b, high.y()));
  };
  const Vector2d f0(1.05, 0.93), f1(0.25, roof - 0.03), r0(rear, 0.93), r1(rear + (van ? 0.1 : 0.55), roof);
  screen(f0 + 0.1 * (f1 - f0), f0 + 0.93 * (f1 - f0), 1);
  screen(r0 + 0.15 * (r1 - r0), r0 + 0.85 * (r1 - r0), -1);
  site.box({MaterialKind::RoadPaint, 1, look}, {h - 0.02, 0, 0.38}, {0.05, 0.5, 0.11});
  site.box({MaterialKind::RoadPaint, 1, look}, {-h, 0, 0.45}, {0.05, 0.5, 0.11});
}

void parkCar(Site& site, double x, double y, double yaw, bool van, std::uint64_t seed) {
  site.beginMover();
  makeCar(site, van, seed);
  const Pose place = poseAt({x, y, site.ground(x, y)}, yaw);
  Mover car = site.take();
  for (Part& part : car.parts) {
    for (Eigen::Vector3f& v : part.vertices) v = (place * v.cast<double>()).cast<float>();
    site.world().parts.push_back(std::move(part));
  }
}

void sendWalker(Site& site, const std::vector<Vector2d>& line, double speed, double phase, std::uint64_t seed) {
  Draw draw(hash(seed, 0x9A1));
  const auto variant = static_cast<std::uint64_t>(draw.index(12));
  const auto look = static_cast<std::uint32_t>(seed % 101);
  const Finish coat{MaterialKind::Cloth, variant, look}, trousers{MaterialKind::Cloth, variant + 20, look},
      skin{MaterialKind::Skin, variant % 3, look}, hair{MaterialKind::Iron, variant % 3, look};
  const double k = draw.uniform(0.93, 1.07);
  site.beginMover();
  for (const double s : {-1.0, 1.0}) {
    site.pole(trousers, {0.14 * s, 0.1 * s, 0.0}, {0, 0.09 * s, 0.85 * k}, 0.07, 0.1);
    site.box(hair, {0.2 * s, 0.1 * s, 0.0}, {0.26, 0.1, 0.08});
    site.pole(coat, {-0.12 * s, 0.27 * s, 0.85 * k}, {0, 0.2 * s, 1.42 * k}, 0.05, 0.07);
  }
  site.pole(coat, {0, 0, 0.8 * k}, {0, 0, 1.25 * k}, 0.18, 0.2, 10);
  site.pole(coat, {0, 0, 1.25 * k}, {0, 0, 1.5 * k}, 0.2, 0.07, 10);
  site.pole(skin, {0, 0, 1.48 * k}, {0.02, 0, 1.62 * k}, 0.06, 0.1, 9);
  site.pole(hair, {0.02, 0, 1.62 * k}, {0, 0, 1.76 * k}, 0.105, 0.04, 9);
  site.release(toAndFro(line, speed, phase, site.world().ground, 0.02));
}

void sendCar(Site& site, const Vector2d& from, const Vector2d& to, double speed, double phase, std::uint64_t seed) {
  site.beginMover();
  makeCar(site, seed % 5 == 0, seed);
  site.release(toAndFro({from, to}, speed, phase, site.world().ground, 0.0));
}

void sendTraffic(Site& site, const Vector2d& from, const Vector2d& to, double speed, int cars, Draw& draw) {
  const double first = draw.uniform();
  for (int i = 0; i < cars; ++i) {
    const std::uint64_t seed = draw.bits();
    site.beginMover();
    makeCar(site, seed % 5 == 0, seed);
    site.release(straightMotion(from, to, speed, first + static_cast<double>(i) / cars, site.world().ground));
  }
}

}  // namespace urban_nav_sim
