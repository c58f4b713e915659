// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_core {

/// Motion at a constant twist between two stamps, as stated by a sensor.
struct TwistSpan {
  StampNs from = 0, to = 0;
  Vector6d twist = Vector6d::Zero();  ///< twist of base_link in its axes: m/s, then
                                      ///< rad/s
  /// Variances of the increments of forward, sideways, height, roll, pitch and yaw per second, m^2/s and rad^2/s; 0:
  /// not stated.
  Vector6d density = Vector6d::Zero();
  double seconds() const { return secondsBetween(from, to); }
  void archive(Archive& archive) { archive(from, to, twist, density); }
};

/// Coverage of a time interval by sensor spans.
struct Coverage {
  double measured = 0.0;      ///< s
  double extrapolated = 0.0;  ///< s, after the last span: at its twist
  double bridged = 0.0;       ///< s, in gaps before or between spans: at the twist of a neighbour
  /// Returns whether the coverage is sufficient for a prediction.
  bool suffices() const;
  /// Returns whether the interval was measured throughout.
  bool isComplete() const { return measured > 0.0 && extrapolated + bridged < 0.05 * measured; }
};

/// The newest spans of one motion sensor, in order of time. Not thread-safe.
class TwistStream {
 public:
  /// Appends an input. Inputs that begin before the end of the previous one or are not finite are dropped.
  void add(const MotionInput& input);
  /// Removes the spans that end before a stamp, except for the last one.
  void forget(StampNs before);

  bool isEmpty() const { return spans_.empty(); }
  const TwistSpan& newest() const { return spans_.back(); }
  /// Returns the twist at a stamp: that of the span around it, or of the nearest. Requires a non-empty stream.
  const TwistSpan& at(StampNs stamp) const;
  /// Returns the time for which all numbers have been unchanged, s.
  double repeatedSeconds() const { return repeated_; }
  /// Returns whether the same non-zero motion has been repeated, to all digits, for longer than a working device does.
  bool isStuck() const;
  /// Returns the variance per second of an integrated rotation rate, rad^2/s, from second differences of successive
  /// rates; 0 until enough are available.
  double scatterDensity() const { return scatter_; }
  /// Returns the variance of the change of the twist per second, by component.
  const Vector6d& walk() const { return walk_; }

  /// Calls visit(span, seconds) for pieces that together cover [from, to], in order. Requires a non-empty stream.
  template <typename Visit>
  Coverage cover(StampNs from, StampNs to, const Visit& visit) const;

  void archive(Archive& archive);

 private:
  std::vector<TwistSpan> spans_;  // oldest first
  double repeated_ = 0.0, scatter_ = 0.0;
  Vector6d walk_ = Vector6d::Zero();
};

template <typename Visit>
Coverage TwistStream::cover(StampNs from, StampNs to, const Visit& visit) const {
  Coverage coverage;
  StampNs at = from;
  auto next =
      std::partition_point(spans_.begin(), spans_.end(), [&](const TwistSpan& span) { return span.to <= from; });
  for (; next != spans_.end() && at < to; ++next) {
    if (next->from > at) {  // gap without a span
      const StampNs end = std::min(next->from, to);
      const double bridged = secondsBetween(at, end);
      visit(next == spans_.begin() ? *next : *std::prev(next), bridged);
      coverage.bridged += bridged;
      at = end;
    }
    const StampNs end = std::min(next->to, to);
    if (end <= at) continue;
    const double measured = secondsBetween(at, end);
    visit(*next, measured);
    coverage.measured += measured;
    at = end;
  }
  if (at < to) {
    coverage.extrapolated = secondsBetween(at, to);
    visit(spans_.back(), coverage.extrapolated);
  }
  return coverage;
}

}  // namespace urban_nav_core
