// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// Hit of a ray.
struct Met {
  std::uint32_t facet = kNothing;  ///< index of Tracer::facets(), or kNothing
  std::uint32_t mover = kNothing;  ///< of World::movers, or kNothing
};

/// Returns whether two hits are on the same surface: facets of one plane or of a smooth bend. Leaves of a tree count as
/// the same surface; otherwise each of their pixels would be sampled repeatedly.
bool areSame(const Tracer& tracer, const Met& a, const Met& b);

/// Hits of the rays through the centres of the pixels, row by row.
struct Traces {
  std::vector<Met> met;
  std::vector<std::uint8_t> shadows;  ///< differs between points to which other lights are hidden
};

enum class Edge { None, OfSurface, OfShadow };

/// Discontinuities between neighbouring pixels. Each pair is evaluated once.
class Seams {
 public:
  Seams(const Tracer& tracer, const Traces& traces, int width, int height);

  /// Returns the kind of edge that may pass through a pixel, from its eight neighbours; shadow edges take precedence.
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
      pairs_;  ///< each pixel with its right, lower left, lower and lower right neighbour: two bits each
};

}  // namespace urban_nav_sim
