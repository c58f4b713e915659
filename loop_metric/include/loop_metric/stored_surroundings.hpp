// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "loop_metric/surroundings.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_store/keyframe_store.hpp"
#include "urban_nav_store/scan_store.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// Name under which the left camera's keyframes stand in a store.
constexpr const char* keyframe_camera = urban_nav_core::frames::stereo_left;

/// A keyframe as a store keeps it, and back. DataError where the features are damaged or of another version.
urban_nav_store::StoredKeyframe storedKeyframe(const Keyframe& keyframe);
Keyframe keyframeOf(const urban_nav_store::StoredKeyframe& stored, const std::string& session);

/// A laser of a session.
struct LaserAt {
  std::string frame;  ///< under which its scans are stored
  urban_nav_core::Pose T_base_laser;
};

/// Those of a session that have scans in the store, and a place on the robot.
std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// A session whose moments candidates name.
struct SessionOfStore {
  urban_nav_store::SessionId id;
  std::shared_ptr<const urban_nav_core::OdometryChain> odometry;
  std::vector<LaserAt> lasers;
  bool has_camera = true;  ///< the camera that LoopMetric was made for; else its views are left alone
};

/// Surroundings from the keyframes and scans of a store and the odometry of its sessions, which candidates call by their names. Memory does not grow
/// with the sessions but for the stamps of their keyframes. Not thread-safe; the stores must outlive it.
class StoredSurroundings : public Surroundings {
 public:
  /// By name.
  using Sessions = std::map<std::string, SessionOfStore>;
  StoredSurroundings(Sessions sessions, const urban_nav_store::KeyframeStore& keyframes,
                     const urban_nav_store::ScanStore& scans);

  /// A view of a session that is being recorded has been stored, later than those before; its odometry may grow likewise.
  void add(const urban_nav_core::PoseRef& view);

  bool knows(const urban_nav_core::PoseRef& at, std::string& why) const override;
  std::vector<NearbyView> views(const urban_nav_core::PoseRef& at, double way) const override;
  Keyframe keyframe(const urban_nav_core::PoseRef& at) const override;
  urban_nav_core::PointCloud cloud(const urban_nav_core::PoseRef& at, double way) const override;
  double bend(const urban_nav_core::PoseRef& at, double way) const override;
  std::optional<Way> between(const urban_nav_core::PoseRef& a, const urban_nav_core::PoseRef& b) const override;

 private:
  const SessionOfStore* find(const urban_nav_core::PoseRef& at) const;

  Sessions sessions_;
  const urban_nav_store::KeyframeStore& keyframes_;
  const urban_nav_store::ScanStore& scans_;
  std::map<std::string, std::vector<urban_nav_core::StampNs>> stamps_;  // of each session's views
};

}  // namespace loop_metric
