// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/swf_vo.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ablation.hpp"
#include "front_end/front_end.hpp"
#include "health/corruption.hpp"
#include "health/health.hpp"
#include "health/image_check.hpp"
#include "health/row_check.hpp"
#include "motion/mean_choice.hpp"
#include "motion/motion_sensors.hpp"
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

// The first pose is the origin by definition: held to a micrometre and a microradian.
constexpr double kOriginSigma = 1e-6;
// More than this many usual periods between two frames: something is missing.
constexpr double kGapPeriods = 1.7;
// After more frames than a landmark may be missed in, as many are missing as a spell of darkness has.
constexpr double kAstrayPeriods = 3.5;
// Landmarks in the window for each that is followed: most live for a few frames, and the window for ten.
constexpr int kLandmarksPerFeature = 4;

constexpr const char* kStateName = "swf_vo";
constexpr std::uint32_t kStateVersion = 9;  // one more whenever what is archived becomes other bytes

WindowOptions windowOptions(const Parameters& parameters, const StereoCamera& camera, const Ablation& ablation) {
  WindowOptions options;
  options.size = parameters.window;
  options.forget_by_deletion = ablation.delete_departed;
  options.linearise_first = !ablation.latest_jacobians;
  options.huber = parameters.huber;
  options.iterations = parameters.iterations;
  options.disparity_offset = parameters.disparity_offset;
  // Live, a frame must end within its period: what is refuted goes out at the estimates of now instead of by taking up
  // to k steps again.
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

/// Returns whether sensors measured the rotation of a step better than images of other places do.
bool isTurnKnown(const std::optional<ProcessInput>& reckoned) {
  constexpr double kKnown = 0.05;  // rad
  return reckoned && reckoned->information.diagonal().tail<3>().minCoeff() > 1.0 / (kKnown * kKnown);
}

/// Returns whether a pose is where sensors cannot have brought the camera.
bool isFarFrom(const ProcessInput& reckoned, const Pose& T_from_to) {
  constexpr double kFar = 100.0;  // squared standard deviations
  const urban_nav_core::Vector6d e = urban_nav_core::boxMinus(T_from_to, reckoned.T_from_to);
  return e.dot(reckoned.information * e) > kFar;
}

/// Returns the prediction of a frame in which no landmark was found, turned as its image as a whole shows: where only
/// blur hides the landmarks, the heading stays known.
ProcessInput turned(const ProcessInput& u, const Pose& last, const FrontEndResult& seen) {
  constexpr double kLeastSigma = 0.01, kSigmaPerAngle = 0.05;  // rad, rad/rad
  ProcessInput result = u;
  result.T_from_to = last.inverse() * seen.T_odom_turned;
  const double sigma = kLeastSigma + kSigmaPerAngle * angleBetween(Pose(), result.T_from_to);
  result.information.bottomRightCorner<3, 3>() += urban_nav_core::Matrix3d::Identity() / (sigma * sigma);
  return result;
}

/// Returns "name = value" of each setting, as stored states have them: parts of an ablation were parameters when these
/// began.
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

/// A state is of use with the parameters and the calibration that it was made with, and no others.
void agree(urban_nav_core::Archive& archive, const Parameters& parameters, const Ablation& ablation,
           const StereoCamera& camera, const Pose& T_base_camera) {
  for (const std::string& now : storedSettings(parameters, ablation)) {
    std::string then = now;
    archive(then);
    if (then != now)
      throw UserError("state of swf_vo", "was made with " + then + " and is to go on with " + now,
                      "the same parameters");
  }
  // Parameters that the input has now; what they were does not matter to a filter that goes on.
  for (std::string moved : {"motion_input = none", "wheel_noise = 0.05", "gyro_noise = 0.1"}) archive(moved);
  StereoCamera camera_then = camera;
  Pose T_then = T_base_camera;
  archive(camera_then, T_then);
  const bool same_place = T_then.q().coeffs() == T_base_camera.q().coeffs() && T_then.t() == T_base_camera.t();
  if (!isApprox(camera_then, camera, 0.0) || !same_place)
    throw UserError("state of swf_vo", "was made with another calibration", "the same camera and extrinsics");
}

/// The story of one frame; no algorithm.
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
        sensors_(T_base_camera),
        front_end_(parameters, camera, !ablation.whole_pixels),
        window_(windowOptions(parameters, camera, ablation), camera),
        health_(parameters),
        output_(T_base_camera) {}

  const Frame& process(const StereoPair& pair, const std::vector<MotionInput>& inputs) {
    if (started_ && pair.stamp <= stamp_) return output_.refused(pair.stamp);

    Evidence evidence;
    evidence.first = !started_;
    const urban_nav_core::StampNs before = stamp_;
    const double periods = takeTime(pair.stamp);
    evidence.gap = periods > kGapPeriods;
    const CorruptRowRepair::Repaired repaired = row_repair_.repair(pair);
    evidence.corrupted = repaired.corrupted;
    evidence.image = images_.look(repaired.pair, doubtful_);
    const StereoPair usable =
        evidence.image.exchange ? StereoPair{pair.stamp, repaired.pair.right, repaired.pair.left} : repaired.pair;

    const Pose last = started_ ? window_.newest().pose : T_odom_first_camera_;
    const Predicted predicted = predict(before, pair.stamp, last, inputs);
    const bool is_gap_long = periods > kAstrayPeriods;
    const FrontEndResult* seen =
        evidence.image.usable ? &process(usable, last, predicted, is_gap_long, evidence) : nullptr;

    evidence.disparity_offset_px = started_ ? window_.disparityOffset() : 0.0;
    evidence.disparity_offset_sigma_px = started_ ? window_.disparityOffsetSigma() : 0.0;
    if (health_.isUnexplained(evidence))
      evidence.rows_disagree_px = rows_.measureSometimes(usable, seen != nullptr ? seen->row_offset_px : 0.0);
    const bool trusted = health_.isTrusted(evidence);
    const bool blurred = evidence.image.reason == Reason::Blurred;
    // As long as all is blurred, what was known before may come back any frame: nothing begins anew.
    const bool is_loose = started_ && trusted && isAdrift(*seen);
    const bool by_images = trusted && !is_loose;
    // Sensors have no part in a step that images measure, and learn from it.
    const bool reckons =
        predicted.reckoned && (!by_images || evidence.gap || evidence.tracked < parameters_.degraded_features);
    ProcessInput u = reckons ? predicted.with_sensors : predicted.u;
    if (started_ && !trusted && seen != nullptr && seen->turned && !isTurnKnown(predicted.reckoned))
      u = turned(u, last, *seen);
    // Too long a time to predict over: from metres away no residual would lead to where the images say.
    if (started_ && trusted && is_gap_long) u.T_from_start = last.inverse() * seen->T_odom_camera;
    takeStep(u, is_loose && !blurred ? seen : nullptr);
    sensors_.addFrame(frame_, seconds_, by_images, reckons);
    if (seen != nullptr && (trusted || !started_) && !(is_loose && blurred)) remember(*seen);
    if (seen != nullptr) observe(*seen, trusted);
    const UpdateReport update = window_.update();
    if (started_ && by_images && !reckons && window_.hasPose(frame_ - 1)) check(before, pair.stamp, predicted);

    if (started_) learn(last, trusted, blurred || !evidence.image.usable);
    const urban_nav_core::Status status = health_.judge(evidence);
    doubtful_ = status.health != urban_nav_core::Health::Ok;
    started_ = true;
    const Frame& frame = output_.write(frame_++, pair.stamp, status, window_, u, seen, update);
    for (const Settled& settled : frame.settled) sensors_.learn(settled);
    output_.setMotion(sensors_.estimates());
    giveUp(window_.driftingLandmarks());
    return frame;
  }

  std::vector<Settled> flush() {
    std::vector<Settled> left;
    for (const SettledPose& pose : window_.flush()) left.push_back(output_.settle(pose));
    return left;
  }

  std::string state() {
    urban_nav_core::Archive archive;
    agree(archive, parameters_, ablation_, camera_, T_odom_first_camera_);
    this->archive(archive);
    return urban_nav_core::seal(kStateName, kStateVersion, archive.take());
  }

  void restore(std::string_view state) {
    urban_nav_core::Archive archive(urban_nav_core::unseal(kStateName, kStateVersion, state), "state of swf_vo");
    agree(archive, parameters_, ablation_, camera_, T_odom_first_camera_);
    this->archive(archive);
    archive.finish();
  }

  void archive(urban_nav_core::Archive& archive) {
    archive(started_, doubtful_, frame_, newest_known_, stamp_, seconds_, period_);
    archive(images_, rows_, prediction_, sensors_, mean_choice_, front_end_, window_, health_);
    output_.archive(archive, window_);
    archive.require(!started_ || window_.poses() > 0, "the window is empty");
  }

 private:
  /// A step before the images of its end are processed.
  struct Predicted {
    ProcessInput u;                        // at constant velocity; its mean may be that by sensors
    Pose steady;                           // at constant velocity
    std::optional<ProcessInput> reckoned;  // by sensors alone
    ProcessInput with_sensors;             // by both
  };
  Predicted predict(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const Pose& last,
                    const std::vector<MotionInput>& inputs) {
    Predicted predicted;
    sensors_.add(inputs);
    if (!started_) return predicted;
    predicted.u = predicted.with_sensors = prediction_.step(seconds_, inputs);
    predicted.steady = predicted.u.T_from_to;
    predicted.reckoned = sensors_.predict(from, to, last);
    if (!predicted.reckoned) return predicted;
    predicted.with_sensors = fuse(predicted.u, predicted.reckoned->T_from_to, predicted.reckoned->information);
    predicted.u.T_from_to = mean_choice_.choose(predicted.steady, predicted.with_sensors.T_from_to);
    return predicted;
  }

  /// Compares what predicted a step with what images measured.
  void check(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const Predicted& predicted) {
    const Pose measured = window_.pose(frame_ - 1).inverse() * window_.newest().pose;
    sensors_.check(from, to, measured);
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
    // After a pause a few matches agree by chance, somewhere.
    if (is_gap_long && predicted.reckoned && evidence.tracked < parameters_.degraded_features &&
        isFarFrom(*predicted.reckoned, last.inverse() * seen.T_odom_camera))
      evidence.localised = false;
    return seen;
  }

  // Notes the time step; how many usual ones it is.
  double takeTime(urban_nav_core::StampNs stamp) {
    seconds_ = started_ ? secondsBetween(stamp_, stamp) : 0.0;
    stamp_ = stamp;
    const double periods = period_ > 0.0 ? seconds_ / period_ : 1.0;
    if (seconds_ > 0.0)
      period_ = period_ > 0.0 ? period_ + 0.1 * (std::min(seconds_, 2.0 * period_) - period_) : seconds_;
    return periods;
  }

  // Too little is recognised that is older than the loss of frames: what few there are may be matched wrongly.
  bool isAdrift(const FrontEndResult& seen) const {
    const auto old = std::count_if(seen.tracked.begin(), seen.tracked.end(), [&](const Observation& observation) {
      return observation.landmark <= newest_known_;
    });
    return old < parameters_.lost_features;
  }

  void remember(const FrontEndResult& seen) {
    for (const auto* group : {&seen.tracked, &seen.fresh})
      for (const Observation& observation : *group) newest_known_ = std::max(newest_known_, observation.landmark);
  }

  // `adrift`: what was seen, where nothing but the prediction ties it to the frames before the loss. Held by that alone
  // for ever, the window would be as loose as a second of darkness leaves it, too loose to be linear; anew, it is firm
  // in itself and carries what is not known of its place.
  void takeStep(const ProcessInput& u, const FrontEndResult* adrift) {
    if (!started_) {
      window_.start(frame_, T_odom_first_camera_, urban_nav_core::Matrix6d::Identity() / (kOriginSigma * kOriginSigma));
    } else if (adrift != nullptr) {
      // Its landmarks begin with this frame, from where they say that it is.
      window_.restart(frame_, {window_.newest().pose.inverse() * adrift->T_odom_camera, u.information});
    } else if (window_.map().empty()) {
      window_.restart(frame_, u);
    } else {
      window_.addPose(frame_, u);
      window_.removePoses();
    }
  }

  // The step as the window has it now. The frame before may have been moved by this one's measurements, and after
  // darkness is moved far: from where it was assumed to be until now, the step would have the error of the whole dead
  // reckoning in it.
  void learn(const Pose& last, bool trusted, bool blind) {
    const bool smoothed = window_.hasPose(frame_ - 1);
    const Pose from = smoothed ? window_.pose(frame_ - 1) : last;
    prediction_.learn(from.inverse() * window_.newest().pose, seconds_, trusted, blind, smoothed);
  }

  void giveUp(const std::vector<LandmarkId>& landmarks) {
    for (const LandmarkId landmark : landmarks) {
      window_.withdrawAll(landmark);
      window_.endLandmark(landmark);
    }
  }

  void observe(const FrontEndResult& seen, bool trusted) {
    giveUp(seen.refuted);
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
  MotionSensors sensors_;
  MeanChoice mean_choice_;
  FrontEnd front_end_;
  Window window_;
  HealthMonitor health_;
  Output output_;

  bool started_ = false;
  bool doubtful_ = true;
  FrameId frame_ = 0;
  LandmarkId newest_known_ = -1;  // of the last frame that is tied to the first by measurements
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
std::vector<Settled> SwfVo::flush() { return implementation_->flush(); }
std::string SwfVo::state() const { return implementation_->state(); }

}  // namespace swf_vo
