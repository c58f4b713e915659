// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"

namespace urban_nav_core {

/// Returns the angle between the x-y planes of a laser and of base_link, 0 ... pi / 2 rad; 0 also for an inverted one.
double tiltOfLaser(const Pose& T_base_laser);

/// Returns whether a planar laser is horizontal: its plane is within 10 deg of the x-y plane of base_link, so that its
/// scans measure the planar motion of the robot.
bool isHorizontal(const Pose& T_base_laser);

/// Converts the scans of a planar laser to sweeps. Not thread-safe.
class PlanarSweepReader {
 public:
  /// Returns the sweep of a scan. With times of beams its reference is the middle of the scan. Without (a time_step of
  /// zero, or of more than a second in a scan) it is the stamp of the scan, and the duration is the period of the
  /// laser, else the time since the previous scan.
  Sweep read(const PlanarScan& scan);
  void archive(Archive& archive) { archive(last_); }

 private:
  StampNs last_ = 0;  // stamp of the previous scan; 0: none
};

}  // namespace urban_nav_core
