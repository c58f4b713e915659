// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "loop_metric/cloud_search.hpp"
#include "loop_metric/localiser.hpp"
#include "loop_metric/map_search.hpp"
#include "recent_scans.hpp"
#include "urban_nav_ros/mailbox.hpp"
#include "urban_nav_store/store.hpp"
#include "views.hpp"

namespace loop_metric {

/// Looks for the robot in a frozen map, in a thread of its own: views as they are kept of any drive, each looked for in the map once settled odometry
/// has reached it, and what the lasers saw on the last metres. Thread-safe.
class LocaliseWorker {
 public:
  /// What somebody believes (initialpose). Stamp 0, or one that odometry has not come to: now.
  struct Belief {
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::PoseWithCovariance T_map_base;
  };
  /// Where the robot is, is not known any more.
  struct Reset {};
  using Input = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr,
                             urban_nav_core::StampedPose, urban_nav_core::RelativePose, Belief, Reset>;

  /// After each step of odometry, in the worker's thread. `T_map_odom`: of the last time that the robot was KNOWN; empty: it never was.
  using Listener = std::function<void(const Located& located, const std::optional<urban_nav_core::Pose>& T_map_odom)>;

  /// How it goes, for diagnostics.
  struct State {
    Located located;
    Views::Counts views;
    std::size_t map_views = 0, map_views_read = 0;
    std::int64_t looks = 0, sightings = 0, beliefs = 0;
    std::size_t map_places = 0, map_places_read = 0;    ///< whose clouds are looked for
    std::int64_t cloud_looks = 0, cloud_sightings = 0;  ///< likewise of clouds
    std::int64_t scans = 0, damaged_scans = 0;
    std::string laser_fault;         ///< which laser's place is not known
    std::int64_t dropped = 0;        ///< inputs, the mailbox was full
    std::int64_t dropped_views = 0;  ///< that would have been looked for, had there been time
    std::int64_t refused_steps = 0, begun_anew = 0;
    double look_ms = 0.0, cloud_look_ms = 0.0;  ///< of the last look
    std::string camera_fault, camera_note;
    std::string map_fault;  ///< why this camera's views cannot be looked for in the map
  };

  /// `store` holds `map` and stays open; `where`: the camera's name space, for errors.
  LocaliseWorker(const Parameters& parameters, const LocalisationParameters& nodelet, bool rectified,
                 const std::string& where, urban_nav_store::Store store, FrozenMap map, Listener listener);
  /// What still waits is dropped.
  ~LocaliseWorker();
  LocaliseWorker(const LocaliseWorker&) = delete;
  LocaliseWorker& operator=(const LocaliseWorker&) = delete;

  void put(Input input) { mailbox_.put(std::move(input)); }
  State state() const;

 private:
  void work();
  void take(Input& input);
  void hear(const urban_nav_core::StampedPose& odometry);
  void takeStep(const urban_nav_core::RelativePose& step);
  void takeViews();
  void believe();
  void beginAnew();
  void makeSearch();
  /// A view or place of the map is read, or one of the drive looked for; false where there is nothing to do.
  bool searchOn();
  bool lookForView();
  bool lookForCloud();
  void tell();

  const Parameters parameters_;
  urban_nav_store::Store store_;
  const FrozenMap map_;
  const Listener listener_;
  urban_nav_ros::Mailbox<Input> mailbox_;

  // The thread's own.
  urban_nav_ros::StaticTransforms transforms_;
  Views views_;
  std::unique_ptr<MapSearch> search_;
  RecentScans scans_;
  std::unique_ptr<CloudSearch> clouds_;
  Localiser localiser_;
  std::optional<urban_nav_core::StampNs> reached_;    // by settled odometry
  std::deque<urban_nav_core::StampedPose> odometry_;  // as it was at the moment, later than reached_
  std::deque<Keyframe> waiting_;
  std::optional<Belief> belief_;
  std::optional<urban_nav_core::Pose> T_map_odom_;
  bool camera_seen_ = false;
  State now_;

  mutable std::mutex mutex_;
  State state_;  // guarded by mutex_
  std::thread thread_;
};

}  // namespace loop_metric
