// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/right_turn.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swf_vo {

using Eigen::Vector3d;
using urban_nav_core::ChangeDetector;
using urban_nav_core::ConstantMeasurement;
using urban_nav_core::StampNs;
using urban_nav_core::StereoPair;

namespace {

// Steps of one frame that are tested by themselves, standard deviations; the images decide (FrontEnd). A knock enlarges
// the scatter from which the standard deviation of its disparity step is computed, so at most the usual one of the
// session is used.
constexpr double kLargeStep = 3.0, kLargeRowStep = 6.0;
constexpr double kUsualSteps = 64.0;  // frames over which standard deviations are averaged
// As in the test of trust (docs/derivations/trust.md): the sum of n steps of neighbouring frames, which share
// landmarks, has this many times the variance of independent ones; all landmarks of a frame share errors of this size;
// an alarm is false once in so many hours of frames; until the landmarks are renewed steps are not independent of a
// change.
constexpr double kSharedLandmarks = 3.0, kStepFloorPx = 0.02;
constexpr double kFalseAlarm = 1e-5;
constexpr std::int64_t kFramesPerHour = 20 * 3600;
constexpr StampNs kLandmarkRenewal = 3'000'000'000;
constexpr std::size_t kRecentSteps = 256;
constexpr double kLargestTurn = M_PI;  // rad, of a rotation vector

ConstantMeasurement toMeasurement(const DisparityStep& step, StampNs stamp) {
  return {{stamp, stamp}, step.px, std::sqrt(kSharedLandmarks) * std::hypot(step.sigma_px, kStepFloorPx)};
}

}  // namespace

RightTurn::RightTurn(const urban_nav_core::StereoCamera& camera)
    : camera_(camera), fx_(camera.left.fx), right_(camera), detector_(kFalseAlarm, kFramesPerHour, kRecentSteps) {}

StereoPair RightTurn::correct(const StereoPair& pair) {
  StereoPair corrected = pair;
  corrected.right = right_.correct(pair.right, pixels_);
  return corrected;
}

bool RightTurn::isLarge(const RowStep& rows) const {
  if (!(rows.sigma.minCoeff() > 0.0)) return false;
  const double floor = kStepFloorPx / fx_;
  return (rows.turn.cwiseAbs().array() >
          kLargeRowStep * (kSharedLandmarks * rows.sigma.array().square() + floor * floor).sqrt())
      .any();
}

void RightTurn::suggest(const std::vector<RowMatch>& matches, double row_offset_px) {
  if (usual_sigma_ < 0.0) return;
  DisparityStepMeter meter;
  const RowStep rows = meter.measureRows(camera_, matches, row_offset_px);
  if (isLarge(rows)) suggested_ = turn() + Vector3d(rows.turn.x(), 0.0, rows.turn.y());
}

std::optional<Vector3d> RightTurn::propose(const RigStep& step, StampNs stamp) {
  if (suggested_) return *std::exchange(suggested_, std::nullopt);
  if (!(step.disparity.sigma_px > 0.0) || usual_sigma_ < 0.0) return std::nullopt;
  const ConstantMeasurement measured = toMeasurement(step.disparity, stamp);
  const double sigma =
      toMeasurement({step.disparity.px, std::min(step.disparity.sigma_px, step_sigma_px_)}, stamp).sigma;
  const double excess = std::abs(measured.value - usual_px_);
  if (excess > kLargeStep * std::hypot(sigma, usual_sigma_) || isLarge(step.rows)) return refine(step);
  if (!detector_.wouldAlarm(measured)) return std::nullopt;
  ChangeDetector detector = detector_;
  detector.add(measured);
  const std::vector<ChangeDetector::Segment> segments = detector.segments();
  if (segments.size() < 2) return std::nullopt;
  Vector3d proposed = turn();
  proposed.y() += (segments.back().mean - segments[segments.size() - 2].mean) / fx_;
  return proposed;
}

Vector3d RightTurn::refine(const RigStep& step) const {
  Vector3d proposed = turn();
  if (step.disparity.sigma_px > 0.0) proposed.y() += (step.disparity.px - usual_px_) / fx_;
  if (isLarge(step.rows)) proposed += Vector3d(step.rows.turn.x(), 0.0, step.rows.turn.y());
  return proposed;
}

DisparityStep RightTurn::add(const DisparityStep& step, StampNs stamp) {
  if (turn() != final_turn_) {
    changed_px_ += fx_ * (turn().y() - final_turn_.y());
    final_turn_ = turn();
    renewed_ = stamp + kLandmarkRenewal;
    detector_ = ChangeDetector(kFalseAlarm, kFramesPerHour, kRecentSteps);
  }
  if (stamp >= renewed_) changed_px_ = 0.0;
  if (!(step.sigma_px > 0.0)) return step;
  if (stamp >= renewed_) {
    // Without an answer to an alarm the change is in the usual step from now on.
    if (detector_.add(toMeasurement(step, stamp)))
      detector_ = ChangeDetector(kFalseAlarm, kFramesPerHour, kRecentSteps);
    step_sigma_px_ += (step.sigma_px - step_sigma_px_) / std::min(++step_sigmas_, kUsualSteps);
    if (detector_.measurements() > 0) {
      usual_px_ = detector_.mean();
      usual_sigma_ = detector_.meanSigma();
    }
  }
  DisparityStep relative = step;
  relative.px += changed_px_;
  return relative;
}

void RightTurn::archive(urban_nav_core::Archive& archive) {
  Vector3d turn = right_.turn();
  archive(turn, detector_, usual_px_, usual_sigma_, suggested_, step_sigma_px_, step_sigmas_, final_turn_, changed_px_,
          renewed_);
  archive.require(turn.norm() < kLargestTurn, "the turn of the right camera is not plausible");
  right_.set(turn);
}

}  // namespace swf_vo
