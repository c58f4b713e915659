// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/sequence/change_detector.hpp"
#include "urban_nav_core/types/frame_measurements.hpp"
#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

constexpr const char* kOffsetTest = "disparity_offset";
/// Time after a change until all landmarks were created with the new mounting, ns.
constexpr urban_nav_core::StampNs kLandmarkRenewal = 3'000'000'000;

/// Tests whether the relative mounting of the stereo cameras is constant.
///
/// Odometry measures, per frame, by how much disparities exceed those predicted from the landmarks of earlier frames
/// (VoStatistics::disparity_step_px). With a constant mounting this is noise about a constant. A rotated or shifted
/// camera displaces all disparities at once, until the landmarks are renewed. Odometry may have measured its rotation
/// (FrameMeasurements::right_turn): then the test fails, but is_corrected if it did so for each change.
/// Derivation: docs/derivations/trust.md. Not thread-safe.
class OffsetMonitor {
 public:
  explicit OffsetMonitor(const Parameters& parameters);

  /// Adds a frame, in order of time. A step that is not finite or whose sigma is not positive is ignored. Returns
  /// whether the frame reveals a change of the mounting.
  bool add(const urban_nav_core::FrameMeasurements& frame);
  /// Returns the test; nullopt before two frames are compared.
  std::optional<ConsistencyTest> test() const;
  /// Returns the disparity offset relative to the first frame, px: one segment for each mounting. Empty before two
  /// frames are compared.
  std::vector<ConstantSegment> segments() const;

 private:
  /// Change of the mounting between two frames.
  struct Change {
    urban_nav_core::StampNs stamp = 0;  ///< of the last frame before it
    double px = 0.0, sigma_px = 0.0;
    bool is_corrected = false;
    urban_nav_core::StampNs corrected_at = 0;        ///< first frame with corrected images
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rotation vector by which odometry's correction grew, rad
  };
  bool addStep(const Interval& interval, double step_px, double sigma_px);
  bool addTurn(const Interval& interval, const urban_nav_core::FrameMeasurements& frame);
  void append(const Change& change, urban_nav_core::StampNs now);
  std::string describe(const Change& change) const;
  bool allCorrected() const;
  double false_alarm_;
  urban_nav_core::ChangeDetector detector_;
  std::int64_t frames_ = 0;
  double largest_ = 0.0;
  bool any_frame_ = false;
  urban_nav_core::StampNs first_ = 0, last_ = 0, quiet_until_ = 0;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();  // of the last frame
  std::vector<Change> changes_;
};

}  // namespace urban_nav_trust
