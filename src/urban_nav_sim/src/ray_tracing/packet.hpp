// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace urban_nav_sim {

/// Number of rays in a packet; rays of a packet should be coherent.
constexpr int kLanes = 16;

/// Rays in `world`. Lanes whose bit in `active` is not set are ignored.
struct alignas(64) Packet {
  float origin[3][kLanes];     ///< m
  float direction[3][kLanes];  ///< of any length, which is the unit of distances
  float far[kLanes];           ///< no hit at or beyond it
  float time[kLanes];          ///< 0 ... 1 from the start to the end of the Snapshot
  std::uint32_t active = 0;    ///< bit i: lane i

  void setOrigin(int lane, const Eigen::Vector3f& o) {
    for (int i = 0; i < 3; ++i) origin[i][lane] = o[i];
  }
  void setDirection(int lane, const Eigen::Vector3f& d) {
    for (int i = 0; i < 3; ++i) direction[i][lane] = d[i];
  }
  Eigen::Vector3f laneOrigin(int lane) const { return {origin[0][lane], origin[1][lane], origin[2][lane]}; }
  Eigen::Vector3f beamDirection(int lane) const { return {direction[0][lane], direction[1][lane], direction[2][lane]}; }
};

constexpr std::uint32_t kNothing = 0xffffffffU;

/// First hits of a packet.
struct alignas(64) Hits {
  float distance[kLanes];       ///< in lengths of the direction; refined by Snapshot::surfaceAt
  std::uint32_t facet[kLanes];  ///< index of Tracer::facets(), or kNothing
  std::uint32_t mover[kLanes];  ///< index of World::movers, or kNothing for static objects
};

}  // namespace urban_nav_sim
