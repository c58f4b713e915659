// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "urban_nav_trust/consistency_test.hpp"

namespace urban_nav_trust {

/// Unbiased, normally distributed, independent measurement of a constant.
struct ConstantMeasurement {
  Interval interval;
  double value = 0.0, sigma = 1.0;  ///< sigma > 0
};

/// Detects changes of a constant from measurements in order of time, by the two-sided cumulative sum (Page 1954) of
/// their recursive residuals (Brown, Durbin and Evans 1975):
///   w_k = (y_k - m) / sqrt(sigma_k^2 + s^2),  S+ = max(0, S+ + w_k - 1/2),  S- = max(0, S- - w_k - 1/2),
/// with m and s the weighted mean of the segment so far and its standard deviation. While the constant does not change,
/// the w_k are independent and standard normal for any value of the constant and any sigmas.
///
/// An alarm ends a segment where the means before and after differ by the most standard deviations, the maximum
/// likelihood time of a single change (Hinkley 1970). A new segment with its own prior begins there. A change more than
/// kRecent measurements ago is dated there. Memory is bounded. Not thread-safe.
class ChangeDetector {
 public:
  static constexpr std::size_t kRecent = 2048;
  /// `false_alarm`: probability, in (0, 1), of an alarm within `horizon` measurements of an unchanged constant.
  ChangeDetector(double false_alarm, std::int64_t horizon);

  /// Adds a measurement. Values that are not finite and sigmas that are not positive are ignored. Returns whether it
  /// raises an alarm.
  bool add(const ConstantMeasurement& measurement);

  /// Interval in which the constant did not change.
  struct Segment {
    Interval interval;
    std::int64_t measurements = 0;
    double mean = 0.0, sigma = 0.0;
  };
  /// Returns the segments so far, in order of time; the last one is open. Empty without measurements.
  std::vector<Segment> segments() const;
  std::int64_t measurements() const { return count_; }
  /// Returns the largest sum so far, in standard deviations.
  double statistic() const { return largest_; }
  double threshold() const { return threshold_; }

 private:
  /// Sums over measurements.
  struct Sums {
    Interval interval;
    std::int64_t count = 0;
    double weight = 0.0, weighted = 0.0;  ///< sums of 1 / sigma^2 and of value / sigma^2
    void add(const ConstantMeasurement& measurement);
    Segment toSegment() const;
  };
  void addToSegment(const ConstantMeasurement& measurement);
  /// Ends the open segment at its most likely change.
  void split();

  double threshold_, largest_ = 0.0;
  std::int64_t count_ = 0;
  std::vector<Segment> closed_;
  Sums past_, open_;                        // open segment: before its recent measurements, and all of it
  std::deque<ConstantMeasurement> recent_;  // at most kRecent
  double rise_ = 0.0, fall_ = 0.0;
};

/// Returns the probability that the larger of both sums exceeds `statistic` within n = `measurements` measurements of
/// an unchanged constant: 1 - exp(-n r), with 1 / r the mean number of measurements to an alarm by Siegmund's
/// approximation (Sequential Analysis, 1985, equation 2.56), halved for two sides.
double changeProbability(double statistic, std::int64_t measurements);

}  // namespace urban_nav_trust
