// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/gps_examination.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_input {

namespace {

constexpr std::int64_t kFewFixes = 20, kFewJumps = 2;
constexpr double kFastest = 100.0;  // m/s
constexpr double kFarthest = 50.0;  // m: possible error of a position after loss and reacquisition
constexpr double kMetresPerDegree = 111'200.0;

/// Returns the distance of two positions on the ground, m.
double apart(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double north = b[0] - a[0], east = std::remainder(b[1] - a[1], 360.0) * std::cos(M_PI / 180.0 * a[0]);
  return kMetresPerDegree * std::hypot(north, east);
}

}  // namespace

void GpsExamination::add(const sensor_msgs::NavSatFix& fix) {
  ++messages_;
  if (fix.header.stamp.isZero()) ++no_stamp_;
  if (fix.status.status < sensor_msgs::NavSatStatus::STATUS_FIX) {
    ++no_fix_;
    return;
  }
  const bool has_angles = std::abs(fix.latitude) <= 90.0 && std::abs(fix.longitude) <= 360.0,
             is_zero = fix.latitude == 0.0 && fix.longitude == 0.0;
  if (!has_angles || is_zero) {  // not used, and not checked further
    ++(is_zero ? at_zero_ : no_angles_);
    return;
  }
  const bool has_altitude = std::isfinite(fix.altitude);
  if (!has_altitude) ++no_altitude_;
  const std::array<double, 3> now = {{fix.latitude, fix.longitude, has_altitude ? fix.altitude : 0.0}};
  const double stamp = fix.header.stamp.toSec();
  repeated_ += now == last_ ? 1 : 0;
  if (last_stamp_ > 0.0 && stamp > last_stamp_ &&
      apart(last_, now) > std::max(kFarthest, kFastest * (stamp - last_stamp_)))
    ++jumps_;
  const auto& variances = fix.position_covariance;
  if (fix.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN &&
      (variances[0] == 0.0 || variances[4] == 0.0))
    ++no_variance_;
  last_ = now;
  last_stamp_ = stamp;
}

std::vector<Finding> GpsExamination::findings(const std::string& topic) const {
  std::vector<Finding> findings;
  const auto add = [&](std::int64_t count, const std::string& what, const std::string& remedy) {
    if (count > 0)
      findings.push_back({FindingKind::Gps,
                          topic + ": " + std::to_string(count) + " of " + std::to_string(messages_) + " fixes " + what,
                          remedy});
  };
  add(no_stamp_, "have no stamp and are not used", "let the driver of the receiver stamp its fixes");
  add(no_angles_,
      "have a latitude or longitude that is not an angle in degrees (NaN, or radians times a factor) and are not used",
      "check the driver of the receiver");
  add(at_zero_,
      "lie at latitude 0, longitude 0 and are not used: the receiver had no fix, although its status is that of a fix",
      "let the driver set status -1 without a fix");
  add(no_altitude_, "have no altitude (NaN); their horizontal position is used, their height is not",
      "no action needed; for later recordings let the receiver output its altitude (NMEA GGA)");
  add(no_variance_, "have a covariance of zero; a standard deviation of 5 m is assumed",
      "no action needed; for later recordings let the driver publish its covariance, or the type unknown");
  if (jumps_ >= kFewJumps)
    add(jumps_, "are farther from the previous fix than a vehicle can move: the position jumps",
        "check the antenna and its view of the sky; robust factors reject single outliers");
  if (no_fix_ > 0 && 2 * no_fix_ > messages_)
    add(no_fix_, "have a status below 0 (no fix) and are not used", "check the antenna and its view of the sky");
  if (messages_ >= kFewFixes && 2 * repeated_ > messages_)
    add(repeated_, "repeat the previous position exactly: the receiver or its driver is frozen",
        "restart the driver, and publish each fix once");
  return findings;
}

}  // namespace urban_nav_input
