// SPDX-License-Identifier: BSD-3-Clause
#include "world/building.hpp"

#include <algorithm>
#include <cmath>

#include "noise/hash.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Axes of a wall: along it, up, outward.
struct WallFrame {
  Vector3d start, along;
  Vector3d out() const { return along.cross(Vector3d::UnitZ()); }
  Vector3d at(double u, double v, double depth = 0.0) const {
    return start + u * along + v * Vector3d::UnitZ() - depth * out();
  }
};

void fillOpening(Site& site, const Finish& trim, const WallFrame& f, const Opening& o) {
  const double d = o.depth, t = 0.04;
  const auto at = [&](double u, double v, double depth) { return f.at(u, v, depth); };
  site.quad(trim, at(o.u0, o.v0, 0), at(o.u0, o.v0, d), at(o.u0, o.v1, d), at(o.u0, o.v1, 0));
  site.quad(trim, at(o.u1, o.v0, d), at(o.u1, o.v0, 0), at(o.u1, o.v1, 0), at(o.u1, o.v1, d));
  site.quad(trim, at(o.u0, o.v1, d), at(o.u1, o.v1, d), at(o.u1, o.v1, 0), at(o.u0, o.v1, 0));
  site.quad(trim, at(o.u0, o.v0, 0), at(o.u1, o.v0, 0), at(o.u1, o.v0, d), at(o.u0, o.v0, d));
  const bool door = o.filling.stuff == MaterialKind::Door;
  if (door) {
    site.quad(o.filling, at(o.u0, o.v0, d), at(o.u1, o.v0, d), at(o.u1, o.v1, d), at(o.u0, o.v1, d));
  } else {
    site.pane(o.filling, at(o.u0, o.v0, d), at(o.u1, o.v0, d), at(o.u1, o.v1, d), at(o.u0, o.v1, d));
    const double u0 = o.u0 - 0.08, u1 = o.u1 + 0.08, v0 = o.v0 - 0.1, out = -0.07;  // the sill
    site.quad(trim, at(u0, v0, out), at(u1, v0, out), at(u1, o.v0, out), at(u0, o.v0, out));
    site.quad(trim, at(u0, o.v0, out), at(u1, o.v0, out), at(u1, o.v0, 0), at(u0, o.v0, 0));
  }
  // A flat band around the hole, in front of the wall by t.
  const double b = 0.14;
  for (const auto& [u0, u1, v0, v1] : {std::array<double, 4>{o.u0 - b, o.u0, o.v0, o.v1},
                                       {o.u1, o.u1 + b, o.v0, o.v1},
                                       {o.u0 - b, o.u1 + b, o.v1, o.v1 + 1.3 * b}}) {
    site.quad(trim, at(u0, v0, -t), at(u1, v0, -t), at(u1, v1, -t), at(u0, v1, -t), {u0, v0});
  }
}

std::vector<Opening> placeBays(const Style& s, std::size_t side, double length, double floor) {
  std::vector<Opening> result;
  const int bays = static_cast<int>((length - 0.8) / s.spacing);
  if (bays < 1) return result;
  const double pitch = length / bays;
  for (int storey = 0; storey < s.storeys; ++storey) {
    for (int bay = 0; bay < bays; ++bay) {
      Draw draw(hash(s.seed, side, static_cast<std::uint64_t>(storey), static_cast<std::uint64_t>(bay)));
      const double middle = (bay + 0.5) * pitch, low = floor + storey * s.storey;
      const auto variant = static_cast<std::uint64_t>(draw.index(3));
      const auto seed = static_cast<std::uint32_t>(draw.index(1000));
      if (storey == 0 && s.doors[side] > 0 && bay % s.doors[side] == s.doors[side] / 2) {
        result.push_back({middle - 0.6,
                          middle + 0.6,
                          low + 0.02,
                          low + 2.35,
                          0.3,
                          {MaterialKind::Door, s.door.variant + variant, seed}});
      } else if (s.windows[side] && !draw.chance(s.irregular)) {
        const double half = 0.5 * s.window_width;
        result.push_back({middle - half,
                          middle + half,
                          low + s.sill,
                          low + s.sill + s.window_height,
                          0.18,
                          {s.window, variant, seed}});
      }
    }
  }
  return result;
}

void buildRoof(Site& site, const Extent& e, const Style& s, double eaves) {
  const double over = 0.35, x0 = e.x0 - over, x1 = e.x1 + over, y0 = e.y0 - over, y1 = e.y1 + over;
  if (s.pitch <= 0.0) {
    site.quad(s.trim, {e.x0, e.y0, eaves - 0.3}, {e.x1, e.y0, eaves - 0.3}, {e.x1, e.y1, eaves - 0.3},
              {e.x0, e.y1, eaves - 0.3});
    return;
  }
  const bool along_x = e.x1 - e.x0 > e.y1 - e.y0;
  const double half = 0.5 * (along_x ? y1 - y0 : x1 - x0), ridge = eaves + s.pitch * half, hip = 0.7 * half;
  const double xm = 0.5 * (x0 + x1), ym = 0.5 * (y0 + y1);
  const Vector3d a(x0, y0, eaves), b(x1, y0, eaves), c(x1, y1, eaves), d(x0, y1, eaves);
  const Vector3d p = along_x ? Vector3d(x0 + hip, ym, ridge) : Vector3d(xm, y0 + hip, ridge),
                 q = along_x ? Vector3d(x1 - hip, ym, ridge) : Vector3d(xm, y1 - hip, ridge);
  if (along_x) {
    site.quad(s.roof, a, b, q, p), site.quad(s.roof, c, d, p, q);
    site.quad(s.roof, b, c, q, q), site.quad(s.roof, d, a, p, p);
  } else {
    site.quad(s.roof, b, c, q, p), site.quad(s.roof, d, a, p, q);
    site.quad(s.roof, a, b, p, p), site.quad(s.roof, c, d, q, q);
  }
  site.quad(s.trim, d, c, b, a);  // under the eaves
  Draw draw(hash(s.seed, 0xC41));
  const int stacks = std::max(1, static_cast<int>((along_x ? x1 - x0 : y1 - y0) / 11.0));
  for (int i = 0; i < stacks; ++i) {
    const Vector3d at = p + (q - p) * ((i + draw.uniform(0.2, 0.8)) / stacks);
    site.box(s.wall, at - Vector3d(0, 0, 0.8), {0.9, 0.6, 2.1}, along_x ? 0.0 : M_PI / 2);
  }
}

}  // namespace

void buildWall(Site& site, const Finish& finish, const Finish& trim, const Vector2d& start, const Vector2d& along,
               double length, double low, double high, const std::vector<Opening>& openings) {
  const WallFrame f{{start.x(), start.y(), 0}, {along.x(), along.y(), 0}};
  std::vector<double> cuts = {0.0, length};
  for (const Opening& o : openings) cuts.insert(cuts.end(), {o.u0, o.u1});
  std::sort(cuts.begin(), cuts.end());
  const auto piece = [&](double u0, double u1, double v0, double v1) {
    if (v1 > v0) site.quad(finish, f.at(u0, v0), f.at(u1, v0), f.at(u1, v1), f.at(u0, v1), {u0, v0});
  };
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double u0 = cuts[i], u1 = cuts[i + 1];
    if (u1 - u0 < 1e-9) continue;
    std::vector<Opening> here;
    for (const Opening& o : openings) {
      if (o.u0 < 0.5 * (u0 + u1) && o.u1 > 0.5 * (u0 + u1)) here.push_back(o);
    }
    std::sort(here.begin(), here.end(), [](const Opening& a, const Opening& b) { return a.v0 < b.v0; });
    double v = low;
    for (const Opening& o : here) piece(u0, u1, v, o.v0), v = o.v1;
    piece(u0, u1, v, high);
  }
  for (const Opening& o : openings) fillOpening(site, trim, f, o);
}

void buildHouse(Site& site, const Extent& e, const Style& s) {
  site.beginHouse();
  const double floor = site.ground(0.5 * (e.x0 + e.x1), 0.5 * (e.y0 + e.y1)) + 0.05;
  const double eaves = floor + s.storeys * s.storey + (s.pitch > 0.0 ? 0.1 : 0.9);
  const std::array<Vector2d, 4> corners = {Vector2d(e.x0, e.y0), Vector2d(e.x1, e.y0), Vector2d(e.x1, e.y1),
                                           Vector2d(e.x0, e.y1)};
  for (std::size_t side = 0; side < 4; ++side) {
    const Vector2d start = corners[side], way = corners[(side + 1) % 4] - start;
    const double length = way.norm();
    const Vector2d along = way / length;
    Finish wall = s.wall;
    wall.seed += static_cast<std::uint32_t>(17 * side);
    const std::vector<Opening> openings = placeBays(s, side, length, floor);
    buildWall(site, wall, s.trim, start, along, length, floor - 2.0, eaves, openings);
    const WallFrame f{{start.x(), start.y(), 0}, {along.x(), along.y(), 0}};
    const auto bandPiece = [&](double u0, double u1, double v, double height, double out) {
      const Vector3d p = f.at(u0, v, -out), q = f.at(u1, v, -out), up(0, 0, height);
      site.quad(s.trim, p, q, q + up, p + up, {u0, v});
      site.quad(s.trim, p + up, q + up, f.at(u1, v + height), f.at(u0, v + height));
      site.quad(s.trim, f.at(u0, v), f.at(u1, v), q, p);
    };
    const auto band = [&](double v, double height, double out) { bandPiece(-out, length + out, v, height, out); };
    double from = -0.06;  // the plinth, interrupted at doors
    for (const Opening& o : openings) {
      if (o.filling.stuff != MaterialKind::Door) continue;
      bandPiece(from, o.u0 - 0.14, floor + 0.25, 0.15, 0.06);
      from = o.u1 + 0.14;
    }
    bandPiece(from, length + 0.06, floor + 0.25, 0.15, 0.06);
    for (int i = 1; i < s.storeys; ++i) band(floor + i * s.storey + 0.25, 0.16, 0.07);
    band(eaves - 0.25, 0.22, 0.12);
    if (!s.battlements) continue;
    for (double u = 0.6; u < length - 0.5; u += 1.5)
      site.box(s.wall, f.at(u, eaves, 0.25), {0.8, 0.45, 0.75}, std::atan2(along.y(), along.x()));
  }
  buildRoof(site, e, s, eaves);
}

}  // namespace urban_nav_sim
