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
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/time_jump.hpp"
#include "urban_nav_registration/keyframe/keyframe_builder.hpp"

namespace loop_metric {

/// Records what candidates may need into the store: keyframes, scans and odometry of the running session, which is that
/// of the odometry, and reports it to the verifier. Used by one thread.
class SessionRecorder {
 public:
  struct Options {
    std::string robot, recording;
  };
  /// Figures for the operator.
  struct State {
    urban_nav_store::SessionId session;  ///< empty: no odometry has arrived
    urban_nav_registration::KeyframeBuilder::Counts keyframes;
    std::int64_t scans = 0, refused_steps = 0;
    std::int64_t not_stored = 0;  ///< keyframes and scans for which there was no room before the first odometry
  };

  /// `store` and `verifier` must outlive it.
  SessionRecorder(const urban_nav_registration::Parameters& parameters, Options options,
                  urban_nav_live::StoreWriterLink& store, ClosureVerifier& verifier);

  /// Sets the camera of the pairs that follow; nullopt: its calibration has changed.
  void setCamera(const std::optional<urban_nav_registration::MountedCamera>& camera);
  /// Stamps of the images have jumped back: pairs that follow belong to the next session.
  void restartImages();
  void addPair(urban_nav_core::StereoPairWithMotion pair);
  /// Adds the turn of the right camera that odometry found for a frame.
  void addTurn(const urban_nav_core::StampedTurn& turn) { builder_.addTurn(turn); }
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  void addScan(const std::string& frame, const urban_nav_core::Scan& scan);
  /// Sets the pose of a laser. Ignored for a laser without scans and for one whose pose is known.
  void setLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser);
  /// Returns the frames of lasers that have scans and no pose.
  std::vector<std::string> unplacedLasers() const;
  /// Appends a step of smoothed odometry. The first one of a session of the odometry begins it here; where odometry
  /// does not announce sessions, the first one and one after a jump back in time.
  void addStep(const urban_nav_core::SessionStep& step);

  /// Opens the store when an attempt is due. To be called some ten times a second.
  void idle();
  /// Ends the session: it is marked complete.
  void end();
  State state() const;

 private:
  using Session = urban_nav_store::Session;
  using Write = std::function<void(urban_nav_store::Store&, const urban_nav_store::SessionId&)>;
  struct Laser {
    std::optional<urban_nav_core::Pose> T_base_laser;
    urban_nav_live::TimeJumpDetector time;
    bool is_next = false;  ///< its scans belong to the session that begins next
  };

  void storeKeyframes();
  void begin(const urban_nav_core::SessionStep& first);
  /// Names the session, and prepares the odometry to continue a stored one.
  urban_nav_live::SessionNamer::Named nameSession(const urban_nav_core::SessionStep& first);
  void storeSession();
  /// Into the running session, or into the one that begins next.
  void store(bool is_next, Write write);
  void post(Write write);

  const Options options_;
  urban_nav_live::StoreWriterLink& store_;
  ClosureVerifier& verifier_;
  urban_nav_registration::KeyframeBuilder builder_;
  std::string camera_;  // fingerprint of the camera that the verifier knows
  bool images_are_next_ = false;
  urban_nav_live::TimeJumpDetector odometry_time_, step_time_;
  std::map<std::string, Laser> lasers_;  // by frame
  urban_nav_live::SessionNamer namer_;
  std::optional<Session> session_;
  std::string announced_;  // id of session_ by the odometry; empty: it does not announce it
  OdometryRows odometry_;
  std::deque<Write> before_;  // the session began
  std::int64_t scans_ = 0, refused_steps_ = 0, not_stored_ = 0;
};

}  // namespace loop_metric
