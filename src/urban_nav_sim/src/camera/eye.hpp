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

/// A packet of rays through a picture: directions, hits, and visibility of sun and lamps.
class Eye {
 public:
  Eye(const Snapshot& snapshot, const Sky& sky, const RayTable& rays, const urban_nav_core::Pose& T_world_camera);

  /// Sets a ray through (u + du, v + dv): pixel, and offset from its centre, px.
  void aim(int lane, int u, int v, float du, float dv, Packet& packet) const;

  struct Seen {
    Hits hits;
    std::array<SurfacePoint, kLanes> points;     ///< of the requested lanes with a hit
    std::uint32_t sunlit = 0;                    ///< of these; bit i: lane i
    std::array<Eigen::Vector3f, kLanes> lamps;   ///< of these, at night: radiance of a white surface by lamps
    std::array<std::uint8_t, kLanes> shadows{};  ///< of these: differs where another light is hidden
    bool met(int lane) const { return hits.facet[lane] != kNothing; }
  };
  void trace(const Packet& packet, Seen& seen) const { snapshot_.closest(packet, seen.hits); }
  /// Evaluates these lanes, after trace(). `pixels`: u and v of each.
  void examine(const Packet& packet, const std::array<std::array<int, 2>, kLanes>& pixels, std::uint32_t lanes,
               Seen& seen) const;

  /// Returns the light along the ray of lane `first` with the mean illumination of `lanes`, all of them examined.
  Eigen::Vector3f light(const Packet& packet, const Seen& seen, int first, std::uint32_t lanes) const;
  Eigen::Vector3f skyLight(const Eigen::Vector3f& direction) const { return sky_.radiance(direction.normalized()); }

 private:
  void askLamps(std::uint32_t lanes, Seen& seen) const;
  Eigen::Vector3f inWorld(const Eigen::Vector2f& ideal, float z) const {
    return R_ * Eigen::Vector3f(ideal.x(), ideal.y(), z);
  }

  const Snapshot& snapshot_;
  const Sky& sky_;
  const RayTable& rays_;
  Eigen::Matrix3f R_;
  Eigen::Vector3f origin_;
};

/// Writes the light to the channels of the picture.
void put(const Eigen::Vector3f& light, int channels, float* radiance);

}  // namespace urban_nav_sim
