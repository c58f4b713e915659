// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/cost.hpp"
#include "window/prior.hpp"
#include "window/solve.hpp"
#include "window/state.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Parameter update (Newman et al. 2009, section 2.2.1): sparse robust Gauss-Newton over the window. Keeps the last
/// factor, from which the covariances are computed.
///
/// Iterations share a factor as long as it contracts, and steps that raise the cost are not taken: poses without
/// measurements are constrained by their process terms only, and along such a weak direction an outdated factor or a
/// full step may diverge.
class GaussNewton {
 public:
  explicit GaussNewton(const WindowOptions& options) : options_(options) {}

  struct Progress {
    int iterations = 0;
    bool converged = false;
  };
  /// With `datum` there is no absolute information, and the oldest pose is held.
  Progress run(State& state, Prior& prior, const Cost& cost, bool datum);

  /// Returns whether the last factor contains the pose of this step; `place` is its index.
  bool inFactor(std::int64_t step, std::size_t& place) const;
  const Solver& solver() const { return solver_; }
  /// Information of the terms of one frame on its own pose.
  const urban_nav_core::Matrix6d& ownInformation(std::size_t place) const { return equations_.pose[place]; }
  /// Invalidates the factor after a change of the state.
  void forget() { has_factor_ = false; }
  void archive(urban_nav_core::Archive& archive);

 private:
  void factor(State& state, const Prior& prior, const Cost& cost, bool datum);
  double priorGradient(const State& state, const Prior& prior);
  void take(double scale, State& state, const Prior& prior) const;
  bool descend(double before, State& state, const Prior& prior, const Cost& cost);

  WindowOptions options_;
  NormalEquations equations_;
  Solver solver_;
  std::vector<double> prior_deviation_, prior_gradient_;
  double prior_cost_ = 0.0, prior_offset_gradient_ = 0.0;
  std::int64_t factor_step_ = 0;  // step of the factor's first pose
  bool has_factor_ = false;
};

/// Computes the statistics of the state after an update.
UpdateReport report(const State& state, const SensorModel& sensor);

}  // namespace swf_vo
