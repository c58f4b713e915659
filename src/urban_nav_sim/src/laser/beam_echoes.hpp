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

/// Rays of the cross-section of a beam: centre, then two opposite pairs at half its radius.
constexpr int kRaysOfBeam = 5;
using BeamEchoes = std::array<Echo, kRaysOfBeam>;

/// Returns the echo of the surface hit by a ray; an empty echo without a hit. `width`: angular width of the beam, rad,
/// over which the appearance of the surface is averaged.
Echo makeEcho(const Snapshot& snapshot, const Packet& packet, const Hits& hits, int lane, float width);

/// Returns whether a footprint contains an edge: its ranges differ by more than on a slanted surface.
bool hasEdge(const std::array<double, kRaysOfBeam>& ranges);

/// Returns the echo detected by a device: that of the centre or, at an edge, the mean of the first echo and later ones
/// within `pulse` (m), weighted by their strength at the receiver.
Echo mixEchoes(const BeamEchoes& footprint, double pulse);

}  // namespace urban_nav_sim
