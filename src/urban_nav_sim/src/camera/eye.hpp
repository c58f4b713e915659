// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "camera/ray_table.hpp"
#include "camera/sky.hpp"
#include "ray_tracing/tracer.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim {

/// A packet of rays through a picture: where they go, what they meet, and whether the sun shines there.
class Eye {
 public:
  Eye(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera);

  /// Through (u + du, v + dv): the pixel, and the place in it (px, of its middle).
  void aim(int lane, int u, int v, float du, float dv, Packet& packet) const;

  struct Seen {
    Hits hits;
    std::array<SurfacePoint, kLanes> points;  ///< of the lanes that were asked for and met something
    std::uint32_t sunlit = 0;                 ///< of those; bit i: lane i
    bool met(int lane) const { return hits.facet[lane] != kNothing; }
  };
  void trace(const Packet& packet, Seen& seen) const { snapshot_.closest(packet, seen.hits); }
  /// After trace(), for these lanes. `pixels`: u and v of each.
  void examine(const Packet& packet, const std::array<std::array<int, 2>, kLanes>& pixels, std::uint32_t lanes,
               Seen& seen) const;

  /// Light that comes back along a ray. `sunlit`: share of it.
  Eigen::Vector3f light(const SurfacePoint& point, const Eigen::Vector3f& direction, float sunlit) const;
  Eigen::Vector3f skyLight(const Eigen::Vector3f& direction) const { return sky_.radiance(direction.normalized()); }

 private:
  Eigen::Vector3f inWorld(const Eigen::Vector2f& ideal, float z) const {
    return R_ * Eigen::Vector3f(ideal.x(), ideal.y(), z);
  }

  const Snapshot& snapshot_;
  const Sky& sky_;
  const RayTable& rays_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f origin_;
};

/// The light as the picture's channels have it.
void put(const Eigen::Vector3f& light, int channels, float* radiance);

}  // namespace urban_nav_sim
