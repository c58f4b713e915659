// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/swf_vo.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ablation.hpp"
#include "front_end/front_end.hpp"
#include "front_end/right_turn.hpp"
#include "health/corruption.hpp"
#include "health/health.hpp"
#include "health/image_check.hpp"
#include "health/row_check.hpp"
#include "motion/mean_choice.hpp"
#include "motion/propagation.hpp"
#include "motion/sensor_prediction.hpp"
#include "output.hpp"
#include "prediction.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"
#include "window/window.hpp"

namespace swf_vo {

using urban_nav_core::MotionInput;
using urban_nav_core::Pose;
using urban_nav_core::secondsBetween;
using urban_nav_core::StereoCamera;
using urban_nav_core::StereoPair;
using urban_nav_core::UserError;

namespace {

// The first pose is the origin by definition: sigma of a micrometre and a microradian.
constexpr double kOriginSigma = 1e-6;
// Frames are missing if more than this number of frame periods have passed.
constexpr double kGapPeriods = 1.7;
// After a gap of more periods than a landmark may be missed, the prediction is treated as after a phase without images.
constexpr double kLongGapPeriods = 3.5;
// Landmarks in the window per tracked feature: most live for a few frames, and the window has ten.
constexpr int kLandmarksPerFeature = 4;

constexpr const char* kStateName = "swf_vo";
constexpr std::uint32_t kStateVersion = 10;  // incremented with every change of the archived bytes

WindowOptions windowOptions(const Parameters& parameters, const StereoCamera& camera, const Ablation& ablation) {
  WindowOptions options;
  options.size = parameters.window;
  options.forget_by_deletion = ablation.delete_departed;
  options.linearise_first = !ablation.latest_jacobians;
  options.huber = parameters.huber;
  options.iterations = parameters.iterations;
  options.disparity_offset = parameters.disparity_offset;
  // Bounds the time per frame in live operation: withdrawn measurements are removed at the current estimates, without
  // repeating up to k steps.
  options.exact_undo = false;
  options.tolerance = 1e-3;
  options.rig_scale = 0.01 * parameters.rig_scale;
  options.robust_drift = parameters.robust_covariance;
  options.landmarks = kLandmarksPerFeature * featuresIn(camera, parameters.features);
  return options;
}

void check(const StereoCamera& camera) {
  const auto& left = camera.left;
  const bool finite =
      std::isfinite(left.fx) && std::isfinite(left.fy) && std::isfinite(left.cx) && std::isfinite(left.cy);
  if (!finite || left.fx <= 0.0 || left.fy <= 0.0)
    throw UserError("calibration", "focal lengths are not positive numbers", "fx, fy > 0 (px)");
  if (!std::isfinite(camera.baseline) || camera.baseline <= 0.0)
    throw UserError("calibration", "the baseline is not a positive number",
                    "> 0 (m): the right camera lies to the right of the left one");
  if (left.width < 64 || left.height < 64)
    throw UserError("calibration", "the images are smaller than 64x64", "at least 64x64 px");
}

/// Returns the standard deviation of a predicted translation, m.
double translationSigma(const ProcessInput& u) {
  return 1.0 / std::sqrt(std::max(1e-12, u.information.diagonal().head<3>().minCoeff()));
}

/// Returns whether the rotation of a step was measured by sensors with higher accuracy than images of other places
/// provide.
bool isTurnKnown(const std::optional<ProcessInput>& reckoned) {
  constexpr double kKnown = 0.05;  // rad
  return reckoned && reckoned->information.diagonal().tail<3>().minCoeff() > 1.0 / (kKnown * kKnown);
}

/// Returns whether a pose is inconsistent with the motion by sensors.
bool isFarFrom(const ProcessInput& reckoned, const Pose& T_from_to) {
  constexpr double kFar = 100.0;  // squared standard deviations
  const urban_nav_core::Vector6d e = urban_nav_core::boxMinus(T_from_to, reckoned.T_from_to);
  return e.dot(reckoned.information * e) > kFar;
}

/// Returns the prediction of a frame without tracked landmarks, with the rotation estimated from the whole image: with
/// blurred images the heading remains known.
ProcessInput turned(const ProcessInput& u, const Pose& last, const FrontEndResult& seen) {
  constexpr double kLeastSigma = 0.01, kSigmaPerAngle = 0.05;  // rad, rad/rad
  ProcessInput result = u;
  result.T_from_to = last.inverse() * seen.T_odom_turned;
  const double sigma = kLeastSigma + kSigmaPerAngle * angleBetween(Pose(), result.T_from_to);
  result.information.bottomRightCorner<3, 3>() += urban_nav_core::Matrix3d::Identity() / (sigma * sigma);
  return result;
}

/// Returns "name = value" of each setting as in stored states. Parts of an ablation were parameters in earlier
/// versions.
std::vector<std::string> storedSettings(const Parameters& parameters, const Ablation& ablation) {
  std::vector<std::string> settings;
  for (const urban_nav_core::RowInfo& row : table().rows()) {
    settings.push_back(row.name + " = " + urban_nav_core::printValue(table().get(parameters, row.name)));
    if (row.name == "window") {
      settings.emplace_back(ablation.delete_departed ? "forget = delete" : "forget = schur");
      settings.emplace_back(ablation.latest_jacobians ? "linearise = latest" : "linearise = first");
    } else if (row.name == "pixel_noise_floor") {
      settings.emplace_back(ablation.whole_pixels ? "subpixel = false" : "subpixel = true");
    }
  }
  return settings;
}

}  // namespace

/// Checks that a state was created with these parameters and this calibration. Throws UserError otherwise.
void checkCompatible(urban_nav_core::Archive& archive, const Parameters& parameters, const Ablation& ablation,
                     const StereoCamera& camera, const Pose& T_base_camera) {
  for (const std::string& now : storedSettings(parameters, ablation)) {
    std::string then = now;
    archive(then);
    if (then != now)
      throw UserError("state of swf_vo", "created with " + then + ", used with " + now + ": parameters must be equal",
                      "");
  }
  // Parameters that are now parameters of the input; their values have no effect here.
  for (std::string moved : {"motion_input = none", "wheel_noise = 0.05", "gyro_noise = 0.1"}) archive(moved);
  StereoCamera camera_then = camera;
  Pose T_then = T_base_camera;
  archive(camera_then, T_then);
  const bool same_place = T_then.q().coeffs() == T_base_camera.q().coeffs() && T_then.t() == T_base_camera.t();
  if (!isApprox(camera_then, camera, 0.0) || !same_place)
    throw UserError("state of swf_vo", "created with another calibration: camera and extrinsics must be equal", "");
}

/// Sequence of the processing steps of a frame.
class SwfVo::Implementation {
 public:
  Implementation(const Ablation& ablation, const Parameters& parameters, const StereoCamera& camera,
                 const Pose& T_base_camera)
      : ablation_(ablation),
        parameters_(parameters),
        camera_(camera),
        T_odom_first_camera_(T_base_camera),
        row_repair_(camera.left.width, camera.left.height),
        prediction_(parameters, T_base_camera),
        front_end_(parameters, camera, !ablation.whole_pixels),
        window_(windowOptions(parameters, camera, ablation), camera),
        health_(parameters),
        output_(T_base_camera) {}

  const Frame& process(const StereoPair& pair, const std::vector<MotionInput>& inputs) {
    if (started_ && pair.stamp <= stamp_) return output_.refused(pair.stamp);

    Evidence evidence;
    evidence.first = !started_;
    const urban_nav_core::StampNs before = stamp_;
    const double periods = updateFramePeriod(pair.stamp);
    evidence.gap = periods > kGapPeriods;
    const CorruptRowRepair::Repaired repaired = row_repair_.repair(pair);
    evidence.corrupted = repaired.corrupted;
    evidence.image = images_.check(repaired.pair, degraded_);
    const StereoPair usable =
        evidence.image.exchange ? StereoPair{pair.stamp, repaired.pair.right, repaired.pair.left} : repaired.pair;

    const Pose last = started_ ? window_.newest().pose : T_odom_first_camera_;
    const Predicted predicted = predict(before, pair.stamp, last, inputs);
    const bool is_gap_long = periods > kLongGapPeriods;
    const FrontEndResult* seen =
        evidence.image.usable ? &process(usable, last, predicted, is_gap_long, evidence) : nullptr;

    evidence.disparity_offset_px = started_ ? window_.disparityOffset() : 0.0;
    evidence.disparity_offset_sigma_px = started_ ? window_.disparityOffsetSigma() : 0.0;
    if (health_.isUnexplained(evidence)) checkRows(usable, seen != nullptr ? seen->row_offset_px : 0.0, evidence);
    else if (evidence.image.usable) rows_.reset();
    const bool trusted = health_.isTrusted(evidence);
    const bool blurred = evidence.image.reason == Reason::Blurred;
    // Tracks may be recovered after blurred images: the window is not restarted.
    const bool is_loose = started_ && trusted && isTrackingLost(*seen);
    const bool by_images = trusted && !is_loose;
    // Sensors do not contribute to steps measured by images, and are calibrated from them.
    const bool reckons =
        predicted.reckoned && (!by_images || evidence.gap || evidence.tracked < parameters_.degraded_features);
    ProcessInput u = reckons ? predicted.with_sensors : predicted.u;
    if (started_ && !trusted && seen != nullptr && seen->turned && !isTurnKnown(predicted.reckoned))
      u = turned(u, last, *seen);
    // After a long gap the prediction is too far off for the optimisation to converge: it starts at the pose by images.
    if (started_ && trusted && is_gap_long) u.T_from_start = last.inverse() * seen->T_odom_camera;
    takeStep(u, is_loose && !blurred ? seen : nullptr);
    sensors_.addFrame(frame_, seconds_, by_images, reckons);
    if (seen != nullptr && (trusted || !started_) && !(is_loose && blurred)) updateNewestKnown(*seen);
    if (seen != nullptr) observe(*seen, trusted);
    const UpdateReport update = window_.update();
    if (started_ && by_images && !reckons && window_.hasPose(frame_ - 1)) check(before, pair.stamp, predicted);

    if (started_) learn(last, trusted, blurred || !evidence.image.usable);
    const urban_nav_core::Status status = health_.judge(evidence);
    degraded_ = status.health != urban_nav_core::Health::Ok;
    started_ = true;
    const Frame& frame = output_.write(frame_++, pair.stamp, status, window_, u, seen, update);
    for (const Settled& settled : frame.settled) sensors_.learn(toMeasuredStep(settled));
    output_.setMotion(sensors_.estimates());
    dropLandmarks(window_.driftingLandmarks());
    return frame;
  }

  Propagation propagation() const {
    return Propagation(std::make_unique<Propagation::Implementation>(parameters_, T_odom_first_camera_, prediction_,
                                                                     sensors_, stamp_, window_.newest(),
                                                                     output_.newestVelocity()));
  }

  std::vector<Settled> flush() {
    std::vector<Settled> left;
    for (const SettledPose& pose : window_.flush()) left.push_back(output_.settle(pose));
    return left;
  }

  std::string state() {
    urban_nav_core::Archive archive;
    checkCompatible(archive, parameters_, ablation_, camera_, T_odom_first_camera_);
    this->archive(archive);
    return urban_nav_core::seal(kStateName, kStateVersion, archive.take());
  }

  void restore(std::string_view state) {
    urban_nav_core::Archive archive(urban_nav_core::unseal(kStateName, kStateVersion, state), "state of swf_vo");
    checkCompatible(archive, parameters_, ablation_, camera_, T_odom_first_camera_);
    this->archive(archive);
    archive.finish();
  }

  void archive(urban_nav_core::Archive& archive) {
    archive(started_, degraded_, frame_, newest_known_, stamp_, seconds_, period_);
    archive(images_, rows_, prediction_, sensors_, mean_choice_, front_end_, window_, health_);
    output_.archive(archive, window_);
    archive.require(!started_ || window_.poses() > 0, "the window is empty");
  }

 private:
  /// Measures the rows of a pair that cannot be matched along them. A turn of the right camera that they show is
  /// suggested for the next frame.
  void checkRows(const StereoPair& pair, double row_offset_px, Evidence& evidence) {
    RightTurn& right = front_end_.rightTurn();
    evidence.rows_disagree_px = rows_.measureSometimes(right.correct(pair), row_offset_px);
    right.suggest(rows_.matches(), row_offset_px);
  }

  /// Prediction of a step, before the images of its end are processed.
  struct Predicted {
    ProcessInput u;                        // at constant velocity, or with the mean by sensors
    Pose steady;                           // at constant velocity
    std::optional<ProcessInput> reckoned;  // motion by sensors only
    ProcessInput with_sensors;             // fusion of both
  };
  Predicted predict(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const Pose& last,
                    const std::vector<MotionInput>& inputs) {
    Predicted predicted;
    sensors_.add(inputs);
    if (!started_) return predicted;
    predicted.u = predicted.with_sensors = prediction_.step(seconds_, inputs);
    predicted.steady = predicted.u.T_from_to;
    predicted.reckoned = predictCamera(sensors_, from, to, last, T_odom_first_camera_);
    if (!predicted.reckoned) return predicted;
    predicted.with_sensors = fuse(predicted.u, predicted.reckoned->T_from_to, predicted.reckoned->information);
    predicted.u.T_from_to = mean_choice_.choose(predicted.steady, predicted.with_sensors.T_from_to);
    return predicted;
  }

  /// Compares the predictions of a step with the motion by images.
  void check(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const Predicted& predicted) {
    const Pose measured = window_.pose(frame_ - 1).inverse() * window_.newest().pose;
    sensors_.check(toMeasuredStep(from, to, measured, T_odom_first_camera_));
    if (predicted.reckoned) mean_choice_.see(predicted.steady, predicted.with_sensors.T_from_to, measured);
  }

  const FrontEndResult& process(const StereoPair& pair, const Pose& last, const Predicted& predicted, bool is_gap_long,
                                Evidence& evidence) {
    PredictionQuality quality;
    quality.astray = is_gap_long;
    quality.sigma_m = translationSigma(is_gap_long ? predicted.with_sensors : predicted.u);
    quality.seconds = seconds_;
    quality.is_turn_known = isTurnKnown(predicted.reckoned);
    const FrontEndResult& seen =
        front_end_.process(frame_, pair, last, last * predicted.with_sensors.T_from_to, window_.map(),
                           window_.disparityOffset(), quality, evidence.image.edges);
    evidence.localised = seen.localised;
    evidence.tracked = static_cast<int>(seen.tracked.size());
    evidence.features = evidence.tracked + static_cast<int>(seen.fresh.size());
    evidence.candidates = seen.candidates;
    evidence.inlier_share = seen.inlier_share;
    // After a gap a few matches may be consistent by chance.
    if (is_gap_long && predicted.reckoned && evidence.tracked < parameters_.degraded_features &&
        isFarFrom(*predicted.reckoned, last.inverse() * seen.T_odom_camera))
      evidence.localised = false;
    return seen;
  }

  // Updates the frame period; returns the step in units of it.
  double updateFramePeriod(urban_nav_core::StampNs stamp) {
    seconds_ = started_ ? secondsBetween(stamp_, stamp) : 0.0;
    stamp_ = stamp;
    const double periods = period_ > 0.0 ? seconds_ / period_ : 1.0;
    if (seconds_ > 0.0)
      period_ = period_ > 0.0 ? period_ + 0.1 * (std::min(seconds_, 2.0 * period_) - period_) : seconds_;
    return periods;
  }

  // Too few matches of landmarks from before the loss of frames; those few may be mismatches.
  bool isTrackingLost(const FrontEndResult& seen) const {
    const auto old = std::count_if(seen.tracked.begin(), seen.tracked.end(), [&](const Observation& observation) {
      return observation.landmark <= newest_known_;
    });
    return old < parameters_.lost_features;
  }

  void updateNewestKnown(const FrontEndResult& seen) {
    for (const auto* group : {&seen.tracked, &seen.fresh})
      for (const Observation& observation : *group) newest_known_ = std::max(newest_known_, observation.landmark);
  }

  // `after_loss`: result of the front end if only the prediction links it to the frames before the loss. If constrained
  // by the prediction only, the window would remain too uncertain to linearise; so it is restarted, with the
  // uncertainty of the prediction carried separately.
  void takeStep(const ProcessInput& u, const FrontEndResult* after_loss) {
    if (!started_) {
      window_.start(frame_, T_odom_first_camera_, urban_nav_core::Matrix6d::Identity() / (kOriginSigma * kOriginSigma));
    } else if (after_loss != nullptr) {
      // Landmarks start with this frame, at its pose by images.
      window_.restart(frame_, {window_.newest().pose.inverse() * after_loss->T_odom_camera, u.information});
    } else if (window_.map().empty()) {
      window_.restart(frame_, u);
    } else {
      window_.addPose(frame_, u);
      window_.removePoses();
    }
  }

  // Uses the current estimate of the previous pose, which may have changed, by a large amount after a phase without
  // images: with the former estimate the step would contain the whole error of dead reckoning.
  void learn(const Pose& last, bool trusted, bool blind) {
    const bool smoothed = window_.hasPose(frame_ - 1);
    const Pose from = smoothed ? window_.pose(frame_ - 1) : last;
    prediction_.learn(from.inverse() * window_.newest().pose, seconds_, trusted, blind, smoothed);
  }

  void dropLandmarks(const std::vector<LandmarkId>& landmarks) {
    for (const LandmarkId landmark : landmarks) {
      window_.withdrawAll(landmark);
      window_.endLandmark(landmark);
    }
  }

  void observe(const FrontEndResult& seen, bool trusted) {
    dropLandmarks(seen.refuted);
    for (const LandmarkId landmark : seen.ended) window_.endLandmark(landmark);
    if (trusted)
      for (const Observation& observation : seen.tracked) window_.observe(observation);
    for (const Observation& observation : seen.fresh) window_.observe(observation);
  }

  Ablation ablation_;
  Parameters parameters_;
  StereoCamera camera_;
  Pose T_odom_first_camera_;
  CorruptRowRepair row_repair_;
  ImageCheck images_;
  RowCheck rows_;
  Prediction prediction_;
  urban_nav_core::MotionSensors sensors_;
  MeanChoice mean_choice_;
  FrontEnd front_end_;
  Window window_;
  HealthMonitor health_;
  Output output_;

  bool started_ = false;
  bool degraded_ = true;
  FrameId frame_ = 0;
  LandmarkId newest_known_ = -1;  // newest landmark of the last frame linked to the first one by measurements
  urban_nav_core::StampNs stamp_ = 0;
  double seconds_ = 0.0;
  double period_ = 0.0;
};

SwfVo::SwfVo(const Parameters& parameters, const StereoCamera& camera, const Pose& T_base_camera)
    : SwfVo(Ablation(), parameters, camera, T_base_camera) {}
SwfVo::SwfVo(const Parameters& parameters, const StereoCamera& camera, const Pose& T_base_camera,
             std::string_view state)
    : SwfVo(Ablation(), parameters, camera, T_base_camera, state) {}
SwfVo::SwfVo(const Ablation& ablation, const Parameters& parameters, const StereoCamera& camera,
             const Pose& T_base_camera) {
  check(camera);
  implementation_ = std::make_unique<Implementation>(ablation, parameters, camera, T_base_camera);
}
SwfVo::SwfVo(const Ablation& ablation, const Parameters& parameters, const StereoCamera& camera,
             const Pose& T_base_camera, std::string_view state)
    : SwfVo(ablation, parameters, camera, T_base_camera) {
  implementation_->restore(state);
}
SwfVo::~SwfVo() = default;
SwfVo::SwfVo(SwfVo&&) noexcept = default;
SwfVo& SwfVo::operator=(SwfVo&&) noexcept = default;

const Frame& SwfVo::process(const StereoPair& pair, const std::vector<MotionInput>& inputs) {
  return implementation_->process(pair, inputs);
}
Propagation SwfVo::propagation() const { return implementation_->propagation(); }
std::vector<Settled> SwfVo::flush() { return implementation_->flush(); }
std::string SwfVo::state() const { return implementation_->state(); }

}  // namespace swf_vo
