// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/cloud_candidates.hpp"

#include "map/map_division.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/retrieval/cloud_descriptor.hpp"

namespace urban_nav {

using urban_nav_registration::CloudDescriptor;
using urban_nav_registration::DescribedPlace;

namespace {

constexpr double kSpacing = 3.0;           // m of path between places: half the width of a street lane and more
constexpr double kHalfLength = 2.0;        // m of path before and after a place, whose sweeps describe it
constexpr double kApartOnPath = 20.0;      // m of path between two places of a session that may be one
constexpr double kLeastSimilarity = 0.65;  // the transform decides; below it hardly any can be measured

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
      next = distance + kSpacing;
      places.push_back({{context.names[s], frame.stamp}, s, distance, is_known});
    }
  }
  return places;
}

void proposeInGroup(const std::vector<CloudPlace>& places, const CandidateMeasurer& measurer,
                    std::vector<urban_nav_core::TopologicalClosure>& proposed) {
  std::vector<std::optional<CloudDescriptor>> descriptors(places.size());
  constexpr std::size_t kRun = 16;  // places that share readers of the store
  urban_nav_core::forEach((places.size() + kRun - 1) / kRun, 1, [&](std::size_t run) {
    const SeveralStores stores(measurer.stores);
    const loop_metric::StoredPlaceData data(measurer.sessions, stores.keyframes(), stores.scans());
    for (std::size_t i = run * kRun; i < std::min(places.size(), (run + 1) * kRun); ++i)
      descriptors[i] = CloudDescriptor::describe(data.cloud(places[i].at, kHalfLength));
  });
  std::vector<DescribedPlace> described;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!descriptors[i]) continue;
    described.push_back({*descriptors[i], places[i].session, places[i].distance, places[i].is_known});
    numbers.push_back(i);
  }
  for (const urban_nav_registration::SimilarPlaces& pair :
       urban_nav_registration::findSimilarPlaces(described, kLeastSimilarity, kApartOnPath))
    proposed.push_back({places[numbers[pair.earlier]].at, places[numbers[pair.later]].at, pair.similarity});
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
