// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/gps_reading.hpp"

#include <cmath>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::GpsReading;
using urban_nav_core::Vector3d;

namespace {

constexpr double kUnknownSigma = 5.0;  // m, for single receivers in towns
constexpr double kLeastSigma = 0.01;   // m
constexpr double kNoHeight = 1e4;      // m: standard deviation of an unknown height

bool isUsable(const sensor_msgs::NavSatFix& fix) {
  return fix.status.status >= sensor_msgs::NavSatStatus::STATUS_FIX && std::abs(fix.latitude) <= 90.0 &&
         std::abs(fix.longitude) <= 360.0 && !(fix.latitude == 0.0 && fix.longitude == 0.0) &&
         !fix.header.stamp.isZero();
}

}  // namespace

std::optional<GpsReading> toGpsReading(const sensor_msgs::NavSatFix& fix) {
  if (!isUsable(fix)) return std::nullopt;
  GpsReading reading;
  reading.stamp = toStampNs(fix.header.stamp);
  reading.latitude = fix.latitude;
  reading.longitude = fix.longitude;
  reading.height = std::isfinite(fix.altitude) ? fix.altitude : 0.0;
  reading.sigma = kUnknownSigma * Vector3d(1.0, 1.0, 2.0);
  const bool is_stated = fix.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN;
  for (std::size_t axis = 0; is_stated && axis < 3; ++axis) {
    const double variance = fix.position_covariance[4 * axis];
    if (std::isfinite(variance) && variance > 0.0)  // zero means unknown
      reading.sigma(static_cast<Eigen::Index>(axis)) = std::max(kLeastSigma, std::sqrt(variance));
  }
  if (!std::isfinite(fix.altitude)) reading.sigma.z() = kNoHeight;
  return reading;
}

}  // namespace urban_nav_ros
