// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/cloud_candidates.hpp"

#include <utility>

#include "map/map_division.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/retrieval/similar_places.hpp"

namespace urban_nav {

using urban_nav_registration::CloudPlaces;
using urban_nav_registration::PlaceDescription;

namespace {

/// Place of a session at which the surroundings are described.
struct CloudPlace {
  urban_nav_core::PoseRef at;
  std::size_t session = 0;
  double distance = 0.0;  // m
  bool is_known = false;
};

std::vector<CloudPlace> listPlaces(const MapContext& context, const std::vector<std::size_t>& group) {
  std::vector<CloudPlace> places;
  const std::vector<const SessionOdometry*> runs = context.runs();
  for (const std::size_t s : group) {
    if (runs[s]->source != OdometrySource::Laser) continue;
    const bool is_frozen = s < context.is_frozen.size() && context.is_frozen[s];
    const bool is_known = is_frozen || (!context.joins && context.isPrevious(s));
    const urban_nav_core::OdometryChain odometry = odometryChain(*runs[s]);
    double next = 0.0;
    for (const SmoothedFrame& frame : runs[s]->settled) {
      const double distance = odometry.distance(frame.stamp);
      if (distance < next) continue;
      next = distance + CloudPlaces::kSpacing;
      places.push_back({{context.names[s], frame.stamp}, s, distance, is_known});
    }
  }
  return places;
}

void proposeInGroup(const std::vector<CloudPlace>& places, const CandidateMeasurer& measurer,
                    std::vector<urban_nav_core::TopologicalClosure>& proposed) {
  std::vector<std::optional<PlaceDescription>> descriptions(places.size());
  constexpr std::size_t kRun = 16;  // places that share readers of the store
  urban_nav_core::forEach((places.size() + kRun - 1) / kRun, 1, [&](std::size_t run) {
    const SeveralStores stores(measurer.stores);
    const loop_metric::StoredPlaceData data(measurer.sessions, stores.keyframes(), stores.scans());
    for (std::size_t i = run * kRun; i < std::min(places.size(), (run + 1) * kRun); ++i)
      descriptions[i] = urban_nav_registration::describePlace(data.cloud(places[i].at, CloudPlaces::kHalfLength),
                                                              measurer.parameters.registration.voxel_size);
  });
  urban_nav_registration::SimilarPlaceFinder finder;
  std::vector<std::size_t> numbers;  // of the described places
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!descriptions[i]) continue;
    numbers.push_back(i);
    for (const urban_nav_registration::SimilarPlaces& pair :
         finder.add({std::move(*descriptions[i]), places[i].session, places[i].distance, places[i].is_known}))
      proposed.push_back({places[numbers[pair.earlier]].at, places[i].at, pair.similarity});
  }
}

}  // namespace

std::vector<urban_nav_core::TopologicalClosure> proposeByClouds(const MapContext& context,
                                                                const CandidateMeasurer& measurer) {
  std::vector<urban_nav_core::TopologicalClosure> proposed;
  for (const std::vector<std::size_t>& group : sessionsOfGroups(context)) {
    const std::vector<CloudPlace> places = listPlaces(context, group);
    if (places.size() > 1) proposeInGroup(places, measurer, proposed);
  }
  return proposed;
}

}  // namespace urban_nav
