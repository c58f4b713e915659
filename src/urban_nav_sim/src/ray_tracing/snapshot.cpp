// SPDX-License-Identifier: BSD-3-Clause
#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {
namespace {

using RayHits = RTCRayHit16;
static_assert(kLanes == 16, "the calls below are those for sixteen rays");

/// Embree 3.13 does not terminate on some coherent packets with few active lanes: only full packets are flagged
/// coherent.
RTCIntersectContext makeContext(std::uint32_t active) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (active == (1U << kLanes) - 1U) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void fillMask(std::uint32_t active, int (&valid)[kLanes]) {
  for (int i = 0; i < kLanes; ++i) valid[i] = (active >> i & 1U) != 0 ? -1 : 0;
}

void fillRays(const Packet& packet, RTCRay16& rays) {
  std::copy_n(packet.origin[0], kLanes, rays.org_x);
  std::copy_n(packet.origin[1], kLanes, rays.org_y);
  std::copy_n(packet.origin[2], kLanes, rays.org_z);
  std::copy_n(packet.direction[0], kLanes, rays.dir_x);
  std::copy_n(packet.direction[1], kLanes, rays.dir_y);
  std::copy_n(packet.direction[2], kLanes, rays.dir_z);
  std::copy_n(packet.far, kLanes, rays.tfar);
  std::copy_n(packet.time, kLanes, rays.time);
  std::fill_n(rays.tnear, kLanes, 0.0F);
  std::fill_n(rays.mask, kLanes, ~0U);
  std::fill_n(rays.flags, kLanes, 0U);
}

void setTransform(RTCGeometry instance, unsigned step, const urban_nav_core::Pose& T) {
  const Eigen::Matrix<float, 3, 4> matrix = T.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(instance, step, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix.data());
}

/// Returns the final pose of a mover for Embree, which interpolates the matrices of both ends; those of a walker that
/// turns on the spot would cancel, so its rotation is kept.
urban_nav_core::Pose shortestTurnEnd(const urban_nav_core::Pose& begin, const urban_nav_core::Pose& end) {
  constexpr double kAbout = 1.0;  // rad: a car in a bend rotates by a hundredth of it
  return angleBetween(begin, end) > kAbout ? urban_nav_core::Pose(begin.q(), end.t()) : end;
}

}  // namespace

Snapshot::Snapshot(const Tracer& tracer, double t_begin, double t_end)
    : tracer_(tracer), t_begin_(t_begin), t_end_(t_end) {
  const auto& movers = tracer.world_.movers;
  if (movers.empty()) return;
  const bool lasts = t_end > t_begin;
  scene_.reset(rtcNewScene(tracer.device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    T_world_mover_.push_back(movers[i].T_world_mover(t_begin));
    const Held<RTCGeometryTy> held(rtcNewGeometry(tracer.device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    const RTCGeometry instance = held.get();
    rtcSetGeometryInstancedScene(instance, tracer.movers_[i].scene.get());
    rtcSetGeometryTimeStepCount(instance, lasts ? 2 : 1);
    setTransform(instance, 0, T_world_mover_.back());
    if (lasts) setTransform(instance, 1, shortestTurnEnd(T_world_mover_.back(), movers[i].T_world_mover(t_end)));
    rtcCommitGeometry(instance);
    rtcAttachGeometry(scene_.get(), instance);
  }
  rtcCommitScene(scene_.get());
}

void Snapshot::closest(const Packet& rays, Hits& hits) const {
  alignas(64) int valid[kLanes];
  alignas(64) RayHits query;
  fillMask(rays.active, valid);
  fillRays(rays, query.ray);
  std::fill_n(query.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query.hit.instID[0], kLanes, RTC_INVALID_GEOMETRY_ID);
  RTCIntersectContext context = makeContext(rays.active);
  rtcIntersect16(valid, tracer_.still_.scene.get(), &context, &query);
  for (int i = 0; i < kLanes; ++i) {
    const bool hit = valid[i] != 0 && query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    hits.facet[i] = hit ? tracer_.still_.first_facet[query.hit.geomID[i]] + query.hit.primID[i] : kNothing;
    hits.mover[i] = kNothing;
  }
  if (scene_ != nullptr) {
    context = makeContext(rays.active);
    rtcIntersect16(valid, scene_.get(), &context, &query);
    for (int i = 0; i < kLanes; ++i) {
      const std::uint32_t mover = query.hit.instID[0][i];
      if (valid[i] == 0 || mover == RTC_INVALID_GEOMETRY_ID) continue;
      hits.mover[i] = mover;
      hits.facet[i] = tracer_.movers_[mover].first_facet[query.hit.geomID[i]] + query.hit.primID[i];
    }
  }
  std::copy_n(query.ray.tfar, kLanes, hits.distance);
}

std::uint32_t Snapshot::occluded(const Packet& rays) const {
  alignas(64) int valid[kLanes];
  alignas(64) RTCRay16 query;
  fillMask(rays.active, valid);
  fillRays(rays, query);
  RTCIntersectContext context = makeContext(0);
  rtcOccluded16(valid, tracer_.still_.scene.get(), &context, &query);
  std::uint32_t met = 0;
  // Embree marks an occluded ray by a `far` of minus infinity.
  const auto collect = [&] {
    for (int i = 0; i < kLanes; ++i) {
      if (valid[i] != 0 && query.tfar[i] < 0.0F) {
        met |= 1U << i;
        valid[i] = 0;
      }
    }
  };
  collect();
  if (scene_ != nullptr && met != rays.active) {
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid, scene_.get(), &context, &query);
    collect();
  }
  return met;
}

urban_nav_core::Pose Snapshot::moverAt(std::uint32_t mover, float time) const {
  if (t_begin_ == t_end_) return T_world_mover_[mover];
  return tracer_.world_.movers[mover].T_world_mover(t_begin_ + static_cast<double>(time) * (t_end_ - t_begin_));
}

SurfacePoint Snapshot::surfaceAt(const Hits& hits, int lane, const Packet& rays, const Eigen::Vector3f& right,
                                 const Eigen::Vector3f& down) const {
  const Facet& facet = tracer_.facets_[hits.facet[lane]];
  const bool moves = hits.mover[lane] != kNothing;
  const urban_nav_core::Pose T_world_mover =
      moves ? moverAt(hits.mover[lane], rays.time[lane]) : urban_nav_core::Pose();
  const Eigen::Matrix3f R_mover_world =
      moves ? Eigen::Matrix3f(T_world_mover.R().transpose().cast<float>()) : Eigen::Matrix3f::Identity();

  // In the frame of the part; plane in double precision, since the distance of Embree is accurate to 1e-7 of the
  // coordinates.
  Eigen::Vector3d origin = rays.laneOrigin(lane).cast<double>();
  Eigen::Vector3d direction = rays.beamDirection(lane).cast<double>();
  if (moves) {
    origin = T_world_mover.inverse() * origin;
    direction = T_world_mover.q().conjugate() * direction;
  }
  const Eigen::Vector3d normal = facet.normal.cast<double>();
  const double along = normal.dot(direction);
  const auto traced = static_cast<double>(hits.distance[lane]);
  double distance = normal.dot(facet.corner.cast<double>() - origin) / along;
  // At grazing incidence the plane is not informative.
  if (!(std::abs(distance - traced) < 1e-3 * (1.0 + traced))) distance = traced;

  SurfacePoint point;
  point.distance = distance;
  point.corner = facet.corner;
  const Tracer::PartAppearance& part = tracer_.partIndex(facet);
  point.material = part.material;
  point.surface_class = part.surface_class;
  const Eigen::Vector3f place = (origin + distance * direction).cast<float>();
  point.spot.at = facet.textureAt(place);
  point.spot.seed = part.seed;
  point.spot.wet = tracer_.world_.day.wet;
  // Intersections of the neighbouring rays with the same plane, to first order (Igehy 1999, eq. 10-12).
  const double safe_along = std::copysign(std::max(std::abs(along), 1e-6), along);
  const auto step = [&](const Eigen::Vector3f& change) {
    const Eigen::Vector3f local = moves ? Eigen::Vector3f(R_mover_world * change) : change;
    const auto stretch = static_cast<float>(normal.dot(local.cast<double>()) / safe_along);
    const Eigen::Vector3f moved = static_cast<float>(distance) * (local - direction.cast<float>() * stretch);
    return Eigen::Vector2f(facet.per_s.dot(moved), facet.per_t.dot(moved));
  };
  point.spot.per_u = step(right);
  point.spot.per_v = step(down);

  const Eigen::Vector3f outwards = along > 0.0 ? Eigen::Vector3f(-facet.normal) : facet.normal;
  if (moves) {
    point.normal = R_mover_world.transpose() * outwards;
    point.position = (T_world_mover * place.cast<double>()).cast<float>();
  } else {
    point.normal = outwards;
    point.position = place;
  }
  return point;
}

}  // namespace urban_nav_sim
