// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Measures the ground near the robot from a planar laser, to check its ranges and mounting against the ground plane of
/// stereo. A laser without downward beams has none. Not thread-safe.
class LaserGround {
 public:
  /// Adds every fifth scan; `T_base_laser`: mounting of the laser.
  void add(const urban_nav_core::PlanarScan& scan, const urban_nav_core::Pose& T_base_laser);
  /// Returns the height of the ground in base_link, m; nullopt if the low returns are not at one height.
  std::optional<double> height() const;
  /// Returns whether its height agrees with that of the ground by stereo (m, in base_link).
  bool agreesWith(double by_stereo) const;
  /// Returns a finding if the ground contradicts that of stereo. `stereo`: heights of the ground below base_link, m;
  /// few or scattered ones give no finding. `range_scale`: of the convention by which the scans were read.
  std::optional<Finding> finding(const std::string& role, const std::string& topic, const std::vector<double>& stereo,
                                 double range_scale = 1.0) const;
  void archive(urban_nav_core::Archive& archive) { archive(scans_, returns_, laser_height_, heights_); }

 private:
  std::int64_t scans_ = 0, returns_ = 0;  // returns that are near and below the laser
  double laser_height_ = 0.0;             // m, in base_link
  std::vector<std::int64_t> heights_;     // numbers of returns by height in base_link
};

/// Returns whether two lasers are exchanged: the ground of neither agrees with stereo for its mounting (`own`), and
/// that of each agrees for the mounting of the other one (`other`).
bool areExchanged(const std::array<LaserGround, 2>& own, const std::array<LaserGround, 2>& other,
                  const std::vector<double>& stereo);

}  // namespace urban_nav_input
