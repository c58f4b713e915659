// SPDX-License-Identifier: BSD-3-Clause
#include "window/gauss_newton.hpp"

#include <cmath>

#include "window/measurements.hpp"

namespace swf_vo {

using Eigen::Vector3d;
using urban_nav_core::boxMinus;
using urban_nav_core::boxPlus;
using urban_nav_core::Vector6d;

namespace {

// A step that increases the cost by more than this share is halved.
constexpr double kCostSlack = 0.01;
constexpr int kHalvings = 4;
// The factor is reused while each step is smaller than the previous one by this factor (in d^T g)
constexpr double kContraction = 0.1;
// ... and the first step was not larger than this (chi-square).
constexpr double kFarStart = 2000.0;
// A step with an old factor that exceeds this share of the previous one is recomputed with a new factor.
constexpr double kStalled = 0.5;
// With contradictory measurements poses or the offset may diverge: steps beyond these limits are rejected like steps
// that increase the cost.
constexpr double kLongestMove = 1e4;      // m, from the linearisation point of a pose
constexpr double kLargestOffset = 100.0;  // px

bool isSane(const State& state) {
  if (!(std::abs(state.disparity_offset) < kLargestOffset)) return false;
  for (const PoseBlock& pose : state.poses)
    if (!((pose.estimate.t() - pose.linearised.t()).squaredNorm() < kLongestMove * kLongestMove)) return false;
  return true;
}

}  // namespace

void GaussNewton::factor(State& state, const Prior& prior, const Cost& cost, bool datum) {
  cost.build(state, equations_);
  solver_.factor(state, prior, equations_, datum);
  has_factor_ = true;
  factor_step_ = state.first_step;
}

double GaussNewton::priorGradient(const State& state, const Prior& prior) {
  prior.deviation(state, prior_deviation_);
  prior_cost_ = prior.gradient(prior_deviation_, state.disparity_offset, prior_gradient_, prior_offset_gradient_);
  return prior_cost_;
}

void GaussNewton::take(double scale, State& state, const Prior& prior) const {
  state.disparity_offset += scale * solver_.offsetStep();
  for (std::size_t j = 0; j < state.poses.size(); ++j) {
    PoseBlock& pose = state.poses[j];
    const Vector6d d = scale * solver_.poseStep(j);
    // The prior is quadratic in the chart around its centre: its pose is updated in that chart.
    pose.estimate = j == 0 && prior.has_pose
                        ? boxPlus(prior.pose_centre, boxMinus(pose.estimate, prior.pose_centre) + d)
                        : boxPlus(pose.estimate, d);
    pose.at_estimate = PoseMatrices(pose.estimate);
  }
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    LandmarkBlock& landmark = state.landmarks[slot];
    if (landmark.used && !landmark.known) landmark.estimate += scale * solver_.landmarkStep(slot);
  }
}

// Shortens the step until the cost does not increase. Returns false, with the state unchanged, if it always does.
bool GaussNewton::descend(double before, State& state, const Prior& prior, const Cost& cost) {
  double scale = 1.0;
  for (int h = 0; h <= kHalvings; ++h) {
    const double after = priorGradient(state, prior) + cost.value(state);
    if (isSane(state) && after <= before + kCostSlack * (1.0 + std::abs(before))) return true;
    if (h == kHalvings) break;
    take(-0.5 * scale, state, prior);
    scale *= 0.5;
  }
  take(-scale, state, prior);
  return false;
}

GaussNewton::Progress GaussNewton::run(State& state, Prior& prior, const Cost& cost, bool datum) {
  Progress progress;
  double last = 0.0;
  bool refactor = true, current = false;  // current: the prior's gradient is at the estimates
  for (int i = 0; i < options_.iterations; ++i) {
    cost.relinearise(state, prior);
    if (!current) priorGradient(state, prior);
    if (refactor) factor(state, prior, cost, datum);
    else cost.buildGradient(state, equations_);
    solver_.solve(state, prior, equations_, prior_gradient_, prior_offset_gradient_);
    // With weak constraints a shared factor may not contract: the unobserved direction has rotated with the estimates,
    // and the component of the gradient along it is divided by almost zero.
    if (!refactor && solver_.decrement() > kStalled * last) {
      factor(state, prior, cost, datum);
      solver_.solve(state, prior, equations_, prior_gradient_, prior_offset_gradient_);
    }
    ++progress.iterations;
    take(1.0, state, prior);
    current = false;
    // One step of one pose is that of the extended Kalman filter, and always accepted.
    if (options_.iterations > 1 || state.poses.size() > 1) {
      if (!descend(prior_cost_ + equations_.cost, state, prior, cost)) break;
      current = !measurements::undoAbsurd(state);
    }
    const double decrement = solver_.decrement();
    progress.converged = decrement < options_.tolerance;
    if (progress.converged) break;
    // The textbook's factor belongs to its last step; otherwise a new one is needed after a far start or slow
    // convergence.
    refactor = !options_.linearise_first || decrement > (i == 0 ? kFarStart : kContraction * last);
    last = decrement;
  }
  if (!cost.lineariseFirst()) prior.recentre(state);
  return progress;
}

bool GaussNewton::inFactor(std::int64_t step, std::size_t& place) const {
  if (!has_factor_ || step < factor_step_) return false;
  place = static_cast<std::size_t>(step - factor_step_);
  return place < solver_.poses();
}

UpdateReport report(const State& state, const SensorModel& sensor) {
  UpdateReport result;
  const std::int64_t newest = state.newestStep();
  const PoseMatrices pose(state.poses.back().estimate);
  double squares = 0.0;
  int count = 0;
  Vector3d z;
  for (const LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used) continue;
    if (!landmark.known) ++result.landmarks;
    if (landmark.prior >= 0) ++result.landmarks_in_prior;
    for (const Measurement& measurement : landmark.seen) {
      if (measurement.weight > 0.0) ++result.observations;
      else ++result.dropped;
      if (measurement.weight > 0.0 && measurement.weight < 0.5) ++result.downweighted;
      const bool in_left = measurement.information(0, 0) > 0.0;
      if (measurement.step != newest || !(measurement.weight > 0.0) || !in_left) continue;
      if (!sensor.predict(landmark.anchor, landmark.estimate, pose, z)) continue;
      squares += (measurement.z - z).head<2>().squaredNorm();
      ++count;
    }
  }
  result.reprojection_px = count > 0 ? std::sqrt(squares / count) : 0.0;
  return result;
}

void GaussNewton::archive(urban_nav_core::Archive& archive) { archive(solver_, factor_step_, has_factor_); }

}  // namespace swf_vo
