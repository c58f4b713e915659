// SPDX-License-Identifier: BSD-3-Clause
#include "camera/eye.hpp"

#include <bitset>

#include "camera/shade.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {

using Eigen::Vector3f;

namespace {

constexpr float kFarDepth = 5000.0F;    // m of depth
constexpr float kShadowOffset = 2e-3F;  // m off the surface, against self-shadowing

/// Spectral weights of a grey sensor: silicon under glass, most sensitive to green and red.
const Vector3f kGrey(0.32F, 0.46F, 0.22F);

int count(std::uint32_t lanes) { return static_cast<int>(std::bitset<kLanes>(lanes).count()); }

}  // namespace

Eye::Eye(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera)
    : snapshot_(snapshot),
      sky_(sky),
      rays_(rays),
      R_(T_world_camera.R().cast<float>()),
      origin_(T_world_camera.t().cast<float>()) {}

void Eye::aim(int lane, int u, int v, float du, float dv, Packet& packet) const {
  const Eigen::Vector2f ideal = rays_.at(u, v) + du * rays_.right(u, v) + dv * rays_.down(u, v);
  packet.setOrigin(lane, origin_);
  packet.setDirection(lane, inWorld(ideal, 1.0F));
  packet.far[lane] = kFarDepth;
  packet.time[lane] = 0.0F;
  packet.active |= 1U << lane;
}

void Eye::examine(const Packet& packet, const std::array<std::array<int, 2>, kLanes>& pixels, std::uint32_t lanes,
                  Seen& seen) const {
  const bool has_sun = sky_.day().light != Light::Night;
  Packet shadow;
  for (int lane = 0; lane < kLanes; ++lane) {
    shadow.setDirection(lane, sky_.day().to_sun);
    shadow.setOrigin(lane, origin_);
    shadow.far[lane] = kFarDepth;
    shadow.time[lane] = 0.0F;
    if ((lanes >> lane & 1U) == 0 || !seen.met(lane)) continue;
    const auto [u, v] = pixels[static_cast<std::size_t>(lane)];
    auto& point = seen.points[static_cast<std::size_t>(lane)];
    point =
        snapshot_.surfaceAt(seen.hits, lane, packet, inWorld(rays_.right(u, v), 0.0F), inWorld(rays_.down(u, v), 0.0F));
    if (!has_sun || !facesSun(point, sky_)) continue;
    shadow.setOrigin(lane, point.position + kShadowOffset * point.normal);
    shadow.active |= 1U << lane;
  }
  seen.sunlit = shadow.active != 0 ? shadow.active & ~snapshot_.occluded(shadow) : 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) seen.shadows[lane] = (seen.sunlit >> lane & 1U) != 0 ? 1 : 0;
  if (sky_.lights().hasLamps()) askLamps(lanes, seen);
}

void Eye::askLamps(std::uint32_t lanes, Seen& seen) const {
  std::array<Lights::Sources, kLanes> sources;
  for (int lane = 0; lane < kLanes; ++lane) {
    if ((lanes >> lane & 1U) == 0 || !seen.met(lane)) continue;
    const auto i = static_cast<std::size_t>(lane);
    sources[i] = sky_.lights().sourcesAt(seen.points[i]);
    seen.lamps[i] = sources[i].scattered;
  }
  for (int k = 0; k < Lights::kMostSources; ++k) {
    Packet shadow;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      shadow.setDirection(lane, Vector3f::UnitZ());
      shadow.setOrigin(lane, origin_);
      shadow.far[lane] = 1.0F;
      shadow.time[lane] = 0.0F;
      if (k >= sources[i].count) continue;
      const Vector3f from = seen.points[i].position + kShadowOffset * seen.points[i].normal;
      shadow.setOrigin(lane, from);
      shadow.setDirection(lane, sources[i].all[static_cast<std::size_t>(k)].to_lamp);
      shadow.active |= 1U << lane;
    }
    if (shadow.active == 0) return;
    const std::uint32_t lit = shadow.active & ~snapshot_.occluded(shadow);
    for (int lane = 0; lane < kLanes; ++lane) {
      if ((lit >> lane & 1U) == 0) continue;
      const auto i = static_cast<std::size_t>(lane);
      const Lights::Source& source = sources[i].all[static_cast<std::size_t>(k)];
      seen.lamps[i] += source.radiance;
      seen.shadows[i] = static_cast<std::uint8_t>(seen.shadows[i] + hash(source.lamp));  // in any order
    }
  }
}

Vector3f Eye::light(const Packet& packet, const Seen& seen, int first, std::uint32_t lanes) const {
  const SurfacePoint& point = seen.points[static_cast<std::size_t>(first)];
  const Vector3f direction = packet.beamDirection(first);
  const float length = direction.norm();
  const auto rays = static_cast<float>(count(lanes));
  Vector3f lamps = Vector3f::Zero();
  if (sky_.lights().hasLamps()) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if ((lanes >> lane & 1U) != 0) lamps += seen.lamps[lane];
    lamps /= rays;
  }
  const float sunlit = static_cast<float>(count(lanes & seen.sunlit)) / rays;
  const Appearance look = lookAt(*point.material, point.spot);
  const Vector3f light = shade(point, look, direction / length, sunlit, lamps, sky_) + sky_.lights().own(point, look);
  return throughAir(light, static_cast<float>(point.distance) * length, sky_);
}

void put(const Vector3f& light, int channels, float* radiance) {
  if (channels == 1) *radiance = kGrey.dot(light);
  else
    for (int i = 0; i < 3; ++i) radiance[i] = light[i];
}

}  // namespace urban_nav_sim
