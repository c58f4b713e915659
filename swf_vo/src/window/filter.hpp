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

/// The four steps of section 2.2.1 over one set of values, without the memory that undoing needs (window.hpp): add
/// the pose, remove the oldest, add landmarks, update. A value: a copy goes on from where the original stood.
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
  /// The measurements of a frame become these (undo.hpp).
  void setMeasurements(FrameId frame, const std::vector<Observation>& observations);
  void flush(std::vector<SettledPose>& settled);

  urban_nav_core::PoseWithCovariance newest() const;
  double disparityOffsetSigma() const { return std::sqrt(offset_.error()); }
  double scaleSigma() const { return datum_.scaleSigma(); }
  const State& state() const { return state_; }
  const Prior& prior() const { return prior_; }
  const Cost& cost() const { return cost_; }
  const Datum& datum() const { return datum_; }

  /// All that the following steps depend on.
  struct Checkpoint {
    State state;
    Prior prior;
    urban_nav_core::Matrix6d newest_covariance;
    Datum datum;
    LandmarkScores scores;
    OffsetBelief offset;
    std::optional<urban_nav_core::Matrix6d> oldest_information;
  };
  void save(Checkpoint& checkpoint) const;
  void restore(const Checkpoint& checkpoint);

  /// What was handed out as settled, and stays whatever is undone.
  struct Published {
    urban_nav_core::PoseWithCovariance settled;
    std::int64_t step = -1;
  };
  Published published() const { return {settled_, settled_step_}; }
  void publish(const Published& published);

  /// The next addPose will take information out of the window.
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
  OffsetBelief judgeOffset() const;
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
  std::vector<LandmarkProcessNoise::Step> wandered_;
  std::vector<double> directions_;  // of the gauge, of the prior
  OffsetBelief offset_;
  urban_nav_core::Matrix6d newest_covariance_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::PoseWithCovariance settled_;  // the last that left
  std::int64_t settled_step_ = -1;
  urban_nav_core::Matrix6d settled_in_window_ =
      urban_nav_core::Matrix6d::Zero();  // its covariance without what is carried
  bool gain_valid_ = false;              // of the marginaliser, between settled_ and the oldest pose
  urban_nav_core::Matrix6d settled_apart_ =
      urban_nav_core::Matrix6d::Zero();  // added to it in the step to its neighbour
  Datum datum_;
  LandmarkScores scores_;
  std::optional<urban_nav_core::Matrix6d>
      oldest_information_;   // of the oldest pose on itself at the last update, until it leaves
  bool has_known_ = false;   // landmarks whose places are given
  bool gauge_free_ = false;  // nothing says where odom is
};

}  // namespace swf_vo
