// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/change_detector.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace urban_nav_core {

namespace {

constexpr double kReference = 0.5;    // half of the smallest change to be detected, in sigmas
constexpr double kOvershoot = 1.166;  // 2 x 0.583, mean excess of a normal random walk over a boundary (Siegmund 1985)

bool isMeasurement(const ConstantMeasurement& measurement) {
  return std::isfinite(measurement.value) && measurement.sigma > 0.0 && std::isfinite(measurement.sigma);
}

}  // namespace

double changeProbability(double statistic, std::int64_t measurements) {
  const double b = 2.0 * kReference * (statistic + kOvershoot);
  const double run_length = (std::expm1(b) - b) / (2.0 * kReference * kReference);
  return -std::expm1(-2.0 * static_cast<double>(measurements) / run_length);
}

ChangeDetector::ChangeDetector(double false_alarm, std::int64_t horizon, std::size_t recent) : most_recent_(recent) {
  assert(false_alarm > 0.0 && false_alarm < 1.0 && horizon > 0 && recent > 1);
  recent_.reserve(recent);
  double low = 0.0, high = 1000.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (changeProbability(middle, horizon) > false_alarm ? low : high) = middle;
  }
  threshold_ = high;
}

void ChangeDetector::Sums::add(const ConstantMeasurement& measurement) {
  if (count++ == 0) interval.from = measurement.interval.from;
  interval.to = measurement.interval.to;
  const double share = 1.0 / (measurement.sigma * measurement.sigma);
  weight += share;
  weighted += share * measurement.value;
}

ChangeDetector::Segment ChangeDetector::Sums::toSegment() const {
  return {interval, count, weighted / weight, 1.0 / std::sqrt(weight)};
}

double ChangeDetector::residual(const ConstantMeasurement& measurement) const {
  if (open_.count == 0) return 0.0;
  const double variance = measurement.sigma * measurement.sigma + 1.0 / open_.weight;
  return (measurement.value - open_.weighted / open_.weight) / std::sqrt(variance);
}

void ChangeDetector::addToSegment(const ConstantMeasurement& measurement) {
  const double w = residual(measurement);
  open_.add(measurement);
  if (recent_.size() < most_recent_) {
    recent_.push_back(measurement);
  } else {
    past_.add(recent_[oldest_]);
    recent_[oldest_] = measurement;
    oldest_ = (oldest_ + 1) % recent_.size();
  }
  rise_ = std::max(0.0, rise_ + w - kReference);
  fall_ = std::max(0.0, fall_ - w - kReference);
}

bool ChangeDetector::wouldAlarm(const ConstantMeasurement& measurement) const {
  if (!isMeasurement(measurement)) return false;
  const double w = residual(measurement);
  return std::max(rise_ + w, fall_ - w) - kReference > threshold_;
}

bool ChangeDetector::add(const ConstantMeasurement& measurement) {
  if (!isMeasurement(measurement)) return false;
  ++count_;
  addToSegment(measurement);
  const double sum = std::max(rise_, fall_);
  largest_ = std::max(largest_, sum);
  if (sum <= threshold_) return false;
  split();
  return true;
}

void ChangeDetector::split() {
  Sums before = past_, best_before = past_;
  std::size_t change = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < recent_.size(); ++i) {
    const double after = open_.weight - before.weight;
    if (before.count > 0 && after > 0.0) {
      const double difference = before.weighted / before.weight - (open_.weighted - before.weighted) / after;
      const double distance = difference * difference / (1.0 / before.weight + 1.0 / after);
      if (distance > largest) {
        largest = distance;
        change = i;
        best_before = before;
      }
    }
    before.add(recent(i));
  }
  if (best_before.count == 0) return;
  closed_.push_back(best_before.toSegment());
  std::vector<ConstantMeasurement> after;
  for (std::size_t i = change; i < recent_.size(); ++i) after.push_back(recent(i));
  past_ = open_ = Sums();
  recent_.clear();
  oldest_ = 0;
  rise_ = fall_ = 0.0;
  for (const ConstantMeasurement& each : after) addToSegment(each);
}

double ChangeDetector::meanSigma() const {
  return open_.count > 0 ? 1.0 / std::sqrt(open_.weight) : std::numeric_limits<double>::infinity();
}

void archive(Archive& archive, ConstantMeasurement& measurement) {
  archive(measurement.interval.from, measurement.interval.to, measurement.value, measurement.sigma);
  archive.require(measurement.sigma > 0.0, "a standard deviation is not positive");
}

void archive(Archive& archive, ChangeDetector::Segment& segment) {
  archive(segment.interval.from, segment.interval.to, segment.measurements, segment.mean, segment.sigma);
}

void ChangeDetector::archive(Archive& archive) {
  archive(largest_, count_, closed_, past_, open_, recent_, oldest_, rise_, fall_);
  archive.require(recent_.size() <= most_recent_ && (oldest_ == 0 || oldest_ < recent_.size()),
                  "recent measurements do not fit");
  recent_.reserve(most_recent_);
}

std::vector<ChangeDetector::Segment> ChangeDetector::segments() const {
  std::vector<Segment> all = closed_;
  if (open_.count > 0) all.push_back(open_.toSegment());
  return all;
}

}  // namespace urban_nav_core
