// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "camera/eye.hpp"
#include "camera/render.hpp"
#include "camera/seams.hpp"
#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// Antialiases pixels that may contain the edge of a surface or of its shadow, with several rays each. Appearances are
/// already filtered over the pixel, edges are not: they would move in steps of a pixel, which disturbs tracking of
/// their corners. Each surface is evaluated once per pixel, weighted by its share of the rays. The result does not
/// depend on the number of threads.
void smoothEdges(const Tracer& tracer, const Eye& eye, const Traces& traces, Picture& picture);

}  // namespace urban_nav_sim
