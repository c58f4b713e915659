// SPDX-License-Identifier: BSD-3-Clause
#include "ray_tracing/tracer.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

/// Data of the filter functions for a part with holes.
struct Tracer::CutOut {
  const std::vector<Facet>* facets;
  std::uint32_t first_facet;
  const Material* material;
  std::uint32_t seed;
  float leaves;
};

namespace {

/// Called by Embree for candidate hits on parts with holes: hits in a hole are rejected.
template <typename CutOut>
void leaveOutHoles(const RTCFilterFunctionNArguments* args) {
  const auto& cut = *static_cast<const CutOut*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const float t = RTCRayN_tfar(args->ray, args->N, i);
    const Eigen::Vector3f origin(RTCRayN_org_x(args->ray, args->N, i), RTCRayN_org_y(args->ray, args->N, i),
                                 RTCRayN_org_z(args->ray, args->N, i));
    const Eigen::Vector3f direction(RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                                    RTCRayN_dir_z(args->ray, args->N, i));
    const Facet& facet = (*cut.facets)[cut.first_facet + RTCHitN_primID(args->hit, args->N, i)];
    if (!isThere(*cut.material, facet.textureAt(origin + t * direction), cut.seed, cut.leaves)) args->valid[i] = 0;
  }
}

void throwOnError(RTCDevice device, const char* what) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw urban_nav_core::UserError("ray tracer", std::string("Embree fails to ") + what,
                                    "a machine with enough memory");
  }
}

}  // namespace

void Release::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void Release::operator()(RTCGeometryTy* geometry) const { rtcReleaseGeometry(geometry); }
void Release::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

Tracer::Tracer(const World& world) : world_(world), device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) throw urban_nav_core::UserError("ray tracer", "Embree does not start", "");
  // If two triangles are at the same distance, the hit depends on the tree, and a tree built by several threads depends
  // on their number.
  const urban_nav_core::ThreadLimit one(1);
  std::size_t triangles = 0;
  for (const Part& part : world.parts) triangles += part.triangles.size();
  for (const Mover& mover : world.movers) {
    for (const Part& part : mover.parts) triangles += part.triangles.size();
  }
  facets_.reserve(triangles);
  still_ = buildGroup(world.parts);
  for (const Mover& mover : world.movers) movers_.push_back(buildGroup(mover.parts));
}

Tracer::~Tracer() = default;

Tracer::Group Tracer::buildGroup(const std::vector<Part>& parts) {
  Group group;
  group.scene.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(group.scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(group.scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  for (const Part& part : parts) {
    if (part.material >= world_.materials.size()) {
      throw urban_nav_core::UserError("world", "a part of a material that is not there", "");
    }
    const Material& material = world_.materials[part.material];
    const auto first = static_cast<std::uint32_t>(facets_.size());
    const std::vector<Facet> facets = makeFacets(part, static_cast<std::uint32_t>(parts_.size()));
    facets_.insert(facets_.end(), facets.begin(), facets.end());
    parts_.push_back({&material, part.seed, material.surface_class});

    const Held<RTCGeometryTy> held(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    const RTCGeometry geometry = held.get();
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Eigen::Vector3f), part.vertices.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(part.triangles[0]), part.triangles.size());
    throwOnError(device_.get(), "take a part of the world");
    if (!part.vertices.empty()) {
      std::memcpy(vertices, part.vertices.data()->data(), part.vertices.size() * sizeof(Eigen::Vector3f));
    }
    if (!part.triangles.empty()) {
      std::memcpy(indices, part.triangles.data(), part.triangles.size() * sizeof(part.triangles[0]));
    }
    if (hasHoles(material)) {
      cut_outs_.push_back(std::make_unique<CutOut>(CutOut{&facets_, first, &material, part.seed, world_.day.leaves}));
      rtcSetGeometryUserData(geometry, cut_outs_.back().get());
      rtcSetGeometryIntersectFilterFunction(geometry, leaveOutHoles<CutOut>);
      rtcSetGeometryOccludedFilterFunction(geometry, leaveOutHoles<CutOut>);
    }
    rtcCommitGeometry(geometry);
    [[maybe_unused]] const unsigned id = rtcAttachGeometry(group.scene.get(), geometry);
    assert(id == group.first_facet.size());
    group.first_facet.push_back(first);
  }
  rtcCommitScene(group.scene.get());
  throwOnError(device_.get(), "build a tree");
  return group;
}

}  // namespace urban_nav_sim
