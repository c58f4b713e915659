// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "camera/eye.hpp"
#include "camera/render.hpp"
#include "camera/seams.hpp"
#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// Pixels through which the edge of a surface or of its shadow may go: of the colour that several rays through each of
/// them see. Looks are filtered over the pixel, edges are not: without this they would jump from pixel to pixel, and
/// with them whatever tracks their corners. Each surface is looked at once a pixel, its share is that of the rays that
/// meet it. Same bytes whatever the number of threads.
void smoothEdges(const Tracer& tracer, const Eye& eye, const Traces& traces, Picture& picture);

}  // namespace urban_nav_sim
