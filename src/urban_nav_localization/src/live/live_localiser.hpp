// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "live/recent_scans.hpp"
#include "live/recent_sweeps.hpp"
#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_live/time_jump.hpp"
#include "urban_nav_localization/cloud_search.hpp"
#include "urban_nav_localization/localiser.hpp"
#include "urban_nav_localization/map_search.hpp"
#include "urban_nav_registration/keyframe/keyframe_builder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_localization {

/// Localises a live robot in a frozen map. Keyframes are selected as in any drive, and each is searched for in the map
/// once smoothed odometry has reached it; so are the scans and sweeps of the last metres. Used by one thread.
class LiveLocaliser {
 public:
  /// Pose in the map from the user (`initialpose`). Stamp 0, or a stamp that odometry has not reached: now.
  struct InitialPose {
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::PoseWithCovariance T_map_base;
  };
  /// Called after each step of odometry, and when a query, a pose from the user or a restart changes the estimate
  /// between two steps. `T_map_odom`: of the last time that the state was Localized; nullopt: it never was.
  using Listener =
      std::function<void(const LocalizationEstimate&, const std::optional<urban_nav_core::Pose>& T_map_odom)>;

  /// Figures for the operator.
  struct State {
    LocalizationEstimate estimate;
    urban_nav_registration::KeyframeBuilder::Counts keyframes;
    std::size_t map_keyframes = 0, map_keyframes_read = 0;
    std::int64_t queries = 0, matches = 0, initial_poses = 0;
    std::size_t map_places = 0, map_places_read = 0;  ///< whose clouds are searched
    std::int64_t cloud_queries = 0, cloud_matches = 0;
    std::int64_t scans = 0, sweeps = 0;
    std::int64_t dropped_keyframes = 0;  ///< for which there was no time
    std::int64_t refused_steps = 0, restarts = 0;
    double query_ms = 0.0, cloud_query_ms = 0.0;  ///< of the last query
    std::string map_fault;                        ///< why keyframes or clouds cannot be searched for
  };

  /// `store` holds `map` and stays open. `make_retrieval`: called for each camera.
  LiveLocaliser(const Parameters& parameters, urban_nav_store::Store store, FrozenMap map,
                urban_nav_registration::KeyframeRetrievalFactory make_retrieval, Listener listener);

  /// Sets the camera of the pairs that follow; nullopt: its calibration has changed.
  void setCamera(const std::optional<urban_nav_registration::MountedCamera>& camera);
  /// Stamps of the images have jumped back.
  void restartImages();
  void addPair(urban_nav_core::StereoPairWithMotion pair);
  /// Adds the turn of the right camera that odometry found for a frame.
  void addTurn(const urban_nav_core::StampedTurn& turn) { builder_.addTurn(turn); }
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  void addScan(const std::string& frame, const urban_nav_core::Scan& scan);
  void addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep);
  void setLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser) {
    scans_.setLaser(frame, T_base_laser);
    sweeps_.setLidar(frame, T_base_laser);
  }
  std::vector<std::string> unplacedLasers() const;
  /// Appends a step of smoothed odometry. A gap, or a jump back in time, restarts the localization.
  void addStep(const urban_nav_core::RelativePose& step);
  void addInitialPose(const InitialPose& initial_pose);
  /// The robot was moved: its pose is unknown.
  void restart();

  /// Reads some keyframes or a place of the map, or answers one query. Returns false if there is nothing to do.
  bool work();
  State state() const;

 private:
  void forget();
  void takeKeyframes();
  /// Calls the listener with the estimate at the end of the last step.
  void publishEstimate();
  void publishIfChanged();
  /// Returns false while odometry has not reached the pose of the user.
  bool applyInitialPose();
  bool queryKeyframe();
  bool queryCloud();

  const Parameters parameters_;
  urban_nav_store::Store store_;
  const FrozenMap map_;
  const urban_nav_registration::KeyframeRetrievalFactory make_retrieval_;
  const Listener listener_;
  urban_nav_registration::KeyframeBuilder builder_;
  std::string camera_;  // fingerprint of the camera of search_
  std::unique_ptr<MapSearch> search_;
  RecentScans scans_;
  RecentSweeps sweeps_;
  std::unique_ptr<CloudSearch> clouds_;
  Localiser localiser_;
  bool needs_clouds_;  // clouds_ is made by the first work(), since it reads the odometry of the map
  std::optional<urban_nav_core::StampNs> reached_;    // by smoothed odometry
  std::deque<urban_nav_core::StampedPose> odometry_;  // filtered, later than reached_
  urban_nav_live::TimeJumpDetector odometry_time_;
  std::deque<urban_nav_registration::Keyframe> waiting_;
  std::optional<InitialPose> initial_pose_;
  std::optional<urban_nav_core::Pose> T_map_odom_;
  State state_;
};

}  // namespace urban_nav_localization
