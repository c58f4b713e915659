// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/clock/clock_filter.hpp"

#include <algorithm>
#include <cmath>

namespace segway_drivers {

namespace {

constexpr double least_sigma = 10e-6;       // s
constexpr double acquisition = 2.0;         // s in which lower arrivals are no surprise
constexpr double gated_from = 60.0;         // s after which the skew may change slowly only
constexpr double disproof = 0.5e-3;         // s below the line
constexpr double late_limit = 0.05;         // s above the line
constexpr double late_duration = 1.0;       // s
constexpr double refused_limit = 600.0;     // s without an accepted skew
constexpr double slew_rate = 1e-3;          // s/s, of corrections after acquisition
constexpr double skew_drift = 1e-6 / 60.0;  // 1/s, of a crystal that warms up
constexpr double memory_of_change = 0.98;   // per estimate, one a second
constexpr double hard_from = 3.0;           // s after which the data may show a skew beyond the tolerance
constexpr double most_bias = 0.02;          // s, times the number of points
constexpr std::size_t most_points = 16384;

double clockCross(double ax, double az, double bx, double bz) { return ax * bz - az * bx; }

}  // namespace

ClockFilter::ClockFilter(const ClockOptions& options) : options_(options) {
  points_.reserve(2 * most_points);
  options_.hard_tolerance = std::max(options_.hard_tolerance, options_.tolerance);
  prior_sigma_ = 0.5 * options_.tolerance;
}

void ClockFilter::restart() {
  if (started_) ++epoch_;
  started_ = false;
}

double ClockFilter::offset() const {
  if (!started_) return 0.0;
  return 1e-9 * static_cast<double>(origin_y_) - origin_x_ + line_ + skew_ * (last_x_ - begin_x_);
}

void ClockFilter::begin(const Point& point, bool offset_known, bool keep_latest) {
  declared_x_ = point.x;
  std::size_t kept = points_.size();
  while (keep_latest && kept > first_ && points_[kept - 1].x > point.x - acquisition) --kept;
  points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(kept));
  first_ = 0;
  begin_x_ = accepted_at_ = next_fit_ = points_.empty() ? point.x : points_.front().x;
  sum_x_ = sum_z_ = 0.0;
  for (const Point& each : points_) {
    sum_x_ += each.x - begin_x_;
    sum_z_ += each.z;
  }
  if (skew_known_) {  // crystals do not jump
    prior_skew_ = skew_;
    prior_sigma_ = std::max(10e-6, 3.0 * skew_sigma_);
  }
  skew_ = prior_skew_;
  line_ = point.z - skew_ * (point.x - begin_x_);
  offset_known_ = offset_known;
  late_since_.reset();
  published_.reset();
  started_ = true;
}

ClockEstimate ClockFilter::add(double device_s, TimeNs arrival) {
  if (started_ && device_s - origin_x_ < last_x_) restart();
  if (!started_) {
    origin_x_ = device_s;
    origin_y_ = arrival;
    begin({0.0, 0.0}, false, false);
    last_x_ = -1.0;
  }
  const Point point{device_s - origin_x_, 1e-9 * static_cast<double>(arrival - origin_y_) - (device_s - origin_x_)};
  if (point.x > last_x_) {
    const double residual = point.z - (line_ + skew_ * (point.x - begin_x_)), age = point.x - declared_x_;
    const bool late = isPersistentlyLate(point, residual);
    if (isDisproved(residual, age) || late) {
      ++epoch_;
      begin(point, !late, residual > -late_limit && !late);
    }
    last_x_ = point.x;
    addPoint(point);
  }
  ClockEstimate estimate;
  estimate.epoch = epoch_;
  estimate.sigma = sigma_;
  if (offset_known_ || point.x - begin_x_ >= options_.settling) {
    offset_known_ = true;
    estimate.time = toStamp(point.x);
  }
  return estimate;
}

ClockEstimate ClockFilter::estimate(double device_s) const {
  ClockEstimate estimate;
  estimate.epoch = epoch_;
  estimate.sigma = sigma_;
  if (!started_ || !offset_known_ || !published_) return estimate;
  const double step = device_s - origin_x_ - published_x_;
  estimate.time = origin_y_ + static_cast<TimeNs>(std::llround(1e9 * (*published_ + step * (1.0 + skew_))));
  return estimate;
}

bool ClockFilter::isDisproved(double residual, double age) const {
  return age > acquisition && residual < -std::max(disproof, (age < 20.0 ? 8.0 : 5.0) * sigma_);
}

/// Late by several periods for a second while arrivals keep the pace of the device: not a backlog, which arrives faster
/// than it was measured.
bool ClockFilter::isPersistentlyLate(const Point& point, double residual) {
  if (residual < std::max(late_limit, 3.0 * options_.period)) {
    late_since_.reset();
    return false;
  }
  if (!late_since_ || point.z < late_since_->z - late_limit) late_since_ = point;
  return point.x - late_since_->x >= late_duration + 4.0 * options_.period;
}

void ClockFilter::addPoint(const Point& point) {
  if (points_.size() == points_.capacity()) {
    points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
  points_.push_back(point);
  sum_x_ += point.x - begin_x_;
  sum_z_ += point.z;
  while (points_[first_].x < point.x - options_.window || points_.size() - first_ > most_points) {
    sum_x_ -= points_[first_].x - begin_x_;
    sum_z_ -= points_[first_].z;
    ++first_;
  }
  line_ = std::min(line_, point.z - skew_ * (point.x - begin_x_));
  const double age = point.x - begin_x_;
  if (point.x >= next_fit_) {
    fit();
    next_fit_ = point.x + (age < 2.0 ? 0.0 : age < 20.0 ? 0.1 : 1.0);
  }
  updateSigma(point.x);
}

/// Slope of the hull's edge over the mean of all x.
double ClockFilter::hullSlope(double mean_x) {
  hull_.clear();
  for (std::size_t i = first_; i < points_.size(); ++i) {
    const Point& p = points_[i];
    while (hull_.size() >= 2) {
      const Point &a = hull_[hull_.size() - 2], &b = hull_.back();
      if (clockCross(b.x - a.x, b.z - a.z, p.x - b.x, p.z - b.z) > 0.0) break;
      hull_.pop_back();
    }
    hull_.push_back(p);
  }
  for (std::size_t i = 1; i < hull_.size(); ++i)
    if (hull_[i].x >= mean_x || i + 1 == hull_.size())
      return (hull_[i].z - hull_[i - 1].z) / (hull_[i].x - hull_[i - 1].x);
  return prior_skew_;
}

void ClockFilter::fit() {
  const double age = points_.back().x - begin_x_;
  const double n = static_cast<double>(points_.size() - first_);
  if (n < 3) return;
  const double mean_x = sum_x_ / n;
  const double slope = hullSlope(mean_x + begin_x_);
  const double span = points_.back().x - points_[first_].x;
  const double excess = std::max(sum_z_ / n - (line_ + skew_ * mean_x), 1e-6);
  const double slope_sigma = 8.0 * excess / (n * span);
  if (age < gated_from) {
    const double own = 1.0 / (slope_sigma * slope_sigma), prior = 1.0 / (prior_sigma_ * prior_sigma_);
    double limit = options_.tolerance;
    if (age > hard_from && std::abs(slope) > limit + 3.0 * slope_sigma) limit = options_.hard_tolerance;
    const double weight = limit > options_.tolerance ? 1.0 : own / (own + prior);
    skew_ = std::clamp(prior_skew_ + weight * (slope - prior_skew_), -limit, limit);
    skew_sigma_ = std::sqrt(1.0 / (own + prior));
    accepted_at_ = points_.back().x;
    skew_known_ = skew_known_ || age > 20.0;
  } else if (std::abs(slope - skew_) < options_.max_skew_change + 3.0 * slope_sigma) {
    // A change beyond chance may be the onset of a tilt: it counts as uncertainty for a while.
    skew_sigma_ = std::max({slope_sigma, 0.5 * std::abs(slope - skew_), memory_of_change * skew_sigma_});
    skew_ = slope;
    accepted_at_ = points_.back().x;
  } else if (points_.back().x - accepted_at_ > refused_limit) {
    ++epoch_;
    skew_known_ = false;
    prior_skew_ = 0.0;
    prior_sigma_ = 0.5 * options_.tolerance;
    begin(points_.back(), true, true);
    return;
  }
  line_ = hull_.front().z - skew_ * (hull_.front().x - begin_x_);
  for (const Point& p : hull_) line_ = std::min(line_, p.z - skew_ * (p.x - begin_x_));
}

void ClockFilter::updateSigma(double x) {
  const double n = static_cast<double>(points_.size() - first_), mean_x = sum_x_ / n;
  mean_excess_ = std::max(sum_z_ / n - (line_ + skew_ * mean_x), 0.0);
  const double reach = x - begin_x_ - mean_x, stale = x - accepted_at_;
  const double of_skew = (skew_sigma_ + skew_drift * stale) * reach;
  const double of_floor = n < 3 ? 0.01 : 2.0 * mean_excess_ / n;
  sigma_ = std::max(least_sigma, std::sqrt(of_floor * of_floor + of_skew * of_skew));
}

/// Time on the line less the expected bias of its height, slewed after acquisition, later than the one before in the
/// same epoch.
TimeNs ClockFilter::toStamp(double x) {
  // The least of n delays exceeds the floor by their mean excess over n (exactly so for exponential delays): matters
  // while n is small.
  const double bias = std::max(0.0, 1.0 - (x - begin_x_) / 20.0) * std::min(mean_excess_, most_bias) /
                      static_cast<double>(points_.size() - first_);
  double host = x + line_ - bias + skew_ * (x - begin_x_);
  if (published_) {
    const double step = x - published_x_;
    if (x - begin_x_ > acquisition) {
      const double steady = *published_ + step * (1.0 + skew_);
      host = std::clamp(host, steady - slew_rate * step, steady + slew_rate * step);
    }
    host = std::max(host, *published_ + 1e-9);
  }
  published_ = host;
  published_x_ = x;
  return origin_y_ + static_cast<TimeNs>(std::llround(1e9 * host));
}

}  // namespace segway_drivers
