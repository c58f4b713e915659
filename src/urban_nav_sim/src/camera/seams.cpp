// SPDX-License-Identifier: BSD-3-Clause
#include "camera/seams.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

constexpr float kSamePlane = 1e-3F;             // m
constexpr float kSameDirection = 1.0F - 1e-4F;  // cosine
constexpr unsigned kSurface = 1, kShadow = 2, kBits = 3;
constexpr int kRight = 0, kLowerLeft = 2, kBelow = 4, kLowerRight = 6;

bool isLeaf(const Tracer& tracer, std::uint32_t facet) {
  return tracer.partIndex(tracer.facets()[facet]).surface_class == SurfaceClass::Foliage;
}

unsigned seam(const Tracer& tracer, const Traces& traces, std::size_t a, std::size_t b) {
  const Met &one = traces.met[a], &other = traces.met[b];
  const bool is_one = one.facet == other.facet && one.mover == other.mover;
  if (!is_one && !areSame(tracer, one, other)) return kSurface;
  if (traces.shadows[a] != traces.shadows[b]) return kShadow;
  return !is_one && isLeaf(tracer, one.facet) ? kSurface : 0U;
}

}  // namespace

bool areSame(const Tracer& tracer, const Met& a, const Met& b) {
  if (a.mover != b.mover) return false;
  if (a.facet == b.facet) return true;
  if (a.facet == kNothing || b.facet == kNothing) return false;
  const Facet &one = tracer.facets()[a.facet], &other = tracer.facets()[b.facet];
  if (one.part != other.part) return false;
  if (isLeaf(tracer, a.facet)) return true;
  if (!(one.normal.dot(other.normal) > kSameDirection)) return false;
  const Eigen::Vector3f between = other.corner - one.corner;
  return std::min(std::abs(one.normal.dot(between)), std::abs(other.normal.dot(between))) < kSamePlane;
}

Seams::Seams(const Tracer& tracer, const Traces& traces, int width, int height)
    : width_(width), height_(height), pairs_(traces.met.size()) {
  urban_nav_core::forEach(static_cast<std::size_t>(height), 8,
                          [&](std::size_t row) { lookAlong(tracer, traces, static_cast<int>(row)); });
}

void Seams::lookAlong(const Tracer& tracer, const Traces& traces, int v) {
  const auto width = static_cast<std::size_t>(width_), first = static_cast<std::size_t>(v) * width;
  const bool has_below = v + 1 < height_;
  for (std::size_t u = 0; u < width; ++u) {
    const std::size_t here = first + u;
    unsigned bits = 0;
    if (u + 1 < width) bits |= seam(tracer, traces, here, here + 1) << kRight;
    if (has_below) {
      const std::size_t below = here + width;
      if (u > 0) bits |= seam(tracer, traces, here, below - 1) << kLowerLeft;
      bits |= seam(tracer, traces, here, below) << kBelow;
      if (u + 1 < width) bits |= seam(tracer, traces, here, below + 1) << kLowerRight;
    }
    pairs_[here] = static_cast<std::uint8_t>(bits);
  }
}

Edge Seams::at(int u, int v) const {
  const unsigned own = pairs(u, v);
  const unsigned all = own | own >> kLowerLeft | own >> kBelow | own >> kLowerRight | pairs(u - 1, v) >> kRight |
                       pairs(u + 1, v - 1) >> kLowerLeft | pairs(u, v - 1) >> kBelow |
                       pairs(u - 1, v - 1) >> kLowerRight;
  // The bits of other pairs are above the two requested ones.
  if ((all & kBits & kShadow) != 0) return Edge::OfShadow;
  return (all & kSurface) != 0 ? Edge::OfSurface : Edge::None;
}

}  // namespace urban_nav_sim
