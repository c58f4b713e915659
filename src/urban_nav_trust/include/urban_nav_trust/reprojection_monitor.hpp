// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "urban_nav_core/types/frame_measurements.hpp"
#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

constexpr const char* kReprojectionTest = "reprojection_error";

/// Tests whether the images of a camera keep fitting the map of landmarks: the reprojection error of each second
/// against that of all seconds before it, by a one-sided cumulative sum. A camera that vibrates, lost its focus or
/// changed its focal length, water on a lens, or a turn that odometry could not correct raises it for good.
/// Compared is the logarithm of the error, whose scatter from scene to scene is unknown: estimated from the session,
/// with a prior. Derivation: docs/derivations/trust.md. Not thread-safe.
class ReprojectionMonitor {
 public:
  explicit ReprojectionMonitor(const Parameters& parameters);

  /// Adds a frame, in order of time. An error that is not finite or not positive is ignored. Returns whether the frame
  /// reveals a rise.
  bool add(const urban_nav_core::FrameMeasurements& frame);
  /// Returns the test; nullopt before two seconds are compared.
  std::optional<ConsistencyTest> test() const;

 private:
  /// Sums over the frames of one second.
  struct Window {
    Interval interval;
    int frames = 0;
    double squares = 0.0;  ///< px^2
  };
  /// Part of the session since the sum last left zero.
  struct Excursion {
    Interval interval;
    double sum = 0.0;      ///< cumulative sum
    double before = 0.0;   ///< mean of the logarithms at its beginning
    double logs = 0.0;     ///< sum of the logarithms
    double squares = 0.0;  ///< sum of the squared residuals, which are not part of the scatter yet
    std::int64_t windows = 0;
  };
  bool closeWindow();
  bool addLogarithm(const Interval& interval, double value);

  double false_alarm_, threshold_;
  Window window_;
  std::int64_t windows_ = 0, scattered_ = 0;  // all seconds; those in squares_
  double mean_ = 0.0, squares_ = 0.0;
  Excursion excursion_;
  Excursion largest_;  // at its largest sum
  bool has_failed_ = false;
  bool any_window_ = false;
  urban_nav_core::StampNs first_ = 0, last_ = 0;
};

}  // namespace urban_nav_trust
