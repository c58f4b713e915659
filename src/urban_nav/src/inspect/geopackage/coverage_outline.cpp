// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/geopackage/coverage_outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace urban_nav {

namespace {

using Cell = GridCell;
using Corner = std::pair<int, int>;

/// Edges of the outline by their first corner, with the area on their left. At most two begin at a corner.
using Edges = std::multimap<Corner, Corner>;

Edges outlineEdges(const std::set<Cell>& cells) {
  Edges edges;
  for (const auto& [x, y] : cells) {
    if (cells.count({x, y - 1}) == 0) edges.insert({{x, y}, {x + 1, y}});
    if (cells.count({x + 1, y}) == 0) edges.insert({{x + 1, y}, {x + 1, y + 1}});
    if (cells.count({x, y + 1}) == 0) edges.insert({{x + 1, y + 1}, {x, y + 1}});
    if (cells.count({x - 1, y}) == 0) edges.insert({{x, y + 1}, {x, y}});
  }
  return edges;
}

/// Removes and returns the edge that begins at `at`. Of two edges, returns the left one, so that cells that share only
/// a corner have separate outlines.
Corner takeNext(Edges& edges, const Corner& before, const Corner& at) {
  const auto [first, last] = edges.equal_range(at);
  auto chosen = first;
  for (auto edge = first; edge != last; ++edge) {
    const int dx = at.first - before.first, dy = at.second - before.second;
    const int ex = edge->second.first - at.first, ey = edge->second.second - at.second;
    if (dx * ey - dy * ex > 0) chosen = edge;
  }
  const Corner next = chosen->second;
  edges.erase(chosen);
  return next;
}

/// Splits a ring where it touches itself: each part is simple.
void appendSimple(const std::vector<Corner>& ring, std::vector<std::vector<Corner>>& rings) {
  std::vector<Corner> open;
  for (const Corner& corner : ring) {
    const auto known = std::find(open.begin(), open.end(), corner);
    if (known != open.end()) {
      rings.emplace_back(known, open.end());
      open.erase(known, open.end());
    }
    open.push_back(corner);
  }
  rings.push_back(std::move(open));
}

std::vector<std::vector<Corner>> traceRings(Edges edges) {
  std::vector<std::vector<Corner>> rings;
  while (!edges.empty()) {
    const Corner start = edges.begin()->first;
    Corner before = start, at = edges.begin()->second;
    edges.erase(edges.begin());
    std::vector<Corner> ring = {start};
    while (at != start) {
      const Corner next = takeNext(edges, before, at);
      const bool is_straight = (at.first - before.first) * (next.second - at.second) ==
                               (at.second - before.second) * (next.first - at.first);
      if (!is_straight) ring.push_back(at);
      before = at;
      at = next;
    }
    appendSimple(ring, rings);
  }
  return rings;
}

/// Twice the area of a ring; negative for a hole.
double signedArea(const std::vector<Corner>& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += static_cast<double>(a.first) * b.second - static_cast<double>(b.first) * a.second;
  }
  return sum;
}

/// Returns whether a point, not on an edge, is inside a ring.
bool contains(const std::vector<Corner>& ring, const Eigen::Vector2d& p) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (a.first == b.first && (a.second > p.y()) != (b.second > p.y()) && a.first > p.x()) is_inside = !is_inside;
  }
  return is_inside;
}

/// Returns a point of the area around a hole, half a cell from its first edge.
Eigen::Vector2d nearHole(const std::vector<Corner>& hole) {
  const Corner &a = hole[0], &b = hole[1];
  const Eigen::Vector2d along(b.first - a.first, b.second - a.second);
  const Eigen::Vector2d left(-along.y(), along.x());
  return Eigen::Vector2d(a.first, a.second) + 0.5 * (along + left) / along.norm();
}

Geometry::Ring toRing(const std::vector<Corner>& corners, double cell) {
  Geometry::Ring ring;
  for (const auto& [x, y] : corners) ring.emplace_back(x * cell, y * cell);
  return ring;
}

}  // namespace

std::set<GridCell> cellsAround(const std::vector<Eigen::Vector2d>& path, double reach, double cell) {
  const auto number = [cell](double value) { return static_cast<int>(std::floor(value / cell)); };
  std::set<GridCell> cells;
  const Eigen::Vector2d* last = nullptr;
  for (const Eigen::Vector2d& p : path) {
    if (last != nullptr && (p - *last).norm() < 0.25 * cell) continue;
    last = &p;
    for (int x = number(p.x() - reach); x <= number(p.x() + reach); ++x)
      for (int y = number(p.y() - reach); y <= number(p.y() + reach); ++y)
        if ((Eigen::Vector2d(x + 0.5, y + 0.5) * cell - p).norm() <= reach) cells.insert({x, y});
  }
  return cells;
}

Coverage coverageAround(const std::vector<Eigen::Vector2d>& path, double reach, double cell) {
  const std::set<Cell> cells = cellsAround(path, reach, cell);
  const std::vector<std::vector<Corner>> rings = traceRings(outlineEdges(cells));
  Coverage coverage;
  coverage.area_m2 = static_cast<double>(cells.size()) * cell * cell;
  std::vector<const std::vector<Corner>*> outer;
  for (const std::vector<Corner>& ring : rings) {
    if (signedArea(ring) < 0.0) continue;
    outer.push_back(&ring);
    coverage.polygons.push_back({toRing(ring, cell)});
  }
  for (const std::vector<Corner>& ring : rings) {
    if (signedArea(ring) > 0.0) continue;
    const Eigen::Vector2d p = nearHole(ring);
    std::size_t smallest = outer.size();
    for (std::size_t i = 0; i < outer.size(); ++i)
      if (contains(*outer[i], p) && (smallest == outer.size() || signedArea(*outer[i]) < signedArea(*outer[smallest])))
        smallest = i;
    if (smallest < outer.size()) coverage.polygons[smallest].push_back(toRing(ring, cell));
  }
  return coverage;
}

}  // namespace urban_nav
