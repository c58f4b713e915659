// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/cloud/local_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "urban_nav_core/laser/beam_renderer.hpp"

namespace urban_nav_registration {

using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kLongestStay = 20'000'000'000;  // ns before and after a stamp, for a slow or standing robot
constexpr StampNs kLongestGap = 500'000'000;      // ns without a pose, in which beams are dropped
constexpr double kUsualRange = 10.0;              // m, typical distance of surfaces in a street
constexpr double kLeastBend = 0.005;              // m: a millisecond of the lasers' clocks at a yaw rate of 0.5 rad/s
constexpr std::size_t kMostPoints = 400'000;      // per cloud: two lasers of 75 Hz and 181 beams over 15 s

/// Thins the cloud evenly to kMostPoints.
void thin(PointCloud& cloud) {
  if (cloud.points.size() <= kMostPoints) return;
  const std::size_t step = (cloud.points.size() + kMostPoints - 1) / kMostPoints;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.points.size(); i += step, ++kept) {
    cloud.points[kept] = cloud.points[i];
    cloud.origins[kept] = cloud.origins[i];
  }
  cloud.points.resize(kept);
  cloud.origins.resize(kept);
}

}  // namespace

std::pair<StampNs, StampNs> stretchAround(const OdometryChain& odometry, StampNs at, double half_length) {
  const urban_nav_core::Trajectory& frames = odometry.trajectory();
  const double here = odometry.distance(at);
  const std::size_t nearest = frames.nearest(at);
  std::size_t first = nearest, last = nearest;
  while (first > 0 && at - frames[first - 1].stamp <= kLongestStay &&
         here - odometry.distance(frames[first - 1].stamp) <= half_length)
    --first;
  while (last + 1 < frames.size() && frames[last + 1].stamp - at <= kLongestStay &&
         odometry.distance(frames[last + 1].stamp) - here <= half_length)
    ++last;
  return {frames[first].stamp, frames[last].stamp};
}

PointCloud localCloud(const OdometryChain& odometry, StampNs at, double half_length,
                      const std::vector<LaserScans>& lasers) {
  PointCloud cloud;
  const std::optional<Pose> T_first_moment = odometry.at(at);
  if (!T_first_moment) return cloud;
  const auto [first, last] = stretchAround(odometry, at, half_length);
  std::vector<urban_nav_core::LaserPoint> points;
  for (const LaserScans& laser : lasers) {
    urban_nav_core::BeamRenderer renderer(odometry.trajectory(), laser.T_base_laser, T_first_moment->inverse(),
                                          kLongestGap);
    laser.forEach(first, last, [&](const urban_nav_core::Scan& scan) {
      points.clear();
      renderer.render(scan, points);
      for (const urban_nav_core::LaserPoint& point : points) {
        cloud.points.push_back(point.p);
        cloud.origins.push_back(point.origin);
      }
    });
  }
  thin(cloud);
  return cloud;
}

// Mean deviation of a random walk from end to end after alignment by its mean: a sixth of its variance over the whole
// length, which is a third of that over a half.
double deformationSigma(const OdometryChain& odometry, StampNs at, double half_length) {
  if (!odometry.nearestFrame(at)) return 0.0;
  const auto [first, last] = stretchAround(odometry, at, half_length);
  double variance = 0.0;
  for (const StampNs end : {first, last})
    if (const auto T_moment_end = odometry.between(at, end)) {
      const auto& covariance = T_moment_end->covariance;
      variance = std::max(variance, (covariance.topLeftCorner<3, 3>().trace() +
                                     kUsualRange * kUsualRange * covariance.bottomRightCorner<3, 3>().trace()) /
                                        3.0);
    }
  return std::max(std::sqrt(variance / 3.0), kLeastBend);
}

}  // namespace urban_nav_registration
