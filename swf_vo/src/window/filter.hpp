// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/cost.hpp"
#include "window/covariance.hpp"
#include "window/datum.hpp"
#include "window/gauss_newton.hpp"
#include "window/history.hpp"
#include "window/landmark_process_noise.hpp"
#include "window/landmark_scores.hpp"
#include "window/marginalise.hpp"
#include "window/prior.hpp"
#include "window/state.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// The four steps of section 2.2.1 on one state, without the record for undo (window.hpp): add the pose, remove the
/// oldest, add landmarks, update. Value type: a copy continues from the state of the original.
class Filter {
 public:
  Filter(const WindowOptions& options, const urban_nav_core::StereoCamera& camera);

  void start(FrameId frame, const urban_nav_core::Pose& T_odom_camera, const urban_nav_core::Matrix6d& information);
  void addPose(FrameId frame, const ProcessInput& u);
  void restart(FrameId frame, const ProcessInput& u, std::vector<SettledPose>& settled);
  void removePoses(std::vector<SettledPose>& settled, History* history);
  bool fixLandmark(const MapPoint& point);
  bool observe(const Observation& observation);
  bool withdraw(LandmarkId landmark, FrameId frame);
  void endLandmark(LandmarkId landmark);
  UpdateReport update();
  /// Replaces the measurements of a frame (undo.hpp).
  void setMeasurements(FrameId frame, const std::vector<Observation>& observations);
  void flush(std::vector<SettledPose>& settled);

  urban_nav_core::PoseWithCovariance newest() const;
  double disparityOffsetSigma() const { return std::sqrt(offset_.error()); }
  double scaleSigma() const { return datum_.scaleSigma(); }
  const State& state() const { return state_; }
  const Prior& prior() const { return prior_; }
  const Cost& cost() const { return cost_; }
  const Datum& datum() const { return datum_; }

  /// Complete state for the following steps.
  struct Checkpoint {
    State state;
    Prior prior;
    urban_nav_core::Matrix6d newest_covariance;
    Datum datum;
    LandmarkScores scores;
    DisparityOffsetEstimate offset;
    std::optional<urban_nav_core::Matrix6d> oldest_information;
  };
  void save(Checkpoint& checkpoint) const;
  void restore(const Checkpoint& checkpoint);

  /// The settled pose that was handed out last; not affected by undo.
  struct Published {
    urban_nav_core::PoseWithCovariance settled;
    std::int64_t step = -1;
  };
  Published published() const { return {settled_, settled_step_}; }
  void publish(const Published& published);

  /// Returns whether the next addPose will marginalise.
  bool isFull() const { return state_.poses.size() >= limit(); }
  void archive(urban_nav_core::Archive& archive);

 private:
  void check(const urban_nav_core::Archive& archive) const;
  std::size_t limit() const;
  void removeOldest(std::vector<SettledPose>& settled, History* history);
  SettledPose settle();
  void deleteOldest();
  urban_nav_core::Matrix6d relativeCovariance(const PoseBlock& oldest) const;
  urban_nav_core::Matrix6d driftCovariance(const PoseBlock& oldest, const urban_nav_core::Matrix6d& relative) const;
  urban_nav_core::ConsideredConstants constants(const PoseBlock& oldest,
                                                const urban_nav_core::Pose& T_previous_camera) const;
  DisparityOffsetEstimate estimateOffset() const;
  void applyProcessNoise(const Eigen::Vector3d& origin);
  urban_nav_core::Matrix6d computeWindowCovariance(std::int64_t step) const;
  urban_nav_core::Matrix6d computeCovariance(std::int64_t step) const;

  WindowOptions options_;
  Cost cost_;
  State state_;
  Prior prior_;
  GaussNewton gauss_newton_;
  Marginaliser marginaliser_;
  LandmarkProcessNoise process_noise_;
  std::vector<LandmarkProcessNoise::Step> drifted_;
  std::vector<double> directions_;  // gauge directions of the prior
  DisparityOffsetEstimate offset_;
  urban_nav_core::Matrix6d newest_covariance_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::PoseWithCovariance settled_;  // last settled pose
  std::int64_t settled_step_ = -1;
  urban_nav_core::Matrix6d settled_in_window_ =
      urban_nav_core::Matrix6d::Zero();  // its covariance in the window, without Datum::carried
  bool gain_valid_ = false;              // the marginaliser's gain between settled_ and the oldest pose is valid
  urban_nav_core::Matrix6d settled_apart_ =
      urban_nav_core::Matrix6d::Zero();  // part added to its covariance in the step to its neighbour
  Datum datum_;
  LandmarkScores scores_;
  std::optional<urban_nav_core::Matrix6d>
      oldest_information_;   // information of the oldest pose on itself at the last update, until it leaves
  bool has_known_ = false;   // landmarks of known position
  bool gauge_free_ = false;  // no information on the pose in odom
};

}  // namespace swf_vo
