// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/feature_quadtree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace urban_nav_core {

FeatureQuadtree::FeatureQuadtree(int width, int height, int most, int deepest, double slack)
    : width_(width), height_(height), deepest_(deepest) {
  assert(width > 0 && height > 0 && most >= 1 && deepest >= 0 && deepest <= 10 && slack >= 1.0);
  std::size_t nodes = 0;
  for (int depth = 0; depth <= deepest; ++depth) {
    const double parts = std::ldexp(1.0, 2 * depth);
    allowed_.push_back(std::min(most, static_cast<int>(std::ceil(slack * most / parts))));
    nodes += static_cast<std::size_t>(parts);
  }
  counts_.assign(nodes, 0);
}

void FeatureQuadtree::clear() { std::fill(counts_.begin(), counts_.end(), 0); }

bool FeatureQuadtree::isInside(double u, double v) const {
  return u >= -0.5 && v >= -0.5 && u < width_ - 0.5 && v < height_ - 0.5;
}

std::size_t FeatureQuadtree::index(double u, double v, int depth) const {
  const int parts = 1 << depth;
  const auto part = [parts](double x, int size) {
    return std::clamp(static_cast<int>((x + 0.5) / size * parts), 0, parts - 1);
  };
  const int before = ((1 << (2 * depth)) - 1) / 3;  // nodes of the depths above: 1 + 4 + 16 + ...
  return static_cast<std::size_t>(before + part(v, height_) * parts + part(u, width_));
}

bool FeatureQuadtree::mayAdd(double u, double v) const {
  if (!isInside(u, v)) return false;
  for (int depth = 0; depth <= deepest_; ++depth) {
    if (countAt(u, v, depth) >= allowedAt(depth)) return false;
  }
  return true;
}

void FeatureQuadtree::add(double u, double v) {
  if (!isInside(u, v)) return;
  for (int depth = 0; depth <= deepest_; ++depth) ++counts_[index(u, v, depth)];
}

void FeatureQuadtree::remove(double u, double v) {
  if (!isInside(u, v)) return;
  for (int depth = 0; depth <= deepest_; ++depth) {
    int& count = counts_[index(u, v, depth)];
    assert(count > 0);
    --count;
  }
}

}  // namespace urban_nav_core
