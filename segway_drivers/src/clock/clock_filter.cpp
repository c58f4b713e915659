// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/clock/clock_filter.hpp"

#include <algorithm>
#include <cmath>

#include "clock/lower_line.hpp"

namespace segway_drivers {

namespace {

constexpr double kLeastSigma = 10e-6;                      // s
constexpr double kAcquisition = 2.0;                       // s in which lower arrivals are expected
constexpr double kYoung = 20.0;                            // s in which the line still improves quickly
constexpr double kGatedFrom = 60.0;                        // s after which the skew may change only slowly
constexpr double kDisproof = 0.5e-3;                       // s below the line
constexpr double kContradiction = 0.25;                    // s below the line, beyond any backlog
constexpr int kPassingContradiction = 5;                   // measurements
constexpr double kLateLimit = 0.05;                        // s above the line
constexpr double kLateDuration = 1.0;                      // s
constexpr double kRefusedLimit = 600.0;                    // s without an accepted skew
constexpr double kSlewRate = 1e-3;                         // s/s, of corrections after acquisition
constexpr double kYoungSlewRate = 10e-3;                   // s/s
constexpr double kSkewGate = 2.0;                          // standard deviations of a slope beyond the accepted change
constexpr double kSkewDrift = 1e-6 / 60.0;                 // 1/s, of a crystal that warms up
constexpr double kMemoryOfChange = 0.98;                   // per estimate, one a second
constexpr double kHardFrom = 3.0;                          // s after which a skew beyond the tolerance is accepted
constexpr double kMostBias = 1e-3;                         // s
constexpr double kUnknownSpacing = 5e-3;                   // s
constexpr double kBlockPeriods = 32.0, kLeastBlock = 0.5;  // s
constexpr std::size_t kMostPoints = 16384;

}  // namespace

ClockFilter::ClockFilter(const ClockOptions& options) : options_(options) {
  options_.hard_tolerance = std::max(options_.hard_tolerance, options_.tolerance);
  now_.points.reserve(2 * kMostPoints);
  now_.prior_sigma = 0.5 * options_.tolerance;
}

void ClockFilter::restart() {
  if (started_) ++epoch_;
  started_ = false;
  earlier_.reset();
}

double ClockFilter::offset() const {
  if (!started_) return 0.0;
  return 1e-9 * static_cast<double>(origin_y_) - origin_x_ + now_.line + now_.skew * (now_.last_x - now_.begin_x);
}

double ClockFilter::residual(const Epoch& epoch, const ClockPoint& point) const {
  return point.z - (epoch.line + epoch.skew * (point.x - epoch.begin_x));
}

void ClockFilter::beginEpoch(const ClockPoint& point, bool offset_known, bool keep_latest) {
  now_.declared_x = point.x;
  std::size_t kept = now_.points.size();
  while (keep_latest && kept > now_.first && now_.points[kept - 1].x > point.x - kAcquisition) --kept;
  now_.points.erase(now_.points.begin(), now_.points.begin() + static_cast<std::ptrdiff_t>(kept));
  now_.first = 0;
  now_.begin_x = now_.accepted_at = now_.next_fit = now_.points.empty() ? point.x : now_.points.front().x;
  if (now_.skew_known) {  // crystals do not jump
    now_.prior_skew = now_.skew;
    now_.prior_sigma = std::max(2.0 * options_.max_skew_change, 3.0 * now_.skew_sigma);
  }
  now_.skew = now_.prior_skew;
  now_.line = point.z - now_.skew * (point.x - now_.begin_x);
  now_.offset_known = offset_known;
  now_.late_since.reset();
  now_.published.reset();
  now_.mean_excess = 0.0;
  now_.spacing.reset();
  now_.mean_x = point.x;
}

/// Begins an epoch, and keeps the previous one in case the contradiction is temporary.
void ClockFilter::contradict(const ClockPoint& point, bool offset_known, bool keep_latest) {
  ++epoch_;
  since_contradiction_ = 0;
  if (!earlier_) earlier_ = now_;
  beginEpoch(point, offset_known, keep_latest);
}

/// Restores the epoch before a contradiction if the point fits it and not the current one.
bool ClockFilter::returnToEarlier(const ClockPoint& point, bool is_contradicted) {
  if (!earlier_) return false;
  const double distance = residual(*earlier_, point);
  const bool fits = point.x > earlier_->last_x && distance > -std::max(kDisproof, 5.0 * earlier_->sigma) &&
                    distance < std::max(kLateLimit, 3.0 * options_.period);
  if (is_contradicted && fits) {
    now_ = std::move(*earlier_);
    now_.points.reserve(2 * kMostPoints);
    earlier_.reset();
    ++epoch_;
    return true;
  }
  if (!is_contradicted && ++since_contradiction_ >= kPassingContradiction) earlier_.reset();
  return false;
}

ClockEstimate ClockFilter::add(double device_s, TimeNs arrival) {
  if (!started_) {
    origin_x_ = device_s;
    origin_y_ = arrival;
    beginEpoch({0.0, 0.0}, false, false);
    now_.last_x = -1.0;
    started_ = true;
  }
  const ClockPoint point{device_s - origin_x_,
                         1e-9 * static_cast<double>(arrival - origin_y_) - (device_s - origin_x_)};
  if (point.x != now_.last_x) {
    const double distance = residual(now_, point), age = point.x - now_.declared_x;
    const bool back = point.x < now_.last_x;
    const bool early = distance < -std::max(kContradiction, 10.0 * options_.period);
    if (!returnToEarlier(point, back || early)) {
      const bool late = !back && isPersistentlyLate(point, distance);
      if (back) {
        contradict(point, false, false);
      } else if (early) {
        contradict(point, true, false);
      } else if (isDisproved(distance, age) || late) {
        ++epoch_;
        beginEpoch(point, !late, distance > -kLateLimit && !late);
      }
    }
    now_.last_x = point.x;
    addPoint(point);
  }
  ClockEstimate estimate;
  estimate.epoch = epoch_;
  estimate.sigma = now_.sigma;
  if (now_.offset_known || point.x - now_.begin_x >= options_.settling) {
    now_.offset_known = true;
    estimate.time = toStamp(point.x);
  }
  return estimate;
}

ClockEstimate ClockFilter::estimate(double device_s) const {
  ClockEstimate estimate;
  estimate.epoch = epoch_;
  estimate.sigma = now_.sigma;
  if (!started_ || !now_.offset_known || !now_.published) return estimate;
  const double step = device_s - origin_x_ - now_.published_x;
  estimate.time = origin_y_ + static_cast<TimeNs>(std::llround(1e9 * (*now_.published + step * (1.0 + now_.skew))));
  return estimate;
}

bool ClockFilter::isDisproved(double residual, double age) const {
  return age > kAcquisition && residual < -std::max(kDisproof, (age < kYoung ? 8.0 : 5.0) * now_.sigma);
}

/// Returns whether arrivals have been late by several periods for a second at the rate of the device: not a backlog,
/// which arrives faster than measured.
bool ClockFilter::isPersistentlyLate(const ClockPoint& point, double residual) {
  if (residual < std::max(kLateLimit, 3.0 * options_.period)) {
    now_.late_since.reset();
    return false;
  }
  if (!now_.late_since || point.z < now_.late_since->z - kLateLimit) now_.late_since = point;
  return point.x - now_.late_since->x >= kLateDuration + 4.0 * options_.period;
}

void ClockFilter::addPoint(const ClockPoint& point) {
  std::vector<ClockPoint>& points = now_.points;
  if (points.size() == points.capacity()) {
    points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(now_.first));
    now_.first = 0;
  }
  points.push_back(point);
  while (points[now_.first].x < point.x - options_.window || points.size() - now_.first > kMostPoints) ++now_.first;
  now_.line = std::min(now_.line, point.z - now_.skew * (point.x - now_.begin_x));
  if (point.x >= now_.next_fit) {
    fit();
    const double age = point.x - now_.begin_x;
    now_.next_fit = point.x + (age < kAcquisition ? 0.0 : age < kYoung ? 0.1 : 1.0);
  }
  updateSigma(point.x);
}

void ClockFilter::fit() {
  const ClockPoint* points = now_.points.data() + now_.first;
  const std::size_t count = now_.points.size() - now_.first;
  const double block = std::max(kLeastBlock, kBlockPeriods * options_.period);
  const auto fitted = fitLowerLine(points, count, block, now_.skew, options_.hard_tolerance);
  if (!fitted) return;
  const double x = points[count - 1].x, age = x - now_.begin_x;
  acceptSkew(fitted->slope, fitted->slope_sigma, age);
  if (x - now_.accepted_at > kRefusedLimit) {
    ++epoch_;
    now_.skew_known = false;
    now_.prior_skew = 0.0;
    now_.prior_sigma = 0.5 * options_.tolerance;
    beginEpoch(now_.points.back(), true, true);
    return;
  }
  const std::vector<ClockPoint> hull = lowerHull(points, count);
  now_.line = hull.front().z - now_.skew * (hull.front().x - now_.begin_x);
  for (const ClockPoint& p : hull) now_.line = std::min(now_.line, p.z - now_.skew * (p.x - now_.begin_x));
  now_.mean_x = fitted->mean_x;
  now_.spacing = fitted->spacing;
  now_.mean_excess = std::max(fitted->mean_z - now_.line - now_.skew * (fitted->mean_x - now_.begin_x), 0.0);
}

/// Accepts the slope, weighted with the prior, while the epoch is young; later only a small change, and only if the
/// slope is more certain than the current skew.
void ClockFilter::acceptSkew(double slope, double slope_sigma, double age) {
  const double x = now_.points.back().x;
  if (age < kGatedFrom) {
    const double own = 1.0 / (slope_sigma * slope_sigma), prior = 1.0 / (now_.prior_sigma * now_.prior_sigma);
    double limit = options_.tolerance;
    if (age > kHardFrom && std::abs(slope) > limit + 3.0 * slope_sigma) limit = options_.hard_tolerance;
    const double weight = limit > options_.tolerance ? 1.0 : own / (own + prior);
    now_.skew = std::clamp(now_.prior_skew + weight * (slope - now_.prior_skew), -limit, limit);
    now_.skew_sigma = std::sqrt(1.0 / (own + prior));
    now_.accepted_at = x;
    now_.skew_known = now_.skew_known || age > kYoung;
    return;
  }
  const double change = std::abs(slope - now_.skew), known = now_.skew_sigma + kSkewDrift * (x - now_.accepted_at);
  if (change > options_.max_skew_change + kSkewGate * slope_sigma || slope_sigma > known) return;
  // A significant change may be the onset of a tilt: it is temporarily added to the uncertainty.
  now_.skew_sigma = std::max({slope_sigma, 0.5 * change, kMemoryOfChange * now_.skew_sigma});
  now_.skew = slope;
  now_.accepted_at = x;
}

void ClockFilter::updateSigma(double x) {
  const double of_skew = (now_.skew_sigma + kSkewDrift * (x - now_.accepted_at)) * (x - now_.mean_x);
  now_.sigma = std::max(kLeastSigma, std::hypot(2.0 * now_.spacing.value_or(kUnknownSpacing), of_skew));
}

/// Returns the time on the line minus the expected bias of its height, slewed after acquisition, later than the
/// previous one of the same epoch.
TimeNs ClockFilter::toStamp(double x) {
  // The observed minimum delay exceeds the floor on average by the distance between low delays.
  const double age = x - now_.begin_x;
  const double bias = std::max(0.0, 1.0 - age / kYoung) * std::min(now_.spacing.value_or(0.0), kMostBias);
  double host = x + now_.line - bias + now_.skew * age;
  if (now_.published) {
    const double step = x - now_.published_x;
    if (age > kAcquisition) {
      const double steady = *now_.published + step * (1.0 + now_.skew);
      const double most = (age < kYoung ? kYoungSlewRate : kSlewRate) * step;
      host = std::clamp(host, steady - most, steady + most);
    }
    host = std::max(host, *now_.published + 1e-9);
  }
  now_.published = host;
  now_.published_x = x;
  return origin_y_ + static_cast<TimeNs>(std::llround(1e9 * host));
}

}  // namespace segway_drivers
