// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_registration {

/// Surroundings of a place as seen by lasers: the height of the highest return in bins of distance and direction (Scan
/// Context: Kim and Kim, IROS 2018). Comparable for any two headings.
class CloudDescriptor {
 public:
  static constexpr std::size_t kDistances = 20, kDirections = 60;
  static constexpr double kReach = 40.0;  ///< m

  /// Describes a cloud around the origin with z upwards, m, such as localCloud(). nullopt if fewer than a tenth of the
  /// directions have returns in five bins.
  static std::optional<CloudDescriptor> describe(const urban_nav_core::PointCloud& cloud);

  /// Returns the similarity at the heading where it is largest, 0...1: the mean cosine of the heights in a direction.
  double similarity(const CloudDescriptor& other) const;
  /// Returns the mean difference of the heights by distance, m, which does not depend on the heading.
  double profileDifference(const CloudDescriptor& other) const;

 private:
  using Column = std::array<float, kDistances>;  // m above the ground
  std::array<Column, kDirections> columns_{};    // of unit length
  std::array<bool, kDirections> is_seen_{};
  Column profile_{};  // mean over the directions, m
};

/// Descriptor of one of several places, in the order of their times.
struct DescribedPlace {
  CloudDescriptor descriptor;
  std::size_t session = 0;
  double distance = 0.0;  ///< travelled in the session, m
  bool is_known = false;  ///< found by later places, but not compared with earlier ones
};

/// A place and the most similar earlier one.
struct SimilarPlaces {
  std::size_t earlier = 0, later = 0;  ///< indices
  double similarity = 0.0;
};

/// Returns, for each place that is not known, the most similar of those before it, unless it is below `least` or within
/// `apart` (m) of path in the same session.
std::vector<SimilarPlaces> findSimilarPlaces(const std::vector<DescribedPlace>& places, double least, double apart);

}  // namespace urban_nav_registration
