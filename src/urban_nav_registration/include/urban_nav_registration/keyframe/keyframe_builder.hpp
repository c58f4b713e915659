// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "urban_nav_core/sequence/right_camera_turns.hpp"
#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"
#include "urban_nav_registration/keyframe/mounted_camera.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav_registration {

/// Builds keyframes from live stereo pairs and filtered odometry, which arrive independently. Selection and result are
/// the same as offline. Memory is bounded. Used by one thread.
class KeyframeBuilder {
 public:
  struct Counts {
    std::int64_t pairs = 0, extracted = 0;
    std::int64_t without_odometry = 0;  ///< pairs without a pose of odometry
  };

  explicit KeyframeBuilder(const Parameters& parameters) : parameters_(parameters), selector_(parameters) {}

  /// Sets the camera of the following pairs. Drops pairs that still wait for odometry.
  void setCamera(const MountedCamera& camera);
  /// Drops the camera and the waiting pairs.
  void clearCamera();
  /// Restarts the selection and drops all waiting data, after a backward jump of stamps.
  void restart();

  /// Appends a pair, later than the previous ones. Requires a camera.
  void addPair(urban_nav_core::StereoPairWithMotion pair);
  /// Drops waiting poses, after a backward jump of odometry stamps.
  void restartOdometry();
  /// Appends a pose of the odometry. Ignored unless it is later than the previous ones.
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  /// Adds the turn of the right camera that odometry found for a frame: pairs are corrected for it.
  void addTurn(const urban_nav_core::StampedTurn& turn);
  /// Returns the keyframes completed since the last call, in order of time.
  std::vector<Keyframe> take();

  /// Returns nullopt until setCamera().
  const std::optional<MountedCamera>& camera() const { return camera_; }
  const Counts& counts() const { return counts_; }

 private:
  const Parameters parameters_;
  std::optional<MountedCamera> camera_;
  std::optional<KeyframeExtractor> extractor_;
  std::optional<urban_nav_core::RightCameraTurns> turns_;
  KeyframeSelector selector_;
  std::deque<urban_nav_core::StereoPairWithMotion> pairs_;  // waiting for odometry
  std::deque<urban_nav_core::StampedPose> odometry_;        // waiting for pairs
  std::optional<urban_nav_core::StampNs> newest_pose_;
  Counts counts_;
};

}  // namespace urban_nav_registration
