// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/change_detector.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace urban_nav_trust {

namespace {

constexpr double kReference = 0.5;    // half of the smallest change that is to be found, in sigmas
constexpr double kOvershoot = 1.166;  // 2 x 0.583, mean excess of a normal walk over a boundary (Siegmund 1985)

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

void ChangeDetector::addToSegment(const ConstantMeasurement& measurement) {
  const double weight = 1.0 / (measurement.sigma * measurement.sigma);
  const double variance = measurement.sigma * measurement.sigma + (weight_ > 0.0 ? 1.0 / weight_ : 0.0);
  const double residual = weight_ > 0.0 ? (measurement.value - weighted_ / weight_) / std::sqrt(variance) : 0.0;
  open_.push_back(measurement);
  weight_ += weight;
  weighted_ += weight * measurement.value;
  rise_ = std::max(0.0, rise_ + residual - kReference);
  fall_ = std::max(0.0, fall_ - residual - kReference);
}

void ChangeDetector::restart(std::size_t first) {
  std::vector<ConstantMeasurement> after(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end());
  open_.clear();
  weight_ = weighted_ = rise_ = fall_ = 0.0;
  for (const ConstantMeasurement& measurement : after) addToSegment(measurement);
}

bool ChangeDetector::add(const ConstantMeasurement& measurement) {
  if (!std::isfinite(measurement.value) || !(measurement.sigma > 0.0) || !std::isfinite(measurement.sigma))
    return false;
  ++count_;
  addToSegment(measurement);
  const double sum = std::max(rise_, fall_);
  largest_ = std::max(largest_, sum);
  if (sum <= threshold_) return false;
  const std::size_t change = findChange();
  closed_.push_back(summarise(0, change));
  restart(change);
  return true;
}

std::size_t ChangeDetector::findChange() const {
  std::size_t change = 1;
  double before = 0.0, before_weighted = 0.0, largest = -1.0;
  for (std::size_t i = 1; i < open_.size(); ++i) {
    const double weight = 1.0 / (open_[i - 1].sigma * open_[i - 1].sigma);
    before += weight;
    before_weighted += weight * open_[i - 1].value;
    const double after = weight_ - before;
    if (!(after > 0.0)) break;
    const double difference = before_weighted / before - (weighted_ - before_weighted) / after;
    const double distance = difference * difference / (1.0 / before + 1.0 / after);
    if (distance > largest) {
      largest = distance;
      change = i;
    }
  }
  return change;
}

ChangeDetector::Segment ChangeDetector::summarise(std::size_t begin, std::size_t end) const {
  Segment segment;
  double weight = 0.0, weighted = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const ConstantMeasurement& measurement = open_[i];
    weight += 1.0 / (measurement.sigma * measurement.sigma);
    weighted += measurement.value / (measurement.sigma * measurement.sigma);
  }
  segment.interval = {open_[begin].interval.from, open_[end - 1].interval.to};
  segment.measurements = static_cast<std::int64_t>(end - begin);
  segment.mean = weighted / weight;
  segment.sigma = 1.0 / std::sqrt(weight);
  return segment;
}

std::vector<ChangeDetector::Segment> ChangeDetector::segments() const {
  std::vector<Segment> all = closed_;
  if (!open_.empty()) all.push_back(summarise(0, open_.size()));
  return all;
}

}  // namespace urban_nav_trust
