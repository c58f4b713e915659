// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core {

/// Finds out from several clouds of one 3D LiDAR how they are read, whatever the names of their fields.
///
/// Times: a sweep takes 10 ms to 1 s, so the span of a field's values has at most one unit; values of at most 1.5 s are
/// relative to the header, larger ones are absolute. Fields with names of other quantities (x, intensity, range) are
/// not considered, and those with unknown names only if their values rise or fall steadily. Rings: a field of
/// whole numbers named ring, channel, line or the like; the rows or columns of an organised cloud if each has its
/// elevation; otherwise elevations. Their numbers are replaced by places in the order of elevation.
///
/// Not thread-safe.
class CloudSurvey {
 public:
  /// Number of clouds with points after which the decision is firm.
  static constexpr std::size_t kEnough = 8;

  explicit CloudSurvey(CloudOptions options = {});
  CloudSurvey(CloudSurvey&&) noexcept;
  CloudSurvey& operator=(CloudSurvey&&) noexcept;
  ~CloudSurvey();

  /// Adds a cloud. One without a point that can be used counts for nothing.
  void add(const CloudView& cloud);
  bool isComplete() const;
  /// Returns the names of the fields of the last cloud with points, as a list for people; empty without one.
  const std::string& fieldNames() const;
  /// Returns how clouds are read. Without a cloud, as points without times.
  CloudConvention conclude() const;

 private:
  struct Findings;
  std::unique_ptr<Findings> findings_;
};

}  // namespace urban_nav_core
