// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/retrieval/similar_places.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace urban_nav_registration {

namespace {

constexpr std::size_t kByProfile =
    60;  // places of the most similar profile, whose heights are compared at all headings
constexpr std::size_t kByHeights = 10;   // of these, places whose walls are correlated
constexpr double kLeastOverlap = 0.5;    // of the walls: half of them agree
constexpr double kNearlyAsGood = 0.9;    // of the best overlap: also proposed, if elsewhere
constexpr double kElsewhere = 10.0;      // m of path, between two proposals of one session
constexpr double kSearchedRadius = 4.0;  // m between the two places: more than the spacing of places and a lane

}  // namespace

std::optional<PlaceDescription> describePlace(const urban_nav_core::PointCloud& cloud, double voxel) {
  std::optional<CloudDescriptor> heights = CloudDescriptor::describe(cloud);
  if (!heights) return std::nullopt;
  return PlaceDescription{*heights,
                          extractVerticalStructure(makeSurfels(cloud, static_cast<float>(voxel)), kCoarseResolution)};
}

std::vector<std::size_t> SimilarPlaceFinder::candidates(const DescribedPlace& place) const {
  std::vector<std::pair<double, std::size_t>> ranked;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const bool is_near = places_[i].session == place.session &&
                         std::abs(place.distance - places_[i].distance) < CloudPlaces::kApartOnPath;
    if (!is_near) ranked.emplace_back(place.description.heights.profileDifference(places_[i].description.heights), i);
  }
  const auto keepFirst = [&ranked](std::size_t most) {
    const std::size_t count = std::min(most, ranked.size());
    std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count), ranked.end());
    ranked.resize(count);
  };
  keepFirst(kByProfile);
  for (auto& [difference, i] : ranked)
    difference = -place.description.heights.similarity(places_[i].description.heights);
  keepFirst(kByHeights);
  std::vector<std::size_t> kept;
  for (const auto& each : ranked) kept.push_back(each.second);
  return kept;
}

std::vector<SimilarPlaces> SimilarPlaceFinder::add(DescribedPlace place) {
  const std::size_t later = places_.size();
  std::vector<SimilarPlaces> similar;
  if (!place.is_known)
    for (const std::size_t i : candidates(place)) {
      const std::vector<PoseCandidate> found =
          searchGlobally(place.description.walls, places_[i].description.walls, urban_nav_core::Vector3d::Zero(),
                         kSearchedRadius, kCoarseResolution);
      if (!found.empty() && found.front().score >= kLeastOverlap) similar.push_back({i, later, found.front().score});
    }
  places_.push_back(std::move(place));
  std::stable_sort(similar.begin(), similar.end(),
                   [](const SimilarPlaces& a, const SimilarPlaces& b) { return a.similarity > b.similarity; });
  std::vector<SimilarPlaces> proposed;
  for (const SimilarPlaces& each : similar) {
    if (proposed.size() == 2 || each.similarity < kNearlyAsGood * similar.front().similarity) break;
    const DescribedPlace& earlier = places_[each.earlier];
    const auto isNextTo = [&](const SimilarPlaces& other) {
      const DescribedPlace& there = places_[other.earlier];
      return there.session == earlier.session && std::abs(there.distance - earlier.distance) < kElsewhere;
    };
    if (std::none_of(proposed.begin(), proposed.end(), isNextTo)) proposed.push_back(each);
  }
  return proposed;
}

}  // namespace urban_nav_registration
