// SPDX-License-Identifier: BSD-3-Clause
#include "edge_width.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace swf_vo {

using urban_nav_core::ImageView;

namespace {

constexpr int kEdgeColumnStep = 4, kEdgeRowStep = 4;
constexpr int kEdgeReach = 3;      // px, over which the slope of an edge is measured
constexpr int kSteepestPart = 50;  // the steepest 2 % of the positions: edges, even if most of the scene is smooth

/// Histogram of positions by the change of grey level over kEdgeReach pixels, with the squared change of slope.
struct Rises {
  std::array<std::int32_t, 256> count{};
  std::array<std::int64_t, 256> bends{};

  void add(int a, int b, int c, int d) {
    const auto rise = static_cast<std::size_t>(std::abs(d - a));
    const int bend = (d - c) - (b - a);
    ++count[rise];
    bends[rise] += bend * bend;
  }

  double variance(std::int64_t places) const {
    std::int64_t wanted = places / kSteepestPart + 1;
    double slopes = 0.0, curved = 0.0;
    for (std::size_t rise = count.size() - 1; rise > 0 && wanted > 0; --rise) {
      const double r = static_cast<double>(rise) / kEdgeReach;
      slopes += static_cast<double>(count[rise]) * r * r;
      curved += static_cast<double>(bends[rise]);
      wanted -= count[rise];
    }
    return slopes > 0.0 ? slopes / std::max(curved, 1.0) : 0.0;
  }
};

constexpr double kNoticed = 1.0;       // px^2
constexpr double kScenesDiffer = 2.0;  // ratio of edge widths between scenes

}  // namespace

Eigen::Vector2d edgeVariance(const ImageView& image) {
  Rises across, down;
  std::int64_t places = 0;
  for (int v = 0; v + kEdgeReach < image.height; v += kEdgeRowStep) {
    const std::uint8_t *p = image.row(v), *q = image.row(v + 1), *r = image.row(v + 2), *s = image.row(v + 3);
    for (int u = 0; u + kEdgeReach < image.width; u += kEdgeColumnStep, ++places) {
      across.add(p[u], p[u + 1], p[u + 2], p[u + 3]);
      down.add(p[u], q[u], r[u], s[u]);
    }
  }
  return {across.variance(places), down.variance(places)};
}

Eigen::Vector2d widening(const Eigen::Vector2d& edges, const Eigen::Vector2d& others) {
  Eigen::Vector2d more = Eigen::Vector2d::Zero();
  for (int i = 0; i < 2; ++i)
    if (edges[i] > std::max(kScenesDiffer * others[i], others[i] + kNoticed)) more[i] = edges[i] - others[i];
  return more;
}

Eigen::Vector2d widening(const Edges& edges, const Edges& others) {
  const Eigen::Vector2d left = widening(edges.left, others.left), right = widening(edges.right, others.right);
  return (left.array() > 0.0 && right.array() > 0.0).select(0.5 * (left + right), 0.0);
}

}  // namespace swf_vo
