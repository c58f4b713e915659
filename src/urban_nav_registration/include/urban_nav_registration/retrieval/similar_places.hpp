// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_registration/global/search.hpp"
#include "urban_nav_registration/retrieval/cloud_descriptor.hpp"

namespace urban_nav_registration {

/// How places are described by local clouds and proposed as closures.
struct CloudPlaces {
  static constexpr double kSpacing = 3.0;       ///< m of path between places: half the width of a lane and more
  static constexpr double kHalfLength = 2.0;    ///< m of path before and after a place, whose sweeps describe it
  static constexpr double kApartOnPath = 20.0;  ///< m of path between two places of a session that may be one
};

/// Two descriptions of one cloud: the heights around it, which are compared with all places at once, and the walls seen
/// from above, which are correlated with those of the most similar places.
struct PlaceDescription {
  CloudDescriptor heights;
  VerticalStructure walls;
};
/// Describes a local cloud in base_link, m. `voxel`: edge of the cells of its surfels, m. nullopt if it shows too
/// little (CloudDescriptor::describe). Thread-safe.
std::optional<PlaceDescription> describePlace(const urban_nav_core::PointCloud& cloud, double voxel);

/// One of several places, in the order of their times.
struct DescribedPlace {
  PlaceDescription description;
  std::size_t session = 0;
  double distance = 0.0;  ///< travelled in the session, m
  bool is_known = false;  ///< found by later places, but not compared with earlier ones
};

/// A place and a similar earlier one.
struct SimilarPlaces {
  std::size_t earlier = 0, later = 0;  ///< indices
  double similarity = 0.0;             ///< 0...1, overlap of the walls
};

/// Finds the earlier places that are similar to a new one, at any heading. Not thread-safe. Deterministic.
class SimilarPlaceFinder {
 public:
  /// Adds a place, whose index is the number of places before it. Returns the most similar of these, and a second one
  /// elsewhere that is nearly as similar; none if no place is similar enough, or if the place is known.
  std::vector<SimilarPlaces> add(DescribedPlace place);

 private:
  std::vector<std::size_t> candidates(const DescribedPlace& place) const;

  std::vector<DescribedPlace> places_;
};

}  // namespace urban_nav_registration
