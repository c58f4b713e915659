// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/stored_surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "loop_metric/local_cloud.hpp"

namespace loop_metric {

using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;

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
  if (session != nullptr && session->odometry->nearestFrame(at.stamp)) return true;
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
  if (session == nullptr || stamps == stamps_.end() || !session->odometry->nearestFrame(at.stamp)) return views;
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
  const SessionOfStore* session = find(at);
  if (session == nullptr) return {};
  std::vector<LaserScans> lasers;
  for (const LaserAt& laser : session->lasers)
    lasers.push_back({laser.T_base_laser, [this, session, frame = laser.frame](StampNs first, StampNs last, const auto& take) {
                        scans_.forEach(session->id, frame, first, last, take);
                      }});
  return localCloud(*session->odometry, at.stamp, way, lasers);
}

double StoredSurroundings::bend(const PoseRef& at, double way) const {
  const SessionOfStore* session = find(at);
  return session == nullptr ? 0.0 : bendOf(*session->odometry, at.stamp, way);
}

std::optional<Surroundings::Way> StoredSurroundings::between(const PoseRef& a, const PoseRef& b) const {
  const SessionOfStore* session = find(a);
  if (session == nullptr || a.session != b.session) return std::nullopt;
  const auto T_a_b = session->odometry->between(a.stamp, b.stamp);
  if (!T_a_b) return std::nullopt;
  return Way{*T_a_b, std::abs(session->odometry->distance(b.stamp) - session->odometry->distance(a.stamp))};
}

std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::vector<LaserAt> found;
  const std::vector<std::string> lasers = store.scans().lasers(session);
  for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(session))
    if (std::find(lasers.begin(), lasers.end(), extrinsic.frame) != lasers.end())
      found.push_back({extrinsic.frame, extrinsic.T_base_frame});
  return found;
}

}  // namespace loop_metric
