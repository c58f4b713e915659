// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// What a ray has met.
struct Met {
  std::uint32_t facet = kNothing;  ///< index of Tracer::facets(), or kNothing
  std::uint32_t mover = kNothing;  ///< of World::movers, or kNothing
};

/// Are they one surface? Facets of one plane are, or of a gentle bend, and so are leaves of a tree, or a pixel of them
/// would be looked at eight times.
bool areSame(const Tracer& tracer, const Met& a, const Met& b);

/// What the ray through the middle of each pixel met, row by row.
struct Traces {
  std::vector<Met> met;
  std::vector<std::uint8_t> sunlit;
};

enum class Edge { None, OfSurface, OfShadow };

/// Where pixels side by side see something else. Each pair is looked at once.
class Seams {
 public:
  Seams(const Tracer& tracer, const Traces& traces, int width, int height);

  /// What may go through a pixel, as the eight about it say; a shadow on a surface before the surface's own edge.
  Edge at(int u, int v) const;

 private:
  void lookAlong(const Tracer& tracer, const Traces& traces, int v);
  unsigned pairs(int u, int v) const {
    return u < 0 || v < 0 || u >= width_
               ? 0U
               : pairs_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
  }

  int width_, height_;
  std::vector<std::uint8_t>
      pairs_;  ///< of each pixel with those to the right, lower left, below and lower right: two bits each
};

}  // namespace urban_nav_sim
