// SPDX-License-Identifier: BSD-3-Clause
#include "window/filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "window/gauge.hpp"
#include "window/measurements.hpp"
#include "window/pose_only_optimisation.hpp"

namespace swf_vo {

using Eigen::Vector3d;
using urban_nav_core::ConsideredConstants;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::Vector6d;

namespace {

// Standard deviation of the first pose of the window, m and rad.
constexpr double kDatumSigma = 1e-6;
// Names of the constants of the rig (ConsideredConstant).
constexpr const char* kDisparityConstant = "disparity";
constexpr const char* kScaleConstant = "scale";
// Radians: a fifth of the error of a good match in an image of 500 px.
constexpr double kLeastTemplateDrift = 5e-5;
// Minimum share of drift in a step's covariance, so that it is positive definite without drift: that of one step in a
// thousand.
constexpr double kLeastDrift = 1e-3;

Matrix6d inverse(Matrix6d A) {
  Matrix6d B = Matrix6d::Identity();
  urban_nav_core::solvePositiveDefiniteInPlace(A, B);
  return B;
}

}  // namespace

Filter::Filter(const WindowOptions& options, const urban_nav_core::StereoCamera& camera)
    : options_(options), cost_(SensorModel(camera), options.huber, options.linearise_first), gauss_newton_(options) {
  state_.disparity_offset = camera.disparity_offset;
  state_.reserve(static_cast<std::size_t>(std::max(options.landmarks, 0)));
  scores_.reserve(state_.landmarks.size());
}

std::size_t Filter::limit() const {
  return static_cast<std::size_t>(std::max(1, options_.size)) + (options_.forget_by_deletion ? 1U : 0U);
}

void Filter::start(FrameId frame, const Pose& T_odom_camera, const Matrix6d& information) {
  PoseBlock pose;
  pose.frame = frame;
  pose.estimate = pose.linearised = T_odom_camera;
  state_.poses.reserve(std::min<std::size_t>(limit(), 256) + 1);
  state_.poses.push_back(pose);
  prior_.start(T_odom_camera, information);
  prior_.startOffset(state_.disparity_offset, options_.disparity_offset);
  offset_ = {state_.disparity_offset, state_.disparity_offset, options_.disparity_offset * options_.disparity_offset};
  datum_.setOffset(offset_);
  datum_.setRigScale(options_.rig_scale);
  Matrix6d root = information;
  gauge_free_ = !has_known_ && !urban_nav_core::choleskyInPlace(root);
  datum_.start(prior_);
  if (has_known_ || !options_.linearise_first || options_.forget_by_deletion) datum_.disable();
  newest_covariance_ = inverse(information + process_model::floor());
}

// Adds a pose (section 2.2.1).
void Filter::addPose(FrameId frame, const ProcessInput& u) {
  const PoseBlock& last = state_.poses.back();
  newest_covariance_ = covariance::propagate(last.estimate, newest_covariance_, u);
  PoseBlock pose;
  pose.frame = frame;
  pose.u = u;
  pose.estimate = pose.linearised = process_model::makeStart(last.estimate, u);
  state_.poses.push_back(pose);
}

void Filter::restart(FrameId frame, const ProcessInput& u, std::vector<SettledPose>& settled) {
  const Pose& last = state_.poses.back().estimate;
  const PoseWithCovariance next{process_model::predict(last, u), covariance::propagate(last, newest_covariance_, u)};
  // Information on the disparity offset with all other states marginalised.
  const double information = prior_.has_offset ? gauss_newton_.solver().offsetInformation() : 0.0,
               offset = state_.disparity_offset;
  flush(settled);
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot)
    if (state_.landmarks[slot].used && !state_.landmarks[slot].known) state_.remove(static_cast<int>(slot));
  PoseBlock pose;
  pose.frame = frame;
  pose.u = u;
  pose.estimate = pose.linearised = next.pose;
  state_.poses.push_back(pose);
  newest_covariance_ = next.covariance;
  gauss_newton_.forget();
  oldest_information_.reset();
  gain_valid_ = false;
  scores_.clear();
  if (datum_.isActive()) {
    prior_.start(next.pose, Matrix6d::Identity() / (kDatumSigma * kDatumSigma));
    datum_.start(prior_, next.covariance);
  } else {
    prior_.start(next.pose, inverse(next.covariance));
  }
  prior_.offset_information = information;
  prior_.offset_eta = information * offset - gauss_newton_.solver().offsetPull(prior_, offset);
}

// Marginalises poses and landmarks (section 2.2.1).
void Filter::removePoses(std::vector<SettledPose>& settled, History* history) {
  while (state_.poses.size() > limit()) removeOldest(settled, history);
  for (std::size_t slot = 0; slot < state_.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state_.landmarks[slot];
    if (landmark.used && !landmark.followed && landmark.prior < 0 && landmark.seen.empty())
      state_.remove(static_cast<int>(slot));
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
  const Pose leaving = state_.poses[0].linearised, next = state_.poses[1].linearised;
  marginaliser_.removeOldest(state_, prior_, cost_, origin, history, datum_.isActive() ? &scores_ : nullptr);
  gain_valid_ = true;
  settled_apart_.setZero();
  if (!datum_.isActive()) return;
  datum_.moveTo(origin);
  applyProcessNoise(origin);
  Departed& departed = marginaliser_.departed();
  datum_.marginalised(departed.gauge_loss);
  scores_.end(marginaliser_.dying(), leaving);
  scores_.advance(state_, leaving.inverse() * next);
  if (options_.robust_drift) datum_.scaleGrowth(scores_.sandwich().ratio());
  const Vector6d per_px = datum_.releaseOffset(state_, prior_);
  departed.offset_gain += (departed.gauge_gain - left) * per_px;
  const std::optional<Matrix6d> own = std::exchange(oldest_information_, std::nullopt);
  if (!own || !datum_.fixGauge(*own, options_.datum_ratio, state_, prior_)) return;
  // The marginalised pose moves with the window by its gain, not exactly as a rigid part of it: the remainder is added
  // to the step.
  const Matrix6d gain = departed.gauge_gain, slack = gain - left;
  settled_in_window_ -= gain * datum_.shift() * gain.transpose();
  settled_apart_ = slack * datum_.shift() * slack.transpose();
}

// Small steps are accumulated: each landmark costs a pass over the prior.
void Filter::applyProcessNoise(const Vector3d& origin) {
  drifted_.clear();
  for (LandmarkBlock& landmark : state_.landmarks) {
    if (!landmark.used || landmark.prior < 0) continue;
    if (!landmark.seen.empty()) {
      landmark.template_drift_covariance += landmark.seen.front().template_drift_covariance;
      scores_.age(static_cast<std::size_t>(&landmark - state_.landmarks.data()),
                  landmark.seen.front().template_drift_covariance);
      landmark.seen.front().template_drift_covariance.setZero();
    }
    if (landmark.template_drift_covariance.trace() < kLeastTemplateDrift * kLeastTemplateDrift) continue;
    drifted_.push_back({landmark.prior, landmark.template_drift_covariance});
    landmark.template_drift_covariance.setZero();
  }
  if (drifted_.empty()) return;
  gauge::ofPrior(state_, prior_, origin, directions_);
  process_noise_.apply(drifted_, directions_, prior_, marginaliser_.departed());
}

SettledPose Filter::settle() {
  const PoseBlock& oldest = state_.poses.front();
  SettledPose result;
  result.frame = oldest.frame;
  result.T_odom_camera.covariance = computeCovariance(state_.first_step);
  if (settled_step_ < 0) {
    result.T_odom_camera.pose = oldest.estimate;
  } else {
    result.T_previous_camera = settled_.pose.inverse() * oldest.estimate;
    result.T_odom_camera.pose = settled_.pose * result.T_previous_camera;
    result.relative_covariance = relativeCovariance(oldest);
    result.drift_covariance = driftCovariance(oldest, result.relative_covariance);
    result.constants = constants(oldest, result.T_previous_camera);
  }
  settled_ = result.T_odom_camera;
  settled_in_window_ = computeWindowCovariance(state_.first_step);
  settled_step_ = state_.first_step;
  return result;
}

Matrix6d Filter::relativeCovariance(const PoseBlock& oldest) const {
  std::size_t place = 0;
  if (gain_valid_ && gauss_newton_.inFactor(state_.first_step, place) && place == 0) {
    covariance::Matrix12d joint = covariance::leftAndOldest(gauss_newton_.solver(), settled_in_window_,
                                                            marginaliser_.departed(), offset_.error());
    joint.topLeftCorner<6, 6>() += settled_apart_;
    return covariance::relative(settled_.pose, oldest.estimate, joint);
  }
  if (gauss_newton_.inFactor(state_.first_step - 1, place) && place + 1 < gauss_newton_.solver().poses())
    return covariance::relative(settled_.pose, oldest.estimate,
                                covariance::joint(gauss_newton_.solver(), place, offset_.error()));
  return covariance::propagate(Pose(), Matrix6d::Zero(), oldest.u);
}

Matrix6d Filter::driftCovariance(const PoseBlock& oldest, const Matrix6d& relative) const {
  if (!gain_valid_ || !datum_.isActive()) return relative;
  const Matrix6d J =
      urban_nav_core::between(settled_.pose, oldest.estimate).J2 * gauge::ofPose(oldest.estimate, datum_.origin());
  return J * datum_.growth() * J.transpose() + kLeastDrift * relative;
}

// The offset displaces the window as a whole by releaseOffset(); the rig's scale is proportional to each step.
ConsideredConstants Filter::constants(const PoseBlock& oldest, const Pose& T_previous_camera) const {
  ConsideredConstants constants;
  if (gain_valid_ && datum_.isActive() && datum_.release()) {
    const Matrix6d J =
        urban_nav_core::between(settled_.pose, oldest.estimate).J2 * gauge::ofPose(oldest.estimate, datum_.origin());
    constants.push_back({kDisparityConstant, datum_.release()->used, offset_.mean, std::sqrt(offset_.variance),
                         J * datum_.release()->per_px});
  }
  if (options_.rig_scale > 0.0) {
    constants.push_back({kScaleConstant, 0.0, 0.0, options_.rig_scale, Vector6d::Zero()});
    constants.back().sensitivity.head<3>() = T_previous_camera.t();
  }
  return constants;
}

// Classic visual odometry: the information of the oldest frame is dropped, and the next pose becomes the datum.
void Filter::deleteOldest() {
  const Matrix6d covariance = computeCovariance(state_.first_step + 1);
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
  if (!measurements::fixLandmark(state_, point)) return false;
  has_known_ = true;
  gauge_free_ = false;
  datum_.disable();
  return true;
}

bool Filter::observe(const Observation& observation) {
  return measurements::observe(state_, cost_.sensor(), observation);
}

bool Filter::withdraw(LandmarkId landmark, FrameId frame) { return measurements::withdraw(state_, landmark, frame); }

void Filter::setMeasurements(FrameId frame, const std::vector<Observation>& observations) {
  measurements::replace(state_, cost_.sensor(), frame, observations);
}

void Filter::save(Checkpoint& checkpoint) const {
  checkpoint.state = state_;
  checkpoint.prior = prior_;
  checkpoint.newest_covariance = newest_covariance_;
  checkpoint.datum = datum_;
  checkpoint.scores = scores_;
  checkpoint.offset = offset_;
  checkpoint.oldest_information = oldest_information_;
}

void Filter::restore(const Checkpoint& checkpoint) {
  state_ = checkpoint.state;
  prior_ = checkpoint.prior;
  newest_covariance_ = checkpoint.newest_covariance;
  datum_ = checkpoint.datum;
  scores_ = checkpoint.scores;
  offset_ = checkpoint.offset;
  oldest_information_ = checkpoint.oldest_information;
  gauss_newton_.forget();
}

void Filter::publish(const Published& published) {
  settled_ = published.settled;
  settled_step_ = published.step;
}

void Filter::endLandmark(LandmarkId id) {
  const int slot = state_.findSlot(id);
  if (slot >= 0) state_.landmarks[static_cast<std::size_t>(slot)].followed = false;
}

// Updates the parameters (section 2.2.1).
UpdateReport Filter::update() {
  if (options_.iterations > 1 && state_.poses.size() > 1) optimiseNewestPose(state_, cost_.sensor(), options_.huber);
  const GaussNewton::Progress progress = gauss_newton_.run(state_, prior_, cost_, gauge_free_);
  offset_ = estimateOffset();
  datum_.setOffset(offset_);
  newest_covariance_ = computeCovariance(state_.newestStep());
  oldest_information_ = gauss_newton_.ownInformation(0);
  UpdateReport result = report(state_, cost_.sensor());
  result.iterations = progress.iterations;
  result.converged = progress.converged;
  return result;
}

// The estimate uses the measurements' information divided by Solver::offsetCaution(), whereas its covariance uses the
// ratio by their residuals. With I the information, c that of the calibration and rho the ratio, the true offset has
// precision c + I / rho, and its mean is where the gradient vanishes: at the estimate, that of the measurements is
// caution c (o - calibrated).
DisparityOffsetEstimate Filter::estimateOffset() const {
  const Solver& solver = gauss_newton_.solver();
  DisparityOffsetEstimate estimate;
  estimate.used = estimate.mean = state_.disparity_offset;
  estimate.variance = solver.offsetVariance();
  if (!options_.robust_drift || !prior_.has_offset || !datum_.isActive() || !(estimate.variance > 0.0)) return estimate;
  const double ratio = scores_.ofOffset().ratio(solver.offsetCaution()),
               calibration = prior_.calibrationInformation(estimate.used),
               precision = calibration + solver.offsetInformation() / ratio,
               pull = (solver.offsetCaution() / ratio - 1.0) * calibration * (estimate.used - prior_.calibrated_offset);
  estimate.variance = 1.0 / precision;
  estimate.mean += pull / precision;
  return estimate;
}

Matrix6d Filter::computeWindowCovariance(std::int64_t step) const {
  std::size_t place = 0;
  return gauss_newton_.inFactor(step, place) ? covariance::givenOffset(gauss_newton_.solver(), place)
                                             : newest_covariance_;
}

Matrix6d Filter::computeCovariance(std::int64_t step) const {
  std::size_t place = 0;
  if (!gauss_newton_.inFactor(step, place)) return newest_covariance_;
  return covariance::marginal(gauss_newton_.solver(), place, offset_.error()) +
         datum_.carried(state_.poses[static_cast<std::size_t>(step - state_.first_step)].linearised);
}

PoseWithCovariance Filter::newest() const { return {state_.poses.back().estimate, newest_covariance_}; }

void Filter::flush(std::vector<SettledPose>& settled) {
  while (!state_.poses.empty()) {
    settled.push_back(settle());
    gain_valid_ = false;
    state_.poses.erase(state_.poses.begin());
    ++state_.first_step;
  }
}

void Filter::archive(urban_nav_core::Archive& archive) {
  archive(state_, prior_, gauss_newton_, marginaliser_.departed(), datum_, scores_);
  archive(offset_.used, offset_.mean, offset_.variance, newest_covariance_, settled_, settled_step_, settled_in_window_,
          gain_valid_, settled_apart_);
  archive(oldest_information_, has_known_, gauge_free_);
  if (archive.isReading()) check(archive);
}

// Checks the consistency of the parts.
void Filter::check(const urban_nav_core::Archive& archive) const {
  archive.require(!prior_.has_pose || !state_.poses.empty(), "prior without a pose");
  archive.require(!gain_valid_ || marginaliser_.departed().gain.size() / 6 <= gauss_newton_.solver().rows(),
                  "invalid gain size");
  std::size_t tied = 0;
  for (const LandmarkBlock& landmark : state_.landmarks) {
    const auto place = static_cast<std::size_t>(landmark.prior);
    archive.require(landmark.prior < 0 || (landmark.used && !landmark.known && place < prior_.slots.size()),
                    "landmark is not in the prior");
    tied += landmark.prior < 0 ? 0 : 1;
  }
  archive.require(tied == prior_.slots.size(), "duplicate landmark in the prior");
  for (std::size_t i = 0; i < prior_.slots.size(); ++i) {
    const auto slot = static_cast<std::size_t>(prior_.slots[i]);
    archive.require(slot < state_.landmarks.size() && state_.landmarks[slot].prior == static_cast<int>(i),
                    "landmark is not in the prior");
  }
}

}  // namespace swf_vo
