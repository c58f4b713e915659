// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_registration/keyframe/keyframe_conversion.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"
#include "urban_nav_store/keyframe_store.hpp"
#include "urban_nav_store/scan_store.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// A session that candidates may refer to.
struct StoredSession {
  urban_nav_store::SessionId id;
  std::shared_ptr<const urban_nav_core::OdometryChain> odometry;
  std::vector<urban_nav_registration::LaserAt> lasers;
  bool has_camera = true;  ///< false: its camera is unknown, and its keyframes are not used
  /// Conversion to the camera of LoopMetric; null if it is the same.
  std::shared_ptr<const urban_nav_registration::KeyframeConversion> conversion = nullptr;
};

/// Place data from keyframes and scans of a store and the odometry of its sessions, which are identified by the names
/// used in candidates. Memory grows only by the stamps of keyframes. Not thread-safe; the stores must outlive it.
class StoredPlaceData : public PlaceData {
 public:
  /// Sessions by name.
  using Sessions = std::map<std::string, StoredSession>;
  StoredPlaceData(Sessions sessions, const urban_nav_store::KeyframeStore& keyframes,
                  const urban_nav_store::ScanStore& scans);

  /// Adds a keyframe of a session being recorded, later than the previous ones; the odometry of the session may grow
  /// too.
  void add(const urban_nav_core::PoseRef& view);

  bool knows(const urban_nav_core::PoseRef& at, std::string& why) const override;
  std::vector<NearbyKeyframe> views(const urban_nav_core::PoseRef& at, double distance) const override;
  urban_nav_registration::Keyframe keyframe(const urban_nav_core::PoseRef& at) const override;
  urban_nav_core::PointCloud cloud(const urban_nav_core::PoseRef& at, double distance) const override;
  double deformationSigma(const urban_nav_core::PoseRef& at, double distance) const override;
  std::optional<OdometryPath> between(const urban_nav_core::PoseRef& a,
                                      const urban_nav_core::PoseRef& b) const override;

 private:
  const StoredSession* find(const urban_nav_core::PoseRef& at) const;

  Sessions sessions_;
  const urban_nav_store::KeyframeStore& keyframes_;
  const urban_nav_store::ScanStore& scans_;
  std::map<std::string, std::vector<urban_nav_core::StampNs>> stamps_;  // of the keyframes, by session
};

}  // namespace loop_metric
