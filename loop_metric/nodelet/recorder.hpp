// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <variant>

#include "judge.hpp"
#include "odometry_rows.hpp"
#include "stage_store.hpp"
#include "urban_nav_ros/mailbox.hpp"
#include "views.hpp"

namespace loop_metric {

/// Keeps in the store what candidates may need: the views, scans and odometry of the running session, in a thread of its own. It names the
/// session, as pose_graph does, and tells the judge of it. Thread-safe.
class Recorder {
 public:
  struct Reset {
    std::shared_ptr<std::promise<void>> done;
  };
  using Input = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr,
                             urban_nav_core::StampedPose, urban_nav_core::RelativePose, Reset>;

  /// How it goes, for diagnostics.
  struct State {
    urban_nav_store::SessionId session;  ///< empty: no odometry has come
    Views::Counts views;
    std::int64_t scans = 0, damaged_scans = 0, refused_steps = 0, not_kept = 0, dropped = 0;
    std::string camera_fault, camera_note;
    std::string laser_fault;  ///< which laser's place is not known
    bool has_lasers = false;
  };

  /// `store` and `judge` must outlive it; `where`: the camera's name space, for errors.
  Recorder(const Parameters& parameters, const NodeletParameters& nodelet, bool rectified, const std::string& where,
           StageStore& store, Judge& judge);
  /// What still waits is dropped; the session is marked complete.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void put(Input input) { mailbox_.put(std::move(input)); }
  State state() const;

 private:
  using Session = urban_nav_store::Session;
  using Write = std::function<void(urban_nav_store::Store&, const urban_nav_store::SessionId&)>;
  struct Laser {
    std::optional<urban_nav_core::Pose> T_base_laser;
    std::optional<urban_nav_core::StampNs> newest;
    bool is_next = false;  ///< its scans are of the session that begins next
  };

  void work();
  void take(Input& input);
  void takeScan(const sensor_msgs::LaserScan& message);
  void takeStep(const urban_nav_core::RelativePose& step);
  void takeViews();
  void placeLasers();
  void begin(urban_nav_core::StampNs start);
  /// A session of the store that a step from there goes on with.
  std::optional<Session> goesOn(urban_nav_core::StampNs start);
  void announce();
  void end();
  /// Into the running session, or the one that begins next.
  void keep(bool is_next, Write write);
  void post(Write write);
  void tell();

  const Parameters parameters_;
  const NodeletParameters nodelet_;
  StageStore& store_;
  Judge& judge_;
  urban_nav_ros::Mailbox<Input> mailbox_;

  // The thread's own.
  urban_nav_ros::StaticTransforms transforms_;
  Views views_;
  bool views_are_next_ = false;
  bool camera_told_ = false;
  std::map<std::string, Laser> lasers_;  // by frame
  std::optional<Session> session_;
  std::set<urban_nav_store::SessionId> used_;  // by sessions of this process
  OdometryRows odometry_;
  urban_nav_core::StampNs heard_ = 0;  // to where the session's odometry has come
  std::deque<Write> before_;           // the session began
  State now_;

  mutable std::mutex mutex_;
  State state_;  // guarded by mutex_
  std::thread thread_;
};

}  // namespace loop_metric
