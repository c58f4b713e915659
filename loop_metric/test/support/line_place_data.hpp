// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>

#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace loop_metric::testing {

/// Sessions whose odometry is exact apart from the noise of each step, with keyframes and clouds set by a test.
class LinePlaceData : public PlaceData {
 public:
  std::map<std::string, urban_nav_core::OdometryChain> odometry;
  std::map<urban_nav_core::PoseRef, urban_nav_registration::Keyframe> keyframes;
  std::function<urban_nav_core::PointCloud(const urban_nav_core::PoseRef&)> clouds;

  /// Adds a session with these poses, one per second from 0; sigmas of one step.
  void drive(const std::string& session, const std::vector<urban_nav_core::Pose>& T_world_base, double sigma_m,
             double sigma_rad) {
    for (std::size_t i = 1; i < T_world_base.size(); ++i) {
      urban_nav_core::RelativePose step;
      step.from = static_cast<urban_nav_core::StampNs>(i - 1) * 1'000'000'000;
      step.to = step.from + 1'000'000'000;
      step.T_from_to = T_world_base[i - 1].inverse() * T_world_base[i];
      step.covariance.setZero();
      step.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
          Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
      odometry[session].append(step);
    }
  }

  bool knows(const urban_nav_core::PoseRef& at, std::string& why) const override {
    const auto its = odometry.find(at.session);
    if (its != odometry.end() && its->second.nearestFrame(at.stamp)) return true;
    why = "no data there";
    return false;
  }
  std::vector<NearbyKeyframe> views(const urban_nav_core::PoseRef& at, double distance) const override {
    std::vector<NearbyKeyframe> result;
    const auto its = odometry.find(at.session);
    if (its == odometry.end()) return result;
    for (const auto& [ref, keyframe] : keyframes) {
      if (ref.session != at.session) continue;
      const double along = its->second.distance(ref.stamp) - its->second.distance(at.stamp);
      if (std::abs(along) <= distance) result.push_back({ref, *its->second.between(at.stamp, ref.stamp), along});
    }
    return result;
  }
  urban_nav_registration::Keyframe keyframe(const urban_nav_core::PoseRef& at) const override {
    const auto its = keyframes.find(at);
    urban_nav_registration::Keyframe result;
    if (its != keyframes.end()) result = its->second;
    result.at = at;
    return result;
  }
  double deformationSigma(const urban_nav_core::PoseRef&, double) const override { return 0.0; }
  urban_nav_core::PointCloud cloud(const urban_nav_core::PoseRef& at, double) const override {
    return clouds ? clouds(at) : urban_nav_core::PointCloud();
  }
  std::optional<OdometryPath> between(const urban_nav_core::PoseRef& a,
                                      const urban_nav_core::PoseRef& b) const override {
    const auto its = odometry.find(a.session);
    if (its == odometry.end() || a.session != b.session) return std::nullopt;
    const auto T_a_b = its->second.between(a.stamp, b.stamp);
    if (!T_a_b) return std::nullopt;
    return OdometryPath{*T_a_b, std::abs(its->second.distance(b.stamp) - its->second.distance(a.stamp))};
  }
};

}  // namespace loop_metric::testing
