// SPDX-License-Identifier: BSD-3-Clause
#include "camera/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "camera/shade.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3f;

constexpr int kBlock = 4;  // a packet is a square of pixels
static_assert(kBlock * kBlock == kLanes, "a packet is a square of pixels");
constexpr float kFar = 5000.0F;         // m of depth
constexpr float kShadowOffset = 2e-3F;  // m off the surface, so that it does not shade itself

/// What a grey sensor makes of colours: silicon behind glass, most sensitive to green and red.
const Vector3f kGrey(0.32F, 0.46F, 0.22F);

class Block {
 public:
  Block(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera)
      : snapshot_(snapshot),
        sky_(sky),
        rays_(rays),
        R_(T_world_camera.R().cast<float>()),
        origin_(T_world_camera.t().cast<float>()) {}

  /// The packet whose upper left pixel is (u0, v0), into the picture.
  void render(int u0, int v0, Picture& picture) const {
    const int columns = std::min(kBlock, picture.width - u0), rows = std::min(kBlock, picture.height - v0);
    Packet packet;
    aim(u0, v0, columns, rows, packet);
    Hits hits;
    snapshot_.closest(packet, hits);

    std::array<SurfacePoint, kLanes> points;
    Packet shadow;
    const std::uint32_t to_sun = surfaces(u0, v0, packet, hits, points, shadow);
    shadow.active = to_sun;
    const std::uint32_t shaded = to_sun != 0 ? snapshot_.occluded(shadow) : 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      if ((packet.active >> lane & 1U) == 0) continue;
      const bool met = hits.facet[lane] != kNothing;
      const bool sunlit = ((to_sun & ~shaded) >> lane & 1U) != 0;
      const auto& point = points[static_cast<std::size_t>(lane)];
      const Vector3f light = met ? surfaceLight(point, packet.directionOf(lane), sunlit)
                                 : sky_.radiance(packet.directionOf(lane).normalized());
      const std::size_t pixel = picture.at(u0 + lane % kBlock, v0 + lane / kBlock);
      picture.depth[pixel] = met ? static_cast<float>(point.distance) : std::numeric_limits<float>::infinity();
      picture.surface_class[pixel] = static_cast<std::uint8_t>(met ? point.surface_class : SurfaceClass::Other);
      if (picture.channels == 1) {
        picture.radiance[pixel] = kGrey.dot(light);
      } else {
        for (std::size_t i = 0; i < 3; ++i) picture.radiance[3 * pixel + i] = light[static_cast<Eigen::Index>(i)];
      }
    }
  }

 private:
  Vector3f inWorld(const Eigen::Vector2f& ideal, float z) const { return R_ * Vector3f(ideal.x(), ideal.y(), z); }

  void aim(int u0, int v0, int columns, int rows, Packet& packet) const {
    packet.active = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const int u = lane % kBlock, v = lane / kBlock;
      const bool inside = u < columns && v < rows;
      packet.setOrigin(lane, origin_);
      packet.setDirection(lane, inWorld(rays_.at(u0 + (inside ? u : 0), v0 + (inside ? v : 0)), 1.0F));
      packet.far[lane] = kFar;
      packet.time[lane] = 0.0F;
      if (inside) packet.active |= 1U << lane;
    }
  }

  /// The points that were met, and the rays from them to the sun; returns which of those are worth a look.
  std::uint32_t surfaces(int u0, int v0, const Packet& packet, const Hits& hits,
                         std::array<SurfacePoint, kLanes>& points, Packet& shadow) const {
    std::uint32_t to_sun = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      shadow.setDirection(lane, sky_.day().to_sun);
      shadow.setOrigin(lane, origin_);
      shadow.far[lane] = kFar;
      shadow.time[lane] = 0.0F;
      if ((packet.active >> lane & 1U) == 0 || hits.facet[lane] == kNothing) continue;
      const int u = u0 + lane % kBlock, v = v0 + lane / kBlock;
      auto& point = points[static_cast<std::size_t>(lane)];
      point =
          snapshot_.surfaceAt(hits, lane, packet, inWorld(rays_.right(u, v), 0.0F), inWorld(rays_.down(u, v), 0.0F));
      if (!facesSun(point, sky_)) continue;
      shadow.setOrigin(lane, point.position + kShadowOffset * point.normal);
      to_sun |= 1U << lane;
    }
    return to_sun;
  }

  Vector3f surfaceLight(const SurfacePoint& point, const Vector3f& direction, bool sunlit) const {
    const float length = direction.norm();
    const Look look = lookAt(*point.material, point.spot);
    const Vector3f light = shade(point, look, direction / length, sunlit, sky_);
    return throughAir(light, static_cast<float>(point.distance) * length, sky_);
  }

  const Snapshot& snapshot_;
  const Sky& sky_;
  const RayTable& rays_;
  Eigen::Matrix3f R_;
  Vector3f origin_;
};

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
  const Block block(snapshot, sky, rays, T_world_camera);
  const auto stripes = static_cast<std::size_t>((picture.height + kBlock - 1) / kBlock);
  urban_nav_core::forEach(stripes, 2, [&](std::size_t stripe) {
    for (int u = 0; u < picture.width; u += kBlock) block.render(u, static_cast<int>(stripe) * kBlock, picture);
  });
}

}  // namespace urban_nav_sim
