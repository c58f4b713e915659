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

/// Updating parameters (Newman et al. 2009, section 2.2.1): sparse robust Gauss-Newton over all that is in the
/// window. Keeps the last factor, of which the covariances are taken.
///
/// Iterations share a factor as long as it contracts, and no step is taken that raises the cost: poses that saw
/// nothing are tied by their process terms alone, and along such a loose direction both a factor of yesterday and a
/// full step may lead anywhere.
class GaussNewton {
 public:
  explicit GaussNewton(const WindowOptions& options) : options_(options) {}

  struct Progress {
    int iterations = 0;
    bool converged = false;
  };
  /// With `datum` nothing says where the window is, and its oldest pose is held.
  Progress run(State& state, Prior& prior, const Cost& cost, bool datum);

  /// The last factor knows the pose of this step, and in which place.
  bool inFactor(std::int64_t step, std::size_t& place) const;
  const Solver& solver() const { return solver_; }
  /// What the terms of one frame alone say of its pose.
  const urban_nav_core::Matrix6d& ownInformation(std::size_t place) const { return equations_.pose[place]; }
  /// The state was changed by others.
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

/// Figures of the state after an update.
UpdateReport report(const State& state, const SensorModel& sensor);

}  // namespace swf_vo
