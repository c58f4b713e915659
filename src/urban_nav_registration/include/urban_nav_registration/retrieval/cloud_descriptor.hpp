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

}  // namespace urban_nav_registration
