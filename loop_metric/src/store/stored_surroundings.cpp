// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/stored_surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/laser/beam_renderer.hpp"

namespace loop_metric {

using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs longest_stay = 20'000'000'000;  // ns: before and behind a moment, however little the robot moved
constexpr StampNs longest_gap = 500'000'000;      // ns without a pose in which beams have no place
constexpr double usual_range = 10.0;              // m: of surfaces beside a street
constexpr double least_bend = 0.005;              // m: a millisecond of the lasers' clocks in a turn of 0.5 rad/s
constexpr std::size_t most_points = 400'000;      // of a cloud: two lasers of 75 Hz and 181 beams over 15 s

/// The first and the last moment of the way around `at`, by odometry's frames.
std::pair<StampNs, StampNs> stretchAround(const OdometryChain& odometry, StampNs at, double way) {
  const urban_nav_core::Trajectory& frames = odometry.trajectory();
  const double here = odometry.distance(at);
  const std::size_t nearest = frames.nearest(at);
  std::size_t first = nearest, last = nearest;
  while (first > 0 && at - frames[first - 1].stamp <= longest_stay &&
         here - odometry.distance(frames[first - 1].stamp) <= way)
    --first;
  while (last + 1 < frames.size() && frames[last + 1].stamp - at <= longest_stay &&
         odometry.distance(frames[last + 1].stamp) - here <= way)
    ++last;
  return {frames[first].stamp, frames[last].stamp};
}

/// Evenly, so that dense clouds stay bounded.
void thin(PointCloud& cloud) {
  if (cloud.points.size() <= most_points) return;
  const std::size_t step = (cloud.points.size() + most_points - 1) / most_points;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.points.size(); i += step, ++kept) {
    cloud.points[kept] = cloud.points[i];
    cloud.origins[kept] = cloud.origins[i];
  }
  cloud.points.resize(kept);
  cloud.origins.resize(kept);
}

}  // namespace

StoredSurroundings::StoredSurroundings(Sessions sessions, const urban_nav_store::KeyframeStore& keyframes,
                                       const urban_nav_store::ScanStore& scans)
    : sessions_(std::move(sessions)), keyframes_(keyframes), scans_(scans) {
  for (const auto& [name, session] : sessions_)
    if (session.has_camera) stamps_[name] = keyframes_.stamps(session.id, keyframe_camera);
}

void StoredSurroundings::add(const PoseRef& view) {
  const SessionOfStore* session = find(view);
  if (session == nullptr || !session->has_camera) return;
  std::vector<StampNs>& stamps = stamps_[view.session];
  if (stamps.empty() || stamps.back() < view.stamp) stamps.push_back(view.stamp);
}

const SessionOfStore* StoredSurroundings::find(const PoseRef& at) const {
  const auto session = sessions_.find(at.session);
  return session == sessions_.end() ? nullptr : &session->second;
}

bool StoredSurroundings::knows(const PoseRef& at, std::string& why) const {
  const SessionOfStore* session = find(at);
  if (session != nullptr && session->odometry->momentOf(at.stamp)) return true;
  if (session != nullptr) {
    why = "no frames around " + urban_nav_core::printStamp(at.stamp) + " s in " + at.session;
    return false;
  }
  std::string names;
  for (const auto& [name, each] : sessions_) names += (names.empty() ? "" : ", ") + name;
  why = "no session \"" + at.session + "\" in this map; there are: " + names;
  return false;
}

std::vector<NearbyView> StoredSurroundings::views(const PoseRef& at, double way) const {
  std::vector<NearbyView> views;
  const SessionOfStore* session = find(at);
  const auto stamps = stamps_.find(at.session);
  if (session == nullptr || stamps == stamps_.end() || !session->odometry->momentOf(at.stamp)) return views;
  const OdometryChain& odometry = *session->odometry;
  const double here = odometry.distance(at.stamp);
  const auto [first, last] = stretchAround(odometry, at.stamp, way);
  for (auto stamp = std::lower_bound(stamps->second.begin(), stamps->second.end(), first);
       stamp != stamps->second.end() && *stamp <= last; ++stamp) {
    const auto T_moment_view = odometry.between(at.stamp, *stamp);
    if (T_moment_view) views.push_back({{at.session, *stamp}, *T_moment_view, odometry.distance(*stamp) - here});
  }
  return views;
}

Keyframe StoredSurroundings::keyframe(const PoseRef& at) const {
  Keyframe keyframe;
  keyframe.at = at;
  const SessionOfStore* session = find(at);
  if (session == nullptr) return keyframe;
  const auto stored = keyframes_.get(session->id, keyframe_camera, at.stamp);
  return stored ? keyframeOf(*stored, at.session) : keyframe;
}

PointCloud StoredSurroundings::cloud(const PoseRef& at, double way) const {
  PointCloud cloud;
  const SessionOfStore* session = find(at);
  if (session == nullptr) return cloud;
  const OdometryChain& odometry = *session->odometry;
  const std::optional<Pose> T_first_moment = odometry.at(at.stamp);
  if (!T_first_moment) return cloud;
  const auto [first, last] = stretchAround(odometry, at.stamp, way);
  std::vector<urban_nav_core::LaserPoint> points;
  for (const LaserAt& laser : session->lasers) {
    urban_nav_core::BeamRenderer renderer(odometry.trajectory(), laser.T_base_laser, T_first_moment->inverse(),
                                          longest_gap);
    scans_.forEach(session->id, laser.frame, first, last, [&](const urban_nav_core::Scan& scan) {
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

// Of a random walk from end to end, laid upon another by its mean: a sixth of its variance over the whole way, which is a third of that over a half.
double StoredSurroundings::bend(const PoseRef& at, double way) const {
  const SessionOfStore* session = find(at);
  if (session == nullptr || !session->odometry->momentOf(at.stamp)) return 0.0;
  const auto [first, last] = stretchAround(*session->odometry, at.stamp, way);
  double variance = 0.0;
  for (const StampNs end : {first, last})
    if (const auto T_moment_end = session->odometry->between(at.stamp, end)) {
      const auto& covariance = T_moment_end->covariance;
      variance = std::max(variance, (covariance.topLeftCorner<3, 3>().trace() +
                                     usual_range * usual_range * covariance.bottomRightCorner<3, 3>().trace()) /
                                        3.0);
    }
  return std::max(std::sqrt(variance / 3.0), least_bend);
}

std::optional<Surroundings::Way> StoredSurroundings::between(const PoseRef& a, const PoseRef& b) const {
  const SessionOfStore* session = find(a);
  if (session == nullptr || a.session != b.session) return std::nullopt;
  const auto T_a_b = session->odometry->between(a.stamp, b.stamp);
  if (!T_a_b) return std::nullopt;
  return Way{*T_a_b, std::abs(session->odometry->distance(b.stamp) - session->odometry->distance(a.stamp))};
}

}  // namespace loop_metric
