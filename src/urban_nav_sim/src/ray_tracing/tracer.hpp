// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ray_tracing/facet.hpp"
#include "ray_tracing/packet.hpp"
#include "urban_nav_core/geometry/se3.hpp"

struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;

namespace urban_nav_sim {

/// Releases a reference-counted object of Embree.
struct Release {
  void operator()(RTCDeviceTy* device) const;
  void operator()(RTCGeometryTy* geometry) const;
  void operator()(RTCSceneTy* scene) const;
};
template <typename Thing>
using Held = std::unique_ptr<Thing, Release>;

/// The triangles of a world in trees of Embree: one for static parts and one for each mover. Only the sources of this
/// folder refer to Embree. Immutable once built, so thread-safe; `world` must outlive it.
class Tracer {
 public:
  explicit Tracer(const World& world);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Properties shared by all triangles of a part.
  struct PartAppearance {
    const Material* material;
    std::uint32_t seed;
    SurfaceClass surface_class;
  };

  const World& world() const { return world_; }
  const std::vector<Facet>& facets() const { return facets_; }
  const PartAppearance& partIndex(const Facet& facet) const { return parts_[facet.part]; }

 private:
  friend class Snapshot;
  struct CutOut;
  struct Group {  ///< one tree
    Held<RTCSceneTy> scene;
    std::vector<std::uint32_t> first_facet;  ///< index for each geometry
  };
  Group buildGroup(const std::vector<Part>& parts);

  const World& world_;
  Held<RTCDeviceTy> device_;
  Group still_;
  std::vector<Group> movers_;
  std::vector<Facet> facets_;
  std::vector<PartAppearance> parts_;
  std::vector<std::unique_ptr<CutOut>> cut_outs_;
};

/// Point of a surface hit by a ray.
struct SurfacePoint {
  double distance = 0.0;                               ///< in lengths of the direction, refined in double precision
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< m, in `world`
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();   ///< unit, in `world`, towards the origin of the ray
  Eigen::Vector3f corner = Eigen::Vector3f::Zero();    ///< m, first vertex of its triangle, in the frame of its Part
  MaterialSample spot;                                 ///< argument of lookAt
  const Material* material = nullptr;
  SurfaceClass surface_class = SurfaceClass::Other;
};

/// The world from t_begin to t_end (s of the session), short enough for linear motion of movers. Immutable, so
/// thread-safe; the tracer must outlive it. Results do not depend on the number of threads.
class Snapshot {
 public:
  Snapshot(const Tracer& tracer, double t_begin, double t_end);
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

  const Tracer& tracer() const { return tracer_; }

  /// Finds the first hit of each active lane.
  void closest(const Packet& rays, Hits& hits) const;
  /// Returns bit i set if active lane i has a hit before its `far`.
  std::uint32_t occluded(const Packet& rays) const;

  /// Returns the refined point of a hit other than kNothing. `right` and `down`: change of the direction to the
  /// neighbouring rays.
  SurfacePoint surfaceAt(const Hits& hits, int lane, const Packet& rays, const Eigen::Vector3f& right,
                         const Eigen::Vector3f& down) const;

 private:
  urban_nav_core::Pose moverAt(std::uint32_t mover, float time) const;

  const Tracer& tracer_;
  double t_begin_, t_end_;
  Held<RTCSceneTy> scene_;                           ///< of the movers; null without movers
  std::vector<urban_nav_core::Pose> T_world_mover_;  ///< at t_begin
};

}  // namespace urban_nav_sim
