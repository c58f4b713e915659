// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/frame_measurements.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_trust/motion_monitor.hpp"
#include "urban_nav_trust/offset_monitor.hpp"
#include "urban_nav_trust/parameters.hpp"
#include "urban_nav_trust/reprojection_monitor.hpp"
#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

/// Tests of one session, computed from the outputs of its stages, live and offline. Not thread-safe.
class TrustMonitor {
 public:
  explicit TrustMonitor(const Parameters& parameters)
      : offset_(parameters), reprojection_(parameters), motion_(parameters) {}

  /// Adds a stereo frame, in order of time. Returns whether it reveals a change of the rig.
  bool add(const urban_nav_core::FrameMeasurements& frame);
  /// Adds a final step of odometry, in order of time, before the frame received with it.
  void add(const urban_nav_core::RelativePose& step) { motion_.add(step); }
  TestResults results() const;

 private:
  OffsetMonitor offset_;
  ReprojectionMonitor reprojection_;
  MotionMonitor motion_;
};

}  // namespace urban_nav_trust
