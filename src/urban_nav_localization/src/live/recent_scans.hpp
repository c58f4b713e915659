// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"

namespace urban_nav_localization {

/// Scans of the last minute, by laser, for local clouds. Not thread-safe.
class RecentScans {
 public:
  /// Stores a scan. Repeated and late scans are ignored. Scans from before a jump back in time are dropped.
  void add(const std::string& frame, urban_nav_core::Scan scan);
  void setLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser);

  /// Returns the lasers whose pose is known. Valid until the next add().
  std::vector<urban_nav_registration::LaserScans> lasers() const;
  /// Returns the frames of lasers that have scans and no pose.
  std::vector<std::string> unplaced() const;

 private:
  struct Laser {
    std::optional<urban_nav_core::Pose> T_base_laser;
    std::deque<urban_nav_core::Scan> scans;  // in order of time
  };
  std::map<std::string, Laser> lasers_;  // by frame
};

}  // namespace urban_nav_localization
