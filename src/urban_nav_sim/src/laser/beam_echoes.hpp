// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// Echo of one ray of a beam, or of the whole beam.
struct Echo {
  double range = std::numeric_limits<double>::infinity();  ///< m
  double strength = 0.0;                                   ///< albedo times cosine of incidence
  SurfaceClass surface_class = SurfaceClass::Other;
};

/// Rays of a beam's cross-section: its middle, then two pairs opposite each other at half its radius.
constexpr int kRaysOfBeam = 5;
using BeamEchoes = std::array<Echo, kRaysOfBeam>;

/// Returns the echo of the surface that a ray has met; of none if it met nothing. `width`: angle of the beam there,
/// rad, over which the appearance of the surface is averaged.
Echo makeEcho(const Snapshot& snapshot, const Packet& packet, const Hits& hits, int lane, float width);

/// Returns whether the ranges of a footprint differ by more than a slanted surface explains: an edge goes through it.
bool hasEdge(const std::array<double, kRaysOfBeam>& ranges);

/// Returns what a device takes for one echo: that of the middle or, at an edge, the mean of the first echo and of those
/// that follow it within `pulse` (m), weighted by their strength at the receiver.
Echo mixEchoes(const BeamEchoes& footprint, double pulse);

}  // namespace urban_nav_sim
