// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "urban_nav_core/sequence/change_detector.hpp"
#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

constexpr const char* kOffsetTest = "disparity_offset";

/// Tests whether the relative mounting of the stereo cameras is constant.
///
/// Odometry measures, per frame, by how much disparities exceed those predicted from the landmarks of earlier frames
/// (VoStatistics::disparity_step_px). With a constant mounting this is noise about a constant. A rotated or shifted
/// camera displaces all disparities at once, until the landmarks are renewed. Derivation: docs/derivations/trust.md.
/// Not thread-safe.
class OffsetMonitor {
 public:
  explicit OffsetMonitor(const Parameters& parameters);

  /// Adds the step of a frame, in order of time, with its standard deviation (px). A step that is not finite or whose
  /// sigma is not positive is ignored. Returns whether it reveals a change of the mounting.
  bool add(urban_nav_core::StampNs stamp, double step_px, double sigma_px);
  /// Returns the test; nullopt before two frames are compared.
  std::optional<ConsistencyTest> test() const;
  /// Returns the disparity offset relative to the first frame, px: one segment for each mounting. Empty before two
  /// frames are compared.
  std::vector<ConstantSegment> segments() const;

 private:
  struct Change {
    urban_nav_core::StampNs stamp = 0;
    double px = 0.0, sigma_px = 0.0;
  };
  double false_alarm_;
  urban_nav_core::ChangeDetector detector_;
  std::int64_t frames_ = 0;
  double largest_ = 0.0;
  bool any_frame_ = false;
  urban_nav_core::StampNs first_ = 0, last_ = 0, quiet_until_ = 0;
  std::vector<Change> changes_;
};

}  // namespace urban_nav_trust
