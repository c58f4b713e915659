// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "world/site.hpp"
#include "world/tunnel.hpp"
#include "world/worlds.hpp"

namespace urban_nav_sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kFrom = -240.0, kTo = 560.0;  // m along x; both ends are beyond the range of lasers from every route
constexpr double kPiece = 8.0;                 // m, length of a wall segment
constexpr double kRibDepth = 0.3, kRibLength = 0.6;
constexpr double kLampSpacing = 10.0;  // m, of the lamps under the crown; half of the ribs' spacing

/// Returns the cross-section in the y-z plane, from the foot of the right wall over the crown to that of the left wall.
std::vector<Vector2d> crossSection(double inset) {
  const double half = kTunnelHalfWidth - inset;
  std::vector<Vector2d> line = {{-half, 0.0}, {-half, kTunnelSpring}};
  constexpr int kSteps = 12;
  for (int i = 1; i < kSteps; ++i) {
    const double angle = M_PI * i / kSteps;
    line.emplace_back(-half * std::cos(angle), kTunnelSpring + half * std::sin(angle));
  }
  line.emplace_back(half, kTunnelSpring);
  line.emplace_back(half, 0.0);
  return line;
}

Vector3d at(double x, const Vector2d& place) { return {x, place.x(), place.y()}; }

/// Adds a section of lining from x0 to x1, visible from the inside.
void addLining(Site& site, const Finish& finish, const std::vector<Vector2d>& section, double x0, double x1) {
  double around = 0.0;
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    site.quad(finish, at(x0, section[i]), at(x1, section[i]), at(x1, section[i + 1]), at(x0, section[i + 1]),
              {x0, around});
    around += (section[i + 1] - section[i]).norm();
  }
}

/// Adds the face across the tunnel at x between two cross-sections.
void addStep(Site& site, const Finish& finish, const std::vector<Vector2d>& outer, const std::vector<Vector2d>& inner,
             double x) {
  for (std::size_t i = 0; i + 1 < outer.size(); ++i)
    site.quad(finish, at(x, outer[i]), at(x, outer[i + 1]), at(x, inner[i + 1]), at(x, inner[i]));
}

void addFloor(Site& site) {
  const Finish road{MaterialKind::Asphalt, 1, 3};
  for (double x = kFrom; x < kTo; x += kPiece)
    site.quad(road, {x, -kTunnelHalfWidth, 0}, {x + kPiece, -kTunnelHalfWidth, 0}, {x + kPiece, kTunnelHalfWidth, 0},
              {x, kTunnelHalfWidth, 0}, {x, 0});
}

void addEnd(Site& site, const Finish& finish, double x) {
  const std::vector<Vector2d> section = crossSection(0.0);
  const Vector2d middle(0.0, kTunnelSpring);
  for (std::size_t i = 0; i + 1 < section.size(); ++i)
    site.quad(finish, at(x, section[i]), at(x, section[i + 1]), at(x, middle), at(x, middle));
}

}  // namespace

World buildTunnel(std::uint32_t seed, int day, bool has_ribs) {
  World world;
  world.name = has_ribs ? "ribbed_tunnel" : "tunnel";
  world.day = makeDay(seed, day);
  world.ground = [](double, double) { return 0.0; };
  Site site(world, seed);
  const Finish lining{MaterialKind::Render, 3, seed % 97}, rib{MaterialKind::Kerb, 1, seed % 89};
  addFloor(site);
  const std::vector<Vector2d> wall = crossSection(0.0), inner = crossSection(kRibDepth);
  for (double x = kFrom; x < kTo; x += kPiece) addLining(site, lining, wall, x, x + kPiece);
  for (const double x : {kFrom, kTo}) addEnd(site, lining, x);
  for (double x = kFrom + 0.5 * kLampSpacing; x < kTo; x += kLampSpacing)
    site.lamp({x, 0.0, kTunnelSpring + kTunnelHalfWidth - 0.4});
  if (!has_ribs) return world;
  for (double x = kFrom + 0.5 * kRibSpacing; x < kTo; x += kRibSpacing) {
    addLining(site, rib, inner, x, x + kRibLength);
    addStep(site, rib, wall, inner, x);
    addStep(site, rib, wall, inner, x + kRibLength);
  }
  return world;
}

std::vector<Route> routesOfTunnel() {
  const std::vector<Vector2d> there = {{0, 0}, {60, 0}, {120, 0}};
  std::vector<Vector2d> loops = there;
  loops.insert(loops.end(), {{60, 0}, {0, 0}});
  std::vector<Vector2d> straight = {{0, 0}, {100, 0}, {200, 0}, {300, 0}};
  return {{"loops", "120 m along the tunnel and back", through(loops)},
          {"reversed", "loops from its end to its start", backwards(through(loops))},
          {"straight300", "300 m along the tunnel", through(straight)}};
}

}  // namespace urban_nav_sim
