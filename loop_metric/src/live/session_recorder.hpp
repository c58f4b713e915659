// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "live/closure_verifier.hpp"
#include "live/odometry_rows.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/trajectory/travel_spacing.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/time_jump.hpp"
#include "urban_nav_registration/keyframe/keyframe_builder.hpp"

namespace loop_metric {

/// Records the data required by candidates into the store: keyframes, scans, sweeps and odometry of the running
/// session, which is that of the odometry; notifies the verifier. Used by one thread.
class SessionRecorder {
 public:
  struct Options {
    std::string robot, recording;
  };
  /// Statistics for the operator.
  struct State {
    urban_nav_store::SessionId session;  ///< empty: no odometry so far
    urban_nav_registration::KeyframeBuilder::Counts keyframes;
    std::int64_t scans = 0, refused_steps = 0;
    std::int64_t sweeps = 0;      ///< stored, of 3D LiDARs
    std::int64_t not_stored = 0;  ///< keyframes, scans and sweeps dropped before the first odometry
  };

  /// `store` and `verifier` must outlive it.
  SessionRecorder(const urban_nav_registration::Parameters& parameters, Options options,
                  urban_nav_live::StoreWriterLink& store, ClosureVerifier& verifier);

  /// Sets the camera of the following pairs; nullopt: its calibration has changed.
  void setCamera(const std::optional<urban_nav_registration::MountedCamera>& camera);
  /// Marks a backward jump of image stamps: following pairs belong to the next session.
  void restartImages();
  void addPair(urban_nav_core::StereoPairWithMotion pair);
  /// Adds the turn of the right camera that odometry found for a frame.
  void addTurn(const urban_nav_core::StampedTurn& turn) { builder_.addTurn(turn); }
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  void addScan(const std::string& frame, const urban_nav_core::Scan& scan);
  /// Adds a sweep of a 3D LiDAR, of which those are stored that the motion of the robot requires (kSweepSpacing).
  void addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep);
  /// Sets the pose of a laser. Ignored for lasers without scans or sweeps or with a known pose.
  void setLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser);
  /// Returns the frames of lasers with scans or sweeps but without a pose.
  std::vector<std::string> unplacedLasers() const;
  /// Appends a step of smoothed odometry. The first step of an odometry session starts a session here; if odometry does
  /// not announce sessions, the first step and each one after a backward jump of time.
  void addStep(const urban_nav_core::SessionStep& step);

  /// Opens the store when an attempt is due. Call about ten times a second.
  void idle();
  /// Ends the session and marks it complete.
  void end();
  State state() const;

 private:
  using Session = urban_nav_store::Session;
  using Write = std::function<void(urban_nav_store::Store&, const urban_nav_store::SessionId&)>;
  struct Laser {
    std::optional<urban_nav_core::Pose> T_base_laser;
    urban_nav_live::TimeJumpDetector time;
    bool is_next = false;  ///< its scans belong to the next session
    std::string role;      ///< of a 3D LiDAR: "points0", its name in the store; empty: planar
    urban_nav_core::TravelSpacing spacing{urban_nav_core::kSweepSpacing};  ///< of stored sweeps
  };
  /// Returns the name of the laser in the store.
  static const std::string& storedName(const std::string& frame, const Laser& laser) {
    return laser.role.empty() ? frame : laser.role;
  }

  void storeKeyframes();
  void begin(const urban_nav_core::SessionStep& first);
  /// Names the session, and prepares the odometry to continue a stored one.
  urban_nav_live::SessionNamer::Named nameSession(const urban_nav_core::SessionStep& first);
  void storeSession();
  /// Writes to the running session, or to the next one.
  void store(bool is_next, Write write);
  void post(Write write);

  const Options options_;
  urban_nav_live::StoreWriterLink& store_;
  ClosureVerifier& verifier_;
  urban_nav_registration::KeyframeBuilder builder_;
  std::string camera_;  // fingerprint of the camera passed to the verifier
  bool images_are_next_ = false;
  urban_nav_live::TimeJumpDetector odometry_time_, step_time_;
  std::optional<urban_nav_core::Pose> T_odom_base_;  // newest
  std::map<std::string, Laser> lasers_;              // keyed by frame
  urban_nav_live::SessionNamer namer_;
  std::optional<Session> session_;
  std::string announced_;  // id of session_ by the odometry; empty: not announced
  OdometryRows odometry_;
  std::deque<Write> before_;  // writes before the start of the session
  std::int64_t scans_ = 0, sweeps_ = 0, refused_steps_ = 0, not_stored_ = 0;
};

}  // namespace loop_metric
