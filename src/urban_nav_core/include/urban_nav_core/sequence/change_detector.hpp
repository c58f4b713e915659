// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/interval.hpp"

namespace urban_nav_core {

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
/// `recent` measurements ago is dated there. Allocates at construction and for an alarm only. Not thread-safe.
class ChangeDetector {
 public:
  static constexpr std::size_t kRecent = 2048;
  /// `false_alarm`: probability, in (0, 1), of an alarm within `horizon` measurements of an unchanged constant.
  ChangeDetector(double false_alarm, std::int64_t horizon, std::size_t recent = kRecent);

  /// Adds a measurement. Values that are not finite and sigmas that are not positive are ignored. Returns whether it
  /// raises an alarm.
  bool add(const ConstantMeasurement& measurement);
  /// Returns what add() would, and changes nothing.
  bool wouldAlarm(const ConstantMeasurement& measurement) const;

  /// Interval in which the constant did not change.
  struct Segment {
    Interval interval;
    std::int64_t measurements = 0;
    double mean = 0.0, sigma = 0.0;
  };
  /// Returns the segments so far, in order of time; the last one is open. Empty without measurements.
  std::vector<Segment> segments() const;
  std::int64_t measurements() const { return count_; }
  /// Returns the weighted mean of the open segment and its standard deviation; 0 and infinity without a measurement.
  double mean() const { return open_.count > 0 ? open_.weighted / open_.weight : 0.0; }
  double meanSigma() const;
  /// Returns the largest sum so far, in standard deviations.
  double statistic() const { return largest_; }
  double threshold() const { return threshold_; }
  void archive(Archive& archive);

 private:
  /// Sums over measurements.
  struct Sums {
    Interval interval;
    std::int64_t count = 0;
    double weight = 0.0, weighted = 0.0;  ///< sums of 1 / sigma^2 and of value / sigma^2
    void add(const ConstantMeasurement& measurement);
    Segment toSegment() const;
    void archive(Archive& archive) { archive(interval.from, interval.to, count, weight, weighted); }
  };
  /// Returns the i-th oldest of the recent measurements.
  const ConstantMeasurement& recent(std::size_t i) const { return recent_[(oldest_ + i) % recent_.size()]; }
  /// Returns the recursive residual w of the open segment; 0 for its first measurement.
  double residual(const ConstantMeasurement& measurement) const;
  void addToSegment(const ConstantMeasurement& measurement);
  /// Ends the open segment at its most likely change.
  void split();

  double threshold_, largest_ = 0.0;
  std::int64_t count_ = 0;
  std::vector<Segment> closed_;
  Sums past_, open_;                         // open segment: before its recent measurements, and all of it
  std::size_t most_recent_, oldest_ = 0;     // capacity; index of the oldest recent measurement
  std::vector<ConstantMeasurement> recent_;  // ring
  double rise_ = 0.0, fall_ = 0.0;
};

void archive(Archive& archive, ConstantMeasurement& measurement);
void archive(Archive& archive, ChangeDetector::Segment& segment);

/// Returns the probability that the larger of both sums exceeds `statistic` within n = `measurements` measurements of
/// an unchanged constant: 1 - exp(-n r), with 1 / r the mean number of measurements to an alarm by Siegmund's
/// approximation (Sequential Analysis, 1985, equation 2.56), halved for two sides.
double changeProbability(double statistic, std::int64_t measurements);

}  // namespace urban_nav_core
