// SPDX-License-Identifier: BSD-3-Clause
#include "camera/render.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "camera/edges.hpp"
#include "camera/eye.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

constexpr int kBlock = 4;  // a packet is a square of pixels
static_assert(kBlock * kBlock == kLanes, "a packet is a square of pixels");

/// Traces one ray through the centre of each pixel of the square with upper left pixel (u0, v0).
void renderBlock(const Eye& eye, int u0, int v0, Picture& picture, Traces& traces) {
  Packet packet;
  std::array<std::array<int, 2>, kLanes> pixels;
  std::uint32_t inside = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const int u = u0 + lane % kBlock, v = v0 + lane / kBlock;
    if (u < picture.width && v < picture.height) inside |= 1U << lane;
    pixels[static_cast<std::size_t>(lane)] = {std::min(u, picture.width - 1), std::min(v, picture.height - 1)};
    eye.aim(lane, std::min(u, picture.width - 1), std::min(v, picture.height - 1), 0.0F, 0.0F, packet);
  }
  packet.active = inside;
  Eye::Seen seen;
  eye.trace(packet, seen);
  eye.examine(packet, pixels, inside, seen);
  for (int lane = 0; lane < kLanes; ++lane) {
    if ((inside >> lane & 1U) == 0) continue;
    const bool met = seen.met(lane);
    const auto& point = seen.points[static_cast<std::size_t>(lane)];
    const std::size_t pixel = picture.at(u0 + lane % kBlock, v0 + lane / kBlock);
    traces.met[pixel] = {seen.hits.facet[lane], met ? seen.hits.mover[lane] : kNothing};
    traces.shadows[pixel] = seen.shadows[static_cast<std::size_t>(lane)];
    picture.depth[pixel] = met ? static_cast<float>(point.distance) : std::numeric_limits<float>::infinity();
    picture.surface_class[pixel] = static_cast<std::uint8_t>(met ? point.surface_class : SurfaceClass::Other);
    put(met ? eye.light(packet, seen, lane, 1U << lane) : eye.skyLight(packet.beamDirection(lane)), picture.channels,
        &picture.radiance[pixel * static_cast<std::size_t>(picture.channels)]);
  }
}

}  // namespace

void render(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera,
            Colours colours, Picture& picture) {
  picture.width = rays.width();
  picture.height = rays.height();
  picture.channels = colours == Colours::Grey ? 1 : 3;
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  picture.radiance.resize(pixels * static_cast<std::size_t>(picture.channels));
  picture.depth.resize(pixels);
  picture.surface_class.resize(pixels);
  Traces traces;
  traces.met.resize(pixels);
  traces.shadows.resize(pixels);
  const Eye eye(snapshot, sky, rays, T_world_camera);
  const auto stripes = static_cast<std::size_t>((picture.height + kBlock - 1) / kBlock);
  urban_nav_core::forEach(stripes, 2, [&](std::size_t stripe) {
    for (int u = 0; u < picture.width; u += kBlock)
      renderBlock(eye, u, static_cast<int>(stripe) * kBlock, picture, traces);
  });
  smoothEdges(snapshot.tracer(), eye, traces, picture);
}

}  // namespace urban_nav_sim
