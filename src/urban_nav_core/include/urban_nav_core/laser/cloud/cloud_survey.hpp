// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core {

/// Determines from several clouds of one 3D LiDAR how to read them, independently of field names.
///
/// Times: a sweep takes 10 ms to 1 s, so at most one unit fits the span of a field's values; values of at most 1.5 s
/// are relative to the header, larger ones are absolute. Fields named for other quantities (x, intensity, range) are
/// not considered, and those with unknown names only if their values rise or fall steadily. Rings: an integer field
/// named ring, channel, line or similar; the rows or columns of an organised cloud if each has a distinct elevation;
/// otherwise elevations. Ring numbers are replaced by ranks of elevation.
///
/// Not thread-safe.
class CloudSurvey {
 public:
  /// Number of clouds with points after which the result is final.
  static constexpr std::size_t kEnough = 8;

  explicit CloudSurvey(CloudOptions options = {});
  CloudSurvey(CloudSurvey&&) noexcept;
  CloudSurvey& operator=(CloudSurvey&&) noexcept;
  ~CloudSurvey();

  /// Adds a cloud. Clouds without usable points are not counted.
  void add(const CloudView& cloud);
  bool isComplete() const;
  /// Returns the field names of the last cloud with points, as a list for messages; empty without such a cloud.
  const std::string& fieldNames() const;
  /// Returns the conventions found so far; without a cloud, those of points without times.
  CloudConvention conclude() const;

 private:
  struct Findings;
  std::unique_ptr<Findings> findings_;
};

}  // namespace urban_nav_core
