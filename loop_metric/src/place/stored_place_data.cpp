// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/place/stored_place_data.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace loop_metric {

using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;
using urban_nav_registration::Keyframe;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::localCloud;
using urban_nav_registration::storedScans;
using urban_nav_registration::stretchAround;
using urban_nav_registration::toKeyframe;

StoredPlaceData::StoredPlaceData(Sessions sessions, const urban_nav_store::KeyframeStore& keyframes,
                                 const urban_nav_store::ScanStore& scans)
    : sessions_(std::move(sessions)), keyframes_(keyframes), scans_(scans) {
  for (const auto& [name, session] : sessions_)
    if (session.has_camera) stamps_[name] = keyframes_.stamps(session.id, kKeyframeCamera);
}

void StoredPlaceData::add(const PoseRef& view) {
  const StoredSession* session = find(view);
  if (session == nullptr || !session->has_camera) return;
  std::vector<StampNs>& stamps = stamps_[view.session];
  if (stamps.empty() || stamps.back() < view.stamp) stamps.push_back(view.stamp);
}

const StoredSession* StoredPlaceData::find(const PoseRef& at) const {
  const auto session = sessions_.find(at.session);
  return session == sessions_.end() ? nullptr : &session->second;
}

bool StoredPlaceData::knows(const PoseRef& at, std::string& why) const {
  const StoredSession* session = find(at);
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

std::vector<NearbyKeyframe> StoredPlaceData::views(const PoseRef& at, double distance) const {
  std::vector<NearbyKeyframe> views;
  const StoredSession* session = find(at);
  const auto stamps = stamps_.find(at.session);
  if (session == nullptr || stamps == stamps_.end() || !session->odometry->nearestFrame(at.stamp)) return views;
  const OdometryChain& odometry = *session->odometry;
  const double here = odometry.distance(at.stamp);
  const auto [first, last] = stretchAround(odometry, at.stamp, distance);
  for (auto stamp = std::lower_bound(stamps->second.begin(), stamps->second.end(), first);
       stamp != stamps->second.end() && *stamp <= last; ++stamp) {
    auto T_place_keyframe = odometry.between(at.stamp, *stamp);
    if (T_place_keyframe && session->conversion)
      T_place_keyframe = urban_nav_core::compose(
          *T_place_keyframe, {session->conversion->T_base_virtual(), urban_nav_core::Matrix6d::Zero()});
    if (T_place_keyframe) views.push_back({{at.session, *stamp}, *T_place_keyframe, odometry.distance(*stamp) - here});
  }
  return views;
}

Keyframe StoredPlaceData::keyframe(const PoseRef& at) const {
  Keyframe keyframe;
  keyframe.at = at;
  const StoredSession* session = find(at);
  if (session == nullptr) return keyframe;
  const auto stored = keyframes_.get(session->id, kKeyframeCamera, at.stamp);
  if (stored) keyframe = toKeyframe(*stored, at.session);
  return stored && session->conversion ? session->conversion->convert(keyframe) : keyframe;
}

PointCloud StoredPlaceData::cloud(const PoseRef& at, double distance) const {
  const StoredSession* session = find(at);
  if (session == nullptr) return {};
  return localCloud(*session->odometry, at.stamp, distance, storedScans(scans_, session->id, session->lasers));
}

double StoredPlaceData::deformationSigma(const PoseRef& at, double distance) const {
  const StoredSession* session = find(at);
  return session == nullptr ? 0.0 : urban_nav_registration::deformationSigma(*session->odometry, at.stamp, distance);
}

std::optional<PlaceData::OdometryPath> StoredPlaceData::between(const PoseRef& a, const PoseRef& b) const {
  const StoredSession* session = find(a);
  if (session == nullptr || a.session != b.session) return std::nullopt;
  const auto T_a_b = session->odometry->between(a.stamp, b.stamp);
  if (!T_a_b) return std::nullopt;
  return OdometryPath{*T_a_b, std::abs(session->odometry->distance(b.stamp) - session->odometry->distance(a.stamp))};
}

}  // namespace loop_metric
