// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "noise/hash.hpp"
#include "world/props.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Adds a square card of leaves at a point with random rotation and a random offset on the leaf texture.
void addCard(Part& part, const Vector3d& centre, double size, Draw& draw) {
  const Vector3d u = Vector3d(draw.normal(), draw.normal(), 0.6 * draw.normal()).normalized();
  const Vector3d v = u.cross(Vector3d(draw.normal(), draw.normal(), draw.normal())).normalized();
  const Vector2d at(draw.uniform(0, 2), draw.uniform(0, 2));
  const auto first = static_cast<std::uint32_t>(part.vertices.size());
  for (const auto& [a, b] : {std::pair<double, double>{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    part.vertices.push_back((centre + 0.5 * size * (a * u + b * v)).cast<float>());
    part.texture.push_back((at + 0.5 * size * Vector2d(a, b)).cast<float>());
  }
  part.triangles.push_back({first, first + 1, first + 2});
  part.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

void plantTree(Site& site, double x, double y, double height, std::uint64_t seed) {
  Draw draw(hash(seed, 0x72EE));
  const Finish bark{MaterialKind::Bark, seed % 2, static_cast<std::uint32_t>(seed % 97)};
  const Finish leaves{seed % 3 == 0 ? MaterialKind::SmallLeaves : MaterialKind::Leaves, seed % 4,
                      static_cast<std::uint32_t>(seed % 31)};
  const Vector3d root(x, y, site.ground(x, y) - 0.1),
      fork = root + Vector3d(0.04 * height * draw.normal(), 0.04 * height * draw.normal(), 0.38 * height);
  const double radius = 0.028 * height;
  site.pole(bark, root, root + Vector3d(0, 0, 0.3), 1.5 * radius, radius, 9);
  site.pole(bark, root + Vector3d(0, 0, 0.3), fork, radius, 0.75 * radius, 9);
  const double crown = 0.3 * height;
  const int boughs = 6 + draw.index(4);
  for (int i = 0; i < boughs; ++i) {
    const double angle = 2 * M_PI * (i + draw.uniform(0, 0.7)) / boughs, rise = draw.uniform(0.5, 1.5);
    const Vector3d tip =
        fork + crown * Vector3d(std::cos(angle), std::sin(angle), rise).normalized() * draw.uniform(0.8, 1.25);
    site.pole(bark, fork, tip, 0.4 * radius, 0.12 * radius, 5);
    const double clump = draw.uniform(0.45, 0.65) * crown;
    for (int k = 0; k < 34; ++k) {
      // Denser near the surface of the clump than inside.
      const Vector3d way = Vector3d(draw.normal(), draw.normal(), 0.8 * draw.normal()).normalized();
      addCard(site.part(leaves), tip + clump * std::cbrt(draw.uniform(0.2, 1.0)) * way, draw.uniform(0.7, 1.2), draw);
    }
  }
}

void plantHedge(Site& site, const Vector2d& from, const Vector2d& to, double width, double height, MaterialKind stuff,
                std::uint64_t seed) {
  Draw draw(hash(seed, 0x4ED6));
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length, left(-along.y(), along.x());
  const int n = std::max(2, static_cast<int>(length / 0.3));
  constexpr int kRound = 7;  // points of the profile, from the foot on the right to that on the left
  const Finish finish{stuff, seed % 3, static_cast<std::uint32_t>(seed % 211)},
      loose{MaterialKind::SmallLeaves, seed % 4, static_cast<std::uint32_t>(seed % 13)};
  std::vector<std::vector<Vector3d>> rings;
  for (int i = 0; i <= n; ++i) {
    const double ends = std::min(1.0, 0.75 + 0.5 * std::min(i, n - i));
    rings.emplace_back();
    for (int k = 0; k < kRound; ++k) {
      const double side[kRound] = {-1, -1.02, -0.95, 0, 0.95, 1.02, 1},
                   up[kRound] = {-0.05, 0.5, 0.93, 1.0, 0.93, 0.5, -0.05};
      const Vector2d p = from + along * (length * i / n) + left * (0.5 * width * ends * side[k] + 0.03 * draw.normal());
      rings.back().emplace_back(
          p.x(), p.y(),
          site.ground(p.x(), p.y()) + height * ends * up[k] + (k > 0 && k < kRound - 1 ? 0.025 * draw.normal() : 0.0));
    }
  }
  double around = 0.0;
  for (std::size_t k = 0; k + 1 < kRound; ++k) {
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      site.quad(finish, rings[i][k], rings[i + 1][k], rings[i + 1][k + 1], rings[i][k + 1],
                {length * static_cast<double>(i) / n, around});
    }
    around += (rings[0][k + 1] - rings[0][k]).norm();
  }
  for (const bool first : {true, false}) {
    const auto& r = first ? rings.front() : rings.back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (first) site.quad(finish, r[kRound - 1 - k], r[k], r[k + 1], r[kRound - 2 - k]);
      if (!first) site.quad(finish, r[k], r[kRound - 1 - k], r[kRound - 2 - k], r[k + 1]);
    }
  }
  const int cards = static_cast<int>(length * (width + 2 * height) * 2.0);
  for (int i = 0; i < cards; ++i) {
    const auto ring = static_cast<std::size_t>(draw.index(n)), k = static_cast<std::size_t>(1 + draw.index(kRound - 2));
    addCard(site.part(loose), rings[ring][k] + 0.04 * Vector3d(draw.normal(), draw.normal(), draw.normal()),
            draw.uniform(0.2, 0.4), draw);
  }
}

void plantBelt(Site& site, const std::vector<Vector2d>& line, std::uint64_t seed) {
  Draw draw(hash(seed, 0xBE17));
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector2d d = line[i + 1] - line[i], along = d.normalized(), out(along.y(), -along.x());
    for (double s = 0.0; s < d.norm();) {
      const double length = draw.uniform(5, 11);
      const Vector2d a = line[i] + s * along + draw.uniform(0, 2) * out;
      if (draw.chance(0.85))
        plantHedge(site, a, a + 0.9 * length * along, 2.0, draw.uniform(1.5, 3.0), MaterialKind::Shrub, draw.bits());
      const Vector2d t = a + 3.0 * out + 0.5 * length * along;
      plantTree(site, t.x(), t.y(), draw.uniform(8, 14), draw.bits());
      s += length;
    }
  }
}

}  // namespace urban_nav_sim
