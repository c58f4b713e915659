// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_trust/assessment.hpp"
#include "urban_nav_trust/offset_monitor.hpp"
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

/// All tests of one session, fed with what the stages of a session give, live and offline. Not thread-safe.
class TrustMonitor {
 public:
  explicit TrustMonitor(const Parameters& parameters) : offset_(parameters) {}

  /// Adds the disparity step of a stereo frame (OffsetMonitor::add). Returns whether a constant of the rig
  /// has changed.
  bool addDisparityStep(urban_nav_core::StampNs stamp, double step_px, double sigma_px) {
    return offset_.add(stamp, step_px, sigma_px);
  }
  TestResults results() const;

 private:
  OffsetMonitor offset_;
};

}  // namespace urban_nav_trust
