// SPDX-License-Identifier: BSD-3-Clause
#include "window/filter.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "window/gauge.hpp"

namespace swf_vo {

using Eigen::Vector3d;
using urban_nav_core::boxMinus;
using urban_nav_core::boxPlus;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::UncertainPose;
using urban_nav_core::Vector6d;

namespace {

// Bearings further out than 84 deg from the axis at birth, or nearer than a tenth of a millimetre: an estimate gone astray.
// Of the pose that a window begins with, m and rad.
constexpr double datum_sigma = 1e-6;
constexpr double absurd_bearing = 10.0;
constexpr double absurd_inverse_depth = 1e4;
// Radians: a fifth of what a good match is off by in an image of 500 px.
constexpr double least_wander = 5e-5;
// A step that raises the cost by more than this share is halved.
constexpr double cost_slack = 0.01;
constexpr int halvings = 4;
// Gauss-Newton goes on with the old factor while each step is this much smaller than the one before (in d^T g).
constexpr double contraction = 0.1;
// ... and the first step was no larger than this (chi-square).
constexpr double far_start = 2000.0;
// Share of a step's covariance that is always taken as drift, so that it stays proper where nothing drifts: one step's in a thousand steps.
constexpr double least_drift = 1e-3;

bool isSane(const Vector3d& theta) {
  return std::abs(theta.x()) < absurd_bearing && std::abs(theta.y()) < absurd_bearing && std::abs(theta.z()) < absurd_inverse_depth;
}

bool hasFullRank(Eigen::Matrix3d information) {
  const Vector3d diagonal = information.diagonal();
  if (!urban_nav_core::choleskyInPlace(information)) return false;
  for (int i = 0; i < 3; ++i)
    if (!(information(i, i) * information(i, i) > 1e-9 * diagonal[i])) return false;
  return true;
}

Matrix6d inverse(Matrix6d A) {
  Matrix6d B = Matrix6d::Identity();
  urban_nav_core::solvePositiveDefiniteInPlace(A, B);
  return B;
}

// Any rotation that turns z towards the direction.
Eigen::Matrix3d lookingAlong(const Vector3d& direction) {
  Eigen::Matrix3d R;
  const Vector3d z = direction.normalized();
  const Vector3d x = (std::abs(z.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY()).cross(z).normalized();
  R << x, z.cross(x), z;
  return R;
}

}  // namespace

Filter::Filter(const WindowOptions& options, const urban_nav_core::StereoCamera& camera)
    : options_(options), cost_(SensorModel(camera), options.huber, options.linearise_first) {
  state_.disparity_offset = camera.disparity_offset;
}

std::size_t Filter::limit() const { return static_cast<std::size_t>(std::max(1, options_.size)) + (options_.forget_by_deletion ? 1U : 0U); }

void Filter::start(FrameId frame, const Pose& T_odom_camera, const Matrix6d& information) {
  PoseBlock pose;
  pose.frame = frame;
  pose.estimate = pose.linearised = T_odom_camera;
  state_.poses.reserve(std::min<std::size_t>(limit(), 256) + 1);
  state_.poses.push_back(pose);
  prior_.start(T_odom_camera, information);
  prior_.startOffset(state_.disparity_offset, options_.disparity_offset);
  offset_sigma_ = options_.disparity_offset;
  Matrix6d root = information;
  gauge_free_ = !has_known_ && !urban_nav_core::choleskyInPlace(root);
  datum_.start(prior_);
  if (has_known_ || !options_.linearise_first || options_.forget_by_deletion) datum_.giveUp();
  newest_covariance_ = inverse(information + process_model::floor());
}

// Adding new pose parameters (section 2.2.1).
void Filter::addPose(FrameId frame, const ProcessInput& u) {
  const PoseBlock& last = state_.poses.back();
  newest_covariance_ = covariance::propagate(last.estimate, newest_covariance_, u);
  PoseBlock pose;
  pose.frame = frame;
  pose.u = u;
  pose.estimate = pose.linearised = process_model::predict(last.estimate, u);
  state_.poses.push_back(pose);
}

void Filter::restart(FrameId frame, const ProcessInput& u, std::vector<SettledPose>& settled) {
  const Pose& last = state_.poses.back().estimate;
  const UncertainPose next{process_model::predict(last, u), covariance::propagate(last, newest_covariance_, u)};
  // What is known of the disparity offset, with all else marginalised.
  const double information = prior_.has_offset ? solver_.offsetInformation(prior_) : 0.0, offset = state_.disparity_offset;
  flush(settled);
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot)
    if (state_.landmarks[slot].used && !state_.landmarks[slot].known) state_.remove(static_cast<int>(slot));
  PoseBlock pose;
  pose.frame = frame;
  pose.u = u;
  pose.estimate = pose.linearised = next.pose;
  state_.poses.push_back(pose);
  newest_covariance_ = next.covariance;
  has_factor_ = gain_valid_ = false;
  if (datum_.isActive()) {
    prior_.start(next.pose, Matrix6d::Identity() / (datum_sigma * datum_sigma));
    datum_.start(prior_, next.covariance);
  } else {
    prior_.start(next.pose, inverse(next.covariance));
  }
  prior_.offset_information = information;
  prior_.offset_eta = information * offset - solver_.offsetPull(prior_, offset);
}

// Removing parameters.
void Filter::removePoses(std::vector<SettledPose>& settled, History* history) {
  while (state_.poses.size() > limit()) removeOldest(settled, history);
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state_.landmarks[slot];
    if (landmark.used && !landmark.followed && landmark.prior < 0 && landmark.seen.empty()) state_.remove(static_cast<int>(slot));
  }
}

void Filter::removeOldest(std::vector<SettledPose>& settled, History* history) {
  settled.push_back(settle());
  if (options_.forget_by_deletion) {
    deleteOldest();
    return;
  }
  if (!prior_.frozen) prior_.recentre(state_);
  if (cost_.lineariseFirst()) cost_.relinearise(state_, prior_);
  const Vector3d origin = state_.poses[1].linearised.t();
  const Matrix6d left = gauge::ofPose(state_.poses.front().linearised, origin);
  marginaliser_.removeOldest(state_, prior_, cost_, origin, history);
  gain_valid_ = true;
  settled_apart_.setZero();
  if (!datum_.isActive()) return;
  datum_.moveTo(origin);
  wander(origin);
  Departed& departed = marginaliser_.departed();
  datum_.marginalised(departed.gauge_loss);
  const Vector6d per_px = datum_.releaseOffset(offset_sigma_, state_, prior_);
  departed.offset_gain += (departed.gauge_gain - left) * per_px;
  std::size_t place = 0;
  if (!inFactor(state_.first_step - 1, place) || !datum_.hold(equations_.pose[place], options_.datum_ratio, state_, prior_)) return;
  // The pose that left goes with the window as its gain says, not quite as a rigid piece of it: the rest stays in the step.
  const Matrix6d gain = departed.gauge_gain, slack = gain - left;
  settled_in_window_ -= gain * datum_.shift() * gain.transpose();
  settled_apart_ = slack * datum_.shift() * slack.transpose();
}

// Small steps are gathered: a landmark costs a pass over the prior.
void Filter::wander(const Vector3d& origin) {
  wandered_.clear();
  for (LandmarkBlock& landmark : state_.landmarks) {
    if (!landmark.used || landmark.prior < 0) continue;
    if (!landmark.seen.empty()) {
      landmark.wander += landmark.seen.front().wander;
      landmark.seen.front().wander.setZero();
    }
    if (landmark.wander.trace() < least_wander * least_wander) continue;
    wandered_.push_back({landmark.prior, landmark.wander});
    landmark.wander.setZero();
  }
  if (wandered_.empty()) return;
  gauge::ofPrior(state_, prior_, origin, directions_);
  wander_.apply(wandered_, directions_, prior_, marginaliser_.departed());
}

SettledPose Filter::settle() {
  const PoseBlock& oldest = state_.poses.front();
  SettledPose result;
  result.frame = oldest.frame;
  result.T_odom_camera.covariance = covarianceOf(state_.first_step);
  if (settled_step_ < 0) {
    result.T_odom_camera.pose = oldest.estimate;
  } else {
    result.T_previous_camera = settled_.pose.inverse() * oldest.estimate;
    result.T_odom_camera.pose = settled_.pose * result.T_previous_camera;
    result.relative_covariance = relativeCovariance(oldest);
    result.drift_covariance = driftCovariance(oldest, result.relative_covariance);
  }
  settled_ = result.T_odom_camera;
  settled_in_window_ = windowCovarianceOf(state_.first_step);
  settled_step_ = state_.first_step;
  return result;
}

Matrix6d Filter::relativeCovariance(const PoseBlock& oldest) const {
  std::size_t place = 0;
  if (gain_valid_ && inFactor(state_.first_step, place) && place == 0) {
    covariance::Matrix12d joint = covariance::leftAndOldest(solver_, settled_in_window_, marginaliser_.departed());
    joint.topLeftCorner<6, 6>() += settled_apart_;
    return covariance::relative(settled_.pose, oldest.estimate, joint);
  }
  if (inFactor(state_.first_step - 1, place) && place + 1 < solver_.poses())
    return covariance::relative(settled_.pose, oldest.estimate, covariance::joint(solver_, place));
  return covariance::propagate(Pose(), Matrix6d::Zero(), oldest.u);
}

Matrix6d Filter::driftCovariance(const PoseBlock& oldest, const Matrix6d& relative) const {
  if (!gain_valid_ || !datum_.isActive()) return relative;
  const Matrix6d J = urban_nav_core::between(settled_.pose, oldest.estimate).J2 * gauge::ofPose(oldest.estimate, datum_.origin());
  return J * datum_.growth() * J.transpose() + least_drift * relative;
}

// Classic visual odometry: what the oldest frame said is lost, and the next pose becomes the datum.
void Filter::deleteOldest() {
  const Matrix6d covariance = covarianceOf(state_.first_step + 1);
  const std::int64_t leaving = state_.first_step;
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot) {
    LandmarkBlock& landmark = state_.landmarks[slot];
    if (!landmark.used || landmark.seen.empty() || landmark.seen.front().step != leaving) continue;
    landmark.seen.erase(landmark.seen.begin());
    if (!landmark.followed && landmark.seen.empty()) state_.remove(static_cast<int>(slot));
  }
  state_.poses.erase(state_.poses.begin());
  ++state_.first_step;
  prior_.start(state_.poses.front().estimate, inverse(covariance));
  gain_valid_ = false;
}

bool Filter::fixLandmark(const MapPoint& point) {
  if (state_.slotOf(point.landmark) >= 0 || !point.p_odom.allFinite()) return false;
  LandmarkBlock& landmark = state_.landmarks[static_cast<std::size_t>(state_.add(point.landmark))];
  landmark.known = true;
  has_known_ = true;
  gauge_free_ = false;
  datum_.giveUp();
  // An anchor at the origin that looks at the point.
  landmark.anchor.R_odom_anchor = lookingAlong(point.p_odom.head<3>());
  landmark.anchor.t_odom_anchor.setZero();
  landmark.estimate = landmark.linearised = Vector3d(0.0, 0.0, point.p_odom.w() / point.p_odom.head<3>().norm());
  return landmark.estimate.allFinite();
}

bool Filter::observe(const Observation& observation) {
  const int pose = state_.poseOf(observation.frame);
  if (pose < 0 || !observation.z.allFinite() || !observation.information.allFinite()) return false;
  Measurement measurement;
  measurement.step = state_.first_step + pose;
  measurement.z = observation.z;
  measurement.information = observation.information;
  measurement.wander = cost_.sensor().bearing(observation.wander);
  int slot = state_.slotOf(observation.landmark);
  if (slot < 0) {
    if (!hasFullRank(observation.information) || !isSane(cost_.sensor().invert(withoutOffset(observation.z)))) return false;
    slot = state_.add(observation.landmark);
    place(slot, measurement);
  }
  LandmarkBlock& landmark = state_.landmarks[static_cast<std::size_t>(slot)];
  auto at = landmark.seen.end();
  while (at != landmark.seen.begin() && std::prev(at)->step > measurement.step) --at;
  if (at != landmark.seen.begin() && std::prev(at)->step == measurement.step) return false;
  landmark.seen.insert(at, measurement);
  return true;
}

// Initial values are computed via stereo (section 2.2.1).
void Filter::place(int slot, const Measurement& first) {
  LandmarkBlock& landmark = state_.landmarks[static_cast<std::size_t>(slot)];
  const Pose& T_odom_camera = state_.poses[static_cast<std::size_t>(first.step - state_.first_step)].estimate;
  landmark.anchor.R_odom_anchor = T_odom_camera.R();
  landmark.anchor.t_odom_anchor = T_odom_camera.t();
  landmark.estimate = landmark.linearised = cost_.sensor().invert(withoutOffset(first.z));
}

Vector3d Filter::withoutOffset(const Vector3d& z) const { return {z.x(), z.y(), z.z() + state_.disparity_offset}; }

bool Filter::withdraw(LandmarkId id, FrameId frame) {
  const int slot = state_.slotOf(id);
  const int pose = state_.poseOf(frame);
  if (slot < 0 || pose < 0) return false;
  LandmarkBlock& landmark = state_.landmarks[static_cast<std::size_t>(slot)];
  const std::int64_t step = state_.first_step + pose;
  const auto at = std::find_if(landmark.seen.begin(), landmark.seen.end(), [&](const Measurement& m) { return m.step == step; });
  if (at == landmark.seen.end()) return false;
  landmark.seen.erase(at);
  // Nothing is left of it: the next measurement starts it anew.
  if (landmark.seen.empty() && landmark.prior < 0 && !landmark.known) state_.remove(slot);
  return true;
}

void Filter::setMeasurements(FrameId frame, const std::vector<Observation>& observations) {
  const int pose = state_.poseOf(frame);
  if (pose < 0) return;
  const std::int64_t step = state_.first_step + pose;
  for (LandmarkBlock& landmark : state_.landmarks) {
    if (!landmark.used) continue;
    const auto same = [&](const Measurement& measurement) { return measurement.step == step; };
    landmark.seen.erase(std::remove_if(landmark.seen.begin(), landmark.seen.end(), same), landmark.seen.end());
  }
  for (const Observation& observation : observations) observe(observation);
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state_.landmarks[slot];
    if (landmark.used && landmark.seen.empty() && landmark.prior < 0 && !landmark.known) state_.remove(static_cast<int>(slot));
  }
}

void Filter::save(Checkpoint& checkpoint) const {
  checkpoint.state = state_;
  checkpoint.prior = prior_;
  checkpoint.newest_covariance = newest_covariance_;
  checkpoint.datum = datum_;
}

void Filter::restore(const Checkpoint& checkpoint) {
  state_ = checkpoint.state;
  prior_ = checkpoint.prior;
  newest_covariance_ = checkpoint.newest_covariance;
  datum_ = checkpoint.datum;
  has_factor_ = false;
}

void Filter::publish(const Published& published) {
  settled_ = published.settled;
  settled_step_ = published.step;
}

void Filter::endLandmark(LandmarkId id) {
  const int slot = state_.slotOf(id);
  if (slot >= 0) state_.landmarks[static_cast<std::size_t>(slot)].followed = false;
}

// The newest pose alone, landmarks held, robustly: Gauss-Newton over everything then begins where residuals are of the size
// of their noise, so that its first factor has the right weights and can serve to the end.
void Filter::localiseNewest() {
  PoseBlock& newest = state_.poses.back();
  const std::int64_t step = state_.newestStep();
  const Matrix6d floor = process_model::floor() + newest.u.information;
  const Pose predicted = newest.estimate;
  SensorModel::Linearised at;
  Vector3d z;
  int known = 0;
  constexpr int most = 6;
  for (int i = 0; i < most; ++i) {
    const PoseMatrices pose(newest.estimate);
    const Eigen::Matrix3d R = predicted.R();
    Matrix6d lift = Matrix6d::Zero();
    lift.topLeftCorner<3, 3>() = lift.bottomRightCorner<3, 3>() = R;
    // The prediction with its information, in the axes of odom.
    Matrix6d A = lift * floor * lift.transpose();
    Vector6d b = -A * boxMinus(newest.estimate, predicted);
    known = 0;
    for (const LandmarkBlock& landmark : state_.landmarks) {
      if (!landmark.used || landmark.seen.empty() || landmark.seen.back().step != step) continue;
      if (landmark.seen.size() == 1 && landmark.prior < 0 && !landmark.known) continue;
      const Measurement& measurement = landmark.seen.back();
      if (!cost_.sensor().predict(landmark.anchor, landmark.estimate, pose, z)) continue;
      if (!cost_.sensor().linearise(landmark.anchor, landmark.estimate, pose, at)) continue;
      const Vector3d r = withoutOffset(measurement.z) - z;
      const double s = std::sqrt(r.dot(measurement.information * r));
      const double weight = options_.huber > 0.0 && s > options_.huber ? options_.huber / s : 1.0;
      const Eigen::Matrix<double, 3, 6> J = at.pose();
      const Eigen::Matrix<double, 6, 3> JW = weight * (J.transpose() * measurement.information);
      A.noalias() += JW * J;
      b.noalias() += JW * r;
      ++known;
    }
    if (known < 3) break;
    Vector6d d = b;
    if (!urban_nav_core::solvePositiveDefiniteInPlace(A, d) || !d.allFinite()) break;
    newest.estimate = boxPlus(newest.estimate, d);
    if (d.dot(b) < 1e-2) break;
  }
  if (known < 3 || !newest.estimate.isFinite()) newest.estimate = predicted;
  for (LandmarkBlock& landmark : state_.landmarks) {
    if (!landmark.used || landmark.known || landmark.prior >= 0 || landmark.seen.size() != 1 || landmark.seen.back().step != step) continue;
    place(state_.slotOf(landmark.id), landmark.seen.back());
  }
}

double Filter::gradients() {
  prior_.deviation(state_, prior_deviation_);
  prior_cost_ = prior_.gradient(prior_deviation_, state_.disparity_offset, prior_gradient_, prior_offset_gradient_);
  return prior_cost_;
}

void Filter::take(double scale) {
  state_.disparity_offset += scale * solver_.offsetStep();
  for (std::size_t j = 0; j < state_.poses.size(); ++j) {
    PoseBlock& pose = state_.poses[j];
    const Vector6d d = scale * solver_.poseStep(j);
    // The prior is quadratic in the chart around its centre: its pose moves in that chart.
    pose.estimate = j == 0 && prior_.has_pose ? boxPlus(prior_.pose_centre, boxMinus(pose.estimate, prior_.pose_centre) + d)
                                              : boxPlus(pose.estimate, d);
    pose.at_estimate = PoseMatrices(pose.estimate);
  }
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot) {
    LandmarkBlock& landmark = state_.landmarks[slot];
    if (landmark.used && !landmark.known) landmark.estimate += scale * solver_.landmarkStep(slot);
  }
}

// A landmark that nothing holds any more goes back to where one measurement puts it.
bool Filter::undoAbsurd() {
  bool any = false;
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot) {
    LandmarkBlock& landmark = state_.landmarks[slot];
    if (!landmark.used || landmark.known || isSane(landmark.estimate)) continue;
    landmark.estimate = landmark.linearised;
    any = true;
  }
  return any;
}

// Updating parameters (section 2.2.1): sparse robust Gauss-Newton over the window.
UpdateReport Filter::update() {
  UpdateReport result;
  if (options_.iterations > 1 && state_.poses.size() > 1) localiseNewest();
  double last = 0.0;
  bool refactor = true, current = false;  // current: the prior's gradient is that at the estimates
  for (int i = 0; i < options_.iterations; ++i) {
    cost_.relinearise(state_, prior_);
    if (!current) gradients();
    if (refactor) {
      cost_.build(state_, equations_);
      solver_.factor(state_, prior_, equations_, gauge_free_);
      has_factor_ = true;
      factor_step_ = state_.first_step;
    } else {
      cost_.buildGradient(state_, equations_);
    }
    solver_.solve(state_, prior_, equations_, prior_gradient_, prior_offset_gradient_);
    ++result.iterations;
    const double before = prior_cost_ + equations_.cost;
    take(1.0);
    current = false;
    if (options_.iterations > 1) {
      double scale = 1.0;
      for (int h = 0; h < halvings; ++h) {
        const double after = gradients() + cost_.value(state_);
        current = after <= before + cost_slack * (1.0 + std::abs(before));
        if (current) break;
        take(-0.5 * scale);
        scale *= 0.5;
      }
      if (undoAbsurd()) current = false;
    }
    const double decrement = solver_.decrement();
    if (decrement < options_.tolerance) {
      result.converged = true;
      break;
    }
    // The textbook's factor belongs to its last step; else a far start or slow progress ask for a new one.
    refactor = !options_.linearise_first || decrement > (i == 0 ? far_start : contraction * last);
    last = decrement;
  }
  if (!cost_.lineariseFirst()) prior_.recentre(state_);
  newest_covariance_ = covarianceOf(state_.newestStep());
  offset_sigma_ = std::sqrt(solver_.offsetVariance());
  const UpdateReport figures = report();
  result.observations = figures.observations;
  result.downweighted = figures.downweighted;
  result.dropped = figures.dropped;
  result.reprojection_px = figures.reprojection_px;
  result.landmarks = figures.landmarks;
  result.landmarks_in_prior = figures.landmarks_in_prior;
  return result;
}

UpdateReport Filter::report() const {
  UpdateReport result;
  const std::int64_t newest = state_.newestStep();
  const PoseMatrices pose(state_.poses.back().estimate);
  double squares = 0.0;
  int count = 0;
  Vector3d z;
  for (const LandmarkBlock& landmark : state_.landmarks) {
    if (!landmark.used) continue;
    if (!landmark.known) ++result.landmarks;
    if (landmark.prior >= 0) ++result.landmarks_in_prior;
    for (const Measurement& measurement : landmark.seen) {
      if (measurement.weight > 0.0) ++result.observations;
      else ++result.dropped;
      if (measurement.weight > 0.0 && measurement.weight < 0.5) ++result.downweighted;
      const bool in_left = measurement.information(0, 0) > 0.0;
      if (measurement.step != newest || !(measurement.weight > 0.0) || !in_left) continue;
      if (!cost_.sensor().predict(landmark.anchor, landmark.estimate, pose, z)) continue;
      squares += (measurement.z - z).head<2>().squaredNorm();
      ++count;
    }
  }
  result.reprojection_px = count > 0 ? std::sqrt(squares / count) : 0.0;
  return result;
}

bool Filter::inFactor(std::int64_t step, std::size_t& place) const {
  if (!has_factor_ || step < factor_step_) return false;
  place = static_cast<std::size_t>(step - factor_step_);
  return place < solver_.poses();
}

Matrix6d Filter::windowCovarianceOf(std::int64_t step) const {
  std::size_t place = 0;
  return inFactor(step, place) ? covariance::givenOffset(solver_, place) : newest_covariance_;
}

Matrix6d Filter::covarianceOf(std::int64_t step) const {
  std::size_t place = 0;
  if (!inFactor(step, place)) return newest_covariance_;
  return covariance::marginal(solver_, place) + datum_.carried(state_.poses[static_cast<std::size_t>(step - state_.first_step)].estimate);
}

UncertainPose Filter::newest() const { return {state_.poses.back().estimate, newest_covariance_}; }

void Filter::flush(std::vector<SettledPose>& settled) {
  while (!state_.poses.empty()) {
    settled.push_back(settle());
    gain_valid_ = false;
    state_.poses.erase(state_.poses.begin());
    ++state_.first_step;
  }
}

}  // namespace swf_vo
