// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "window/cost.hpp"
#include "window/covariance.hpp"
#include "window/history.hpp"
#include "window/marginalise.hpp"
#include "window/prior.hpp"
#include "window/solve.hpp"
#include "window/state.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// The four steps of section 2.2.1 over one set of values, without the memory that undoing needs (window.hpp): add the pose,
/// remove the oldest, add landmarks, update. A value: a copy goes on from where the original stood.
class Filter {
 public:
  Filter(const WindowOptions& options, const urban_nav_core::StereoCamera& camera);

  void start(FrameId frame, const urban_nav_core::Pose& T_odom_camera, const urban_nav_core::Matrix6d& information);
  void addPose(FrameId frame, const ProcessInput& u);
  void removePoses(std::vector<SettledPose>& settled, History* history);
  bool fixLandmark(const MapPoint& point);
  bool observe(const Observation& observation);
  bool withdraw(LandmarkId landmark, FrameId frame);
  void endLandmark(LandmarkId landmark);
  UpdateReport update();
  void flush(std::vector<SettledPose>& settled);

  urban_nav_core::UncertainPose newest() const;
  const State& state() const { return state_; }
  const Prior& prior() const { return prior_; }
  const Cost& cost() const { return cost_; }

 private:
  std::size_t limit() const;
  void removeOldest(std::vector<SettledPose>& settled, History* history);
  SettledPose settle();
  void deleteOldest();
  void place(int slot, const Measurement& first);
  void localiseNewest();
  double gradients();
  void take(double scale);
  void undoAbsurd();
  UpdateReport report() const;
  // The last factor knows the pose of this step, and in which place.
  bool inFactor(std::int64_t step, std::size_t& place) const;
  urban_nav_core::Matrix6d covarianceOf(std::int64_t step) const;

  WindowOptions options_;
  Cost cost_;
  State state_;
  Prior prior_;
  NormalEquations equations_;
  Solver solver_;
  Marginaliser marginaliser_;
  std::vector<double> prior_deviation_, prior_gradient_;
  double prior_cost_ = 0.0;
  std::int64_t factor_step_ = 0;       // step of the factor's first pose
  bool has_factor_ = false;
  urban_nav_core::Matrix6d newest_covariance_ = urban_nav_core::Matrix6d::Zero();
  urban_nav_core::UncertainPose settled_;     // the last that left
  std::int64_t settled_step_ = -1;
  bool gain_valid_ = false;                   // of the marginaliser, between settled_ and the oldest pose
  bool gauge_free_ = false;                   // nothing says where odom is
};

}  // namespace swf_vo
