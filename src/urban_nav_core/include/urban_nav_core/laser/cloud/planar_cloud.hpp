// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_view.hpp"
#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_core {

/// Layout of the clouds of a planar laser whose driver publishes points instead of ranges.
struct PlanarPattern {
  double angle_step = 0.0;    ///< rad from beam to beam, positive
  bool is_clockwise = false;  ///< beams are in order of decreasing angle
  std::string time_field;     ///< field with the times of points, relative to the header; empty: no times
  double time_scale = 1.0;    ///< s per unit of it
};

/// Detects clouds of a planar laser: all points lie in the x-y plane of their frame, at angles that are multiples of
/// one step apart. Not thread-safe.
class PlanarCloudSurvey {
 public:
  static constexpr std::size_t kEnough = 8;  ///< clouds with points

  /// Adds a cloud. Clouds with too few points are not counted.
  void add(const CloudView& cloud);
  bool isComplete() const { return clouds_ >= kEnough || is_spatial_; }
  /// Returns the layout of the clouds; nullopt if one is not planar, or none was added.
  std::optional<PlanarPattern> conclude() const;

 private:
  std::size_t clouds_ = 0, clockwise_ = 0;
  bool is_spatial_ = false;
  std::vector<double> steps_;  // rad, of each cloud
  std::string time_field_;
  std::vector<double> time_spans_;  // one for each cloud, in units of the field
};

/// Returns the scan of a cloud; nullopt without a usable point. A direction without a point has range 0, which is not
/// valid; of several points in one direction the first is used. Range limits are those of any laser. `period` is 0
/// (unknown).
std::optional<PlanarScan> toPlanarScan(const CloudView& cloud, const PlanarPattern& pattern);

}  // namespace urban_nav_core
