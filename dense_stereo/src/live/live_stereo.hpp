// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dense_stereo/near_scene.hpp"
#include "live/gravity_filter.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace dense_stereo {

/// Dense stereo of a live robot: one estimator per session, with statistics for the operator. Used by one thread.
class LiveStereo {
 public:
  /// Throws UserError if `Parameters::method` is not semi-global matching.
  explicit LiveStereo(const Parameters& parameters);

  /// Begins a session. `T_base_left`: pose of the rectified left camera; `is_mounting_known`: false if it is assumed.
  void begin(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left,
             bool is_mounting_known);
  void addForce(const urban_nav_core::SpecificForce& sample) { gravity_.add(sample); }
  /// Processes a pair. Requires a running session. The result is valid until the next call.
  const NearScene& process(const urban_nav_core::StereoPair& pair);
  /// Counts a pair that is not processed, because no topic has a subscriber.
  void skip() { ++skipped_; }
  /// Ends the session. `why`: for the report.
  void end(const std::string& why);
  /// Sets the reason why no session can begin; empty: none.
  void setFault(const std::string& fault) { fault_ = fault; }

  bool isRunning() const { return estimator_ != nullptr; }
  std::int64_t sessions() const { return sessions_; }
  /// Returns the state for the operator: a warning while there is no session.
  urban_nav_live::StageReport report() const;

 private:
  const Parameters parameters_;
  std::unique_ptr<NearSceneEstimator> estimator_;
  urban_nav_core::Pose T_base_left_;
  bool is_mounting_known_ = false;
  GravityFilter gravity_;
  urban_nav_core::Status status_;
  double answered_ = 0.0, near_share_ = 0.0, height_ = 0.0, process_ms_ = 0.0;
  std::string ground_ = "none yet";
  std::size_t obstacles_ = 0;
  std::int64_t pairs_ = 0, skipped_ = 0, sessions_ = 0;
  std::string waiting_ = "no images yet", fault_;
};

}  // namespace dense_stereo
