// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/change_detector.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace urban_nav_trust {

namespace {

constexpr double kReference = 0.5;    // half of the smallest change to be detected, in sigmas
constexpr double kOvershoot = 1.166;  // 2 x 0.583, mean excess of a normal random walk over a boundary (Siegmund 1985)

}  // namespace

double changeProbability(double statistic, std::int64_t measurements) {
  const double b = 2.0 * kReference * (statistic + kOvershoot);
  const double run_length = (std::expm1(b) - b) / (2.0 * kReference * kReference);
  return -std::expm1(-2.0 * static_cast<double>(measurements) / run_length);
}

ChangeDetector::ChangeDetector(double false_alarm, std::int64_t horizon) {
  assert(false_alarm > 0.0 && false_alarm < 1.0 && horizon > 0);
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

void ChangeDetector::addToSegment(const ConstantMeasurement& measurement) {
  double residual = 0.0;
  if (open_.count > 0) {
    const double variance = measurement.sigma * measurement.sigma + 1.0 / open_.weight;
    residual = (measurement.value - open_.weighted / open_.weight) / std::sqrt(variance);
  }
  open_.add(measurement);
  recent_.push_back(measurement);
  if (recent_.size() > kRecent) {
    past_.add(recent_.front());
    recent_.pop_front();
  }
  rise_ = std::max(0.0, rise_ + residual - kReference);
  fall_ = std::max(0.0, fall_ - residual - kReference);
}

bool ChangeDetector::add(const ConstantMeasurement& measurement) {
  if (!std::isfinite(measurement.value) || !(measurement.sigma > 0.0) || !std::isfinite(measurement.sigma))
    return false;
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
    before.add(recent_[i]);
  }
  if (best_before.count == 0) return;
  closed_.push_back(best_before.toSegment());
  const std::deque<ConstantMeasurement> after(recent_.begin() + static_cast<std::ptrdiff_t>(change), recent_.end());
  past_ = open_ = Sums();
  recent_.clear();
  rise_ = fall_ = 0.0;
  for (const ConstantMeasurement& each : after) addToSegment(each);
}

std::vector<ChangeDetector::Segment> ChangeDetector::segments() const {
  std::vector<Segment> all = closed_;
  if (open_.count > 0) all.push_back(open_.toSegment());
  return all;
}

}  // namespace urban_nav_trust
