// SPDX-License-Identifier: BSD-3-Clause
#include "world/terrain.hpp"

#include <algorithm>
#include <cmath>

#include "noise/hash.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kCell = 1.0 / 3.0;

/// A vertex of the mesh with the values of all regions.
struct Corner {
  Vector2d at;
  std::vector<float> inside;
};

Corner between(const Corner& a, const Corner& b, std::size_t region) {
  const float share = a.inside[region] / (a.inside[region] - b.inside[region]);
  Corner c{a.at + static_cast<double>(share) * (b.at - a.at), a.inside};
  for (std::size_t i = 0; i < c.inside.size(); ++i) c.inside[i] += share * (b.inside[i] - a.inside[i]);
  c.inside[region] = 0.0F;
  return c;
}

/// Returns the part of a convex polygon where the function of the region has the requested sign.
std::vector<Corner> cut(const std::vector<Corner>& polygon, std::size_t region, bool inside) {
  std::vector<Corner> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float fa = a.inside[region], fb = b.inside[region];
    if (inside ? fa >= 0.0F : fa <= 0.0F) result.push_back(a);
    if ((fa > 0.0F && fb < 0.0F) || (fa < 0.0F && fb > 0.0F))
      result.push_back(fa < fb ? between(a, b, region) : between(b, a, region));
  }
  return result;
}

void addPolygon(Site& site, const Finish& finish, const std::vector<Corner>& polygon) {
  if (polygon.size() < 3) return;
  Part& part = site.part(finish);
  const auto first = static_cast<std::uint32_t>(part.vertices.size());
  for (const Corner& c : polygon) {
    part.vertices.push_back(Vector3d(c.at.x(), c.at.y(), site.ground(c.at.x(), c.at.y())).cast<float>());
    part.texture.push_back(c.at.cast<float>());
  }
  for (std::uint32_t i = 2; i < polygon.size(); ++i) part.triangles.push_back({first, first + i - 1, first + i});
}

}  // namespace

std::function<double(double, double)> makeGround(std::uint64_t seed, double relief) {
  struct Wave {
    double kx, ky, phase, amplitude;
  };
  std::vector<Wave> waves;
  Draw draw(hash(seed, 0x6E0));
  for (const double length : {60.0, 43.0, 29.0, 19.0, 11.0}) {
    const double angle = draw.uniform(0, 2 * M_PI), k = 2 * M_PI / length;
    waves.push_back(
        {k * std::cos(angle), k * std::sin(angle), draw.uniform(0, 2 * M_PI), relief * std::pow(length / 60.0, 1.6)});
  }
  const auto raw = [waves](double x, double y) {
    double z = 0.0;
    for (const Wave& w : waves) z += w.amplitude * std::sin(w.kx * x + w.ky * y + w.phase);
    return z;
  };
  return [raw, zero = raw(0, 0)](double x, double y) { return raw(x, y) - zero; };
}

void layGround(Site& site, const Extent& e, const std::vector<Region>& regions) {
  const int nx = static_cast<int>(std::ceil((e.x1 - e.x0) / kCell)),
            ny = static_cast<int>(std::ceil((e.y1 - e.y0) / kCell));
  const auto corner = [&](int i, int j) {
    Corner c{{e.x0 + i * kCell, e.y0 + j * kCell}, {}};
    for (std::size_t r = 0; r + 1 < regions.size(); ++r)
      c.inside.push_back(static_cast<float>(regions[r].inside(c.at.x(), c.at.y())));
    return c;
  };
  std::vector<Corner> row, next;
  for (int i = 0; i <= nx; ++i) next.push_back(corner(i, 0));
  for (int j = 0; j < ny; ++j) {
    row = std::move(next);
    next.clear();
    for (int i = 0; i <= nx; ++i) next.push_back(corner(i, j + 1));
    for (int i = 0; i < nx; ++i) {
      const auto k = static_cast<std::size_t>(i);
      for (std::vector<Corner> rest :
           {std::vector<Corner>{row[k], row[k + 1], next[k + 1]}, std::vector<Corner>{row[k], next[k + 1], next[k]}}) {
        for (std::size_t r = 0; r + 1 < regions.size() && rest.size() >= 3; ++r) {
          const bool any = std::any_of(rest.begin(), rest.end(), [&](const Corner& c) { return c.inside[r] > 0.0F; });
          if (!any) continue;
          addPolygon(site, regions[r].finish, cut(rest, r, true));
          const bool more = std::any_of(rest.begin(), rest.end(), [&](const Corner& c) { return c.inside[r] < 0.0F; });
          rest = more ? cut(rest, r, false) : std::vector<Corner>();
        }
        addPolygon(site, regions.back().finish, rest);
      }
    }
  }
}

void laySurroundings(Site& site, const Extent& e, double reach, const Finish& finish) {
  const double cell = 6.0;
  for (double x = e.x0 - reach; x < e.x1 + reach; x += cell) {
    for (double y = e.y0 - reach; y < e.y1 + reach; y += cell) {
      if (x > e.x0 && x + cell < e.x1 && y > e.y0 && y + cell < e.y1) continue;
      const auto at = [&](double px, double py) { return Vector3d(px, py, site.ground(px, py) - 0.15); };
      site.quad(finish, at(x, y), at(x + cell, y), at(x + cell, y + cell), at(x, y + cell), {x, y});
    }
  }
}

void layStrip(Site& site, const Finish& top, const Finish& side, const Vector2d& from, const Vector2d& to, double width,
              double height) {
  const double length = (to - from).norm();
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / 0.7)));
  const Vector2d along = (to - from) / length, left(-along.y(), along.x());
  const auto at = [&](double s, double off, double above) {
    const Vector2d p = from + s * along + off * left;
    return Vector3d(p.x(), p.y(), site.ground(p.x(), p.y()) + above);
  };
  const double h = 0.5 * width;
  for (int i = 0; i < pieces; ++i) {
    const double s0 = length * i / pieces, s1 = length * (i + 1) / pieces;
    site.quad(top, at(s0, -h, height), at(s1, -h, height), at(s1, h, height), at(s0, h, height), {s0, 0});
    if (height < 0.01) continue;
    site.quad(side, at(s0, -h, -0.1), at(s1, -h, -0.1), at(s1, -h, height), at(s0, -h, height), {s0, 0});
    site.quad(side, at(s1, h, -0.1), at(s0, h, -0.1), at(s0, h, height), at(s1, h, height), {-s1, 0});
  }
  if (height < 0.01) return;
  site.quad(side, at(0, h, -0.1), at(0, -h, -0.1), at(0, -h, height), at(0, h, height));
  site.quad(side, at(length, -h, -0.1), at(length, h, -0.1), at(length, h, height), at(length, -h, height));
}

std::function<double(double, double)> patches(const Extent& e, int count, std::uint64_t seed) {
  Draw draw(hash(seed, 0x9A7C));
  std::vector<Extent> all;
  for (int i = 0; i < count; ++i) {
    const double x = draw.uniform(e.x0, e.x1), y = draw.uniform(e.y0, e.y1), w = draw.uniform(0.8, 5.0),
                 h = draw.uniform(0.8, 2.0);
    all.push_back({x, y, x + w, y + h});
  }
  return [all](double x, double y) {
    double best = -1e9;
    for (const Extent& p : all) best = std::max(best, std::min({x - p.x0, p.x1 - x, y - p.y0, p.y1 - y}));
    return best;
  };
}

double distanceTo(const std::vector<Vector2d>& line, double x, double y) {
  double best = 1e9;
  const Vector2d p(x, y);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector2d d = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(d) / std::max(d.squaredNorm(), 1e-12), 0.0, 1.0);
    best = std::min(best, (p - line[i] - t * d).squaredNorm());
  }
  return std::sqrt(best);
}

double insideRectangle(const Extent& e, double radius, double x, double y) {
  const double dx = std::max({e.x0 + radius - x, x - e.x1 + radius, 0.0}),
               dy = std::max({e.y0 + radius - y, y - e.y1 + radius, 0.0});
  const double inner = std::min({x - e.x0, e.x1 - x, y - e.y0, e.y1 - y});
  return dx > 0.0 && dy > 0.0 ? radius - std::hypot(dx, dy) : inner;
}

}  // namespace urban_nav_sim
