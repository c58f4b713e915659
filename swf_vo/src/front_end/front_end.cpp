// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/front_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "front_end/across.hpp"
#include "front_end/corners.hpp"
#include "front_end/disparity_step.hpp"
#include "front_end/match_list.hpp"
#include "front_end/noise_scale.hpp"
#include "front_end/patch_residual_test.hpp"
#include "front_end/pose_estimation.hpp"
#include "front_end/refine.hpp"
#include "front_end/replenish.hpp"
#include "front_end/rig_rows.hpp"
#include "front_end/right_turn.hpp"
#include "front_end/rotation.hpp"
#include "front_end/row_offset.hpp"
#include "front_end/search_radius.hpp"
#include "front_end/temporal.hpp"
#include "front_end/tracks.hpp"

namespace swf_vo {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::StereoCamera;
using urban_nav_core::StereoPair;

namespace {

constexpr double kReferenceArea = 512.0 * 384.0;  // image size of the parameter `features`
constexpr int kTopWidth = 160;                    // maximum width of the image whose rotation is estimated
constexpr double kCoarseSlackPx = 1.0, kFineSlackPx = 0.1, kNoticedRowOffsetPx = 0.1;
// Templates of landmarks not measured recently are warped far, with an approximate slant of the surface.
constexpr double kLostSlackPx = 0.5;
// Number of hypotheses for unknown motion, sufficient if one match in five is correct.
constexpr int kWideSamples = 400;
// Within the window landmarks are static, so their template drift is part of the measurement noise: n measurements with
// this share of n^2 steps added to their variance determine a motion along the track as inaccurately as n steps of a
// random walk do (6 / (5 n) q = 12 / n^3 R).
constexpr double kSlopeShare = 0.1;
// Share of the initial disparity variance that is constant over the landmark's life (errors of its slope, and of other
// surfaces in its patch). Measured in rendered rooms at 1, 3 and 6 grey levels of noise (bench/creep). The mean of up
// to kLongestAverage measurements is not more accurate than this share.
constexpr double kConstantShare = 0.2;
constexpr int kLongestAverage = 30;
constexpr double kLeastTwoEyed = 0.3;                 // share of the inliers
constexpr int kMostMissed = 3, kMostMissedYoung = 1;  // frames
// A turn of the right camera has to lower the robust cost by this many dispersions (docs/derivations/rig_constants.md).
constexpr int kTurnAttempts = 3;
constexpr double kTurnEvidence = 3.0 * 24.0;
constexpr int kLongestAside = 50;  // frames after which a landmark has left the view
constexpr int kDisagreementsReject = 2, kDisagreementsRejectYoung = 1, kYoung = 3;  // frames

int topLevel(int width) {
  int level = 0;
  while ((width >> level) > kTopWidth) ++level;
  return level;
}

}  // namespace

int featuresIn(const StereoCamera& camera, int features) {
  const double area = static_cast<double>(camera.left.width) * camera.left.height;
  return std::max(8, static_cast<int>(std::lround(features * std::pow(area / kReferenceArea, 2.0 / 3.0))));
}

class FrontEnd::Implementation {
 public:
  Implementation(const Parameters& parameters, const StereoCamera& camera, bool subpixel)
      : parameters_(parameters),
        subpixel_(subpixel),
        camera_(camera),
        corners_(parameters.pyramid_levels, topLevel(camera.left.width), parameters.fast_threshold,
                 featuresIn(camera, parameters.features)),
        rotation_(camera.left),
        capacity_(4 * featuresIn(camera, parameters.features)),
        pose_estimator_(camera_, capacity_),
        radius_(parameters.search_radius, camera.left, static_cast<std::size_t>(capacity_)),
        tracks_(capacity_),
        noise_(capacity_),
        rows_(4 * capacity_),
        right_turn_(camera),
        rig_({parameters.right_roll * M_PI / 180.0, 1e-3 * parameters.shutter_delay}, camera_),
        replenisher_(camera_, featuresIn(camera, parameters.features), parameters.pixel_noise_floor, subpixel) {
    const std::size_t capacity = static_cast<std::size_t>(capacity_);
    residual_test_.resize(static_cast<std::size_t>(parameters.pyramid_levels));
    matches_.reserve(capacity);
    spare_.reserve(capacity);
    orphans_.reserve(capacity);
    parallax_.reserve(capacity);
    errors_.reserve(capacity);
    starts_.reserve(2);
    result_.tracked.reserve(capacity);
    result_.fresh.reserve(capacity);
    result_.ended.reserve(2 * capacity);
    result_.refuted.reserve(capacity);
  }

  const FrontEndResult& process(FrameId frame, const StereoPair& pair, const Pose& last, const Pose& predicted,
                                const std::vector<MapPoint>& map, double disparity_offset,
                                const PredictionQuality& quality, const Edges& edges) {
    clear(predicted);
    edges_ = edges;
    camera_.disparity_offset = disparity_offset;
    if (!isPair(pair)) return result_;
    corners_.extract(right_turn_.correct(pair));
    result_.corners = corners_.count(Side::Left);
    gather(map);
    const bool next = frame == frame_ + 1;
    T_window_odom_ = last.inverse();
    if (next) updateNoise();
    for (Match& match : matches_) match.inflation = noise_.of(match.track->noise);
    if (!next || quality.astray) radius_.setUnknown();
    position_is_lost_ = position_is_lost_ || quality.astray || !next;
    radius_.setLimit(quality.sigma_m, T_window_odom_, matches_);
    const Pose T_turned_odom = turn(next ? last : T_odom_localised_, predicted, quality.is_turn_known);
    result_.T_odom_turned = T_turned_odom.inverse();
    locate(T_turned_odom, predicted.inverse());
    detectTurn(pair, T_turned_odom, predicted.inverse());
    for (Match& match : matches_) follow(frame, match);
    replenish(frame);
    if (next && result_.localised)
      rig_.learn(last.inverse() * result_.T_odom_camera, quality.seconds, result_.fresh, tracks_);
    for (Observation& observation : result_.fresh) {
      observation.inflation = noise_.typical();
      observation.information /= observation.inflation;
    }
    result_.row_offset_px = rows_.px();
    result_.rig = rig_.evaluate();
    result_.rig.right_turn_rad = right_turn_.turn();
    result_.noise_scale = std::sqrt(noise_.typical());
    position_is_lost_ = !result_.localised && !matches_.empty();
    frame_ = frame;
    T_odom_localised_ = result_.T_odom_camera;
    return result_;
  }

  RightTurn& rightTurn() { return right_turn_; }
  /// Archives the state used by the next frame; everything else is recomputed.
  void archive(urban_nav_core::Archive& archive) {
    archive(corners_, rotation_);
    tracks_.archive(archive, parameters_.pyramid_levels);
    archive(noise_, rows_, right_turn_, rig_, replenisher_, residual_test_, result_.row_offset_px, result_.noise_scale);
    archive(radius_, position_is_lost_, frame_, T_odom_localised_, T_window_odom_);
    archive.require(residual_test_.size() == static_cast<std::size_t>(parameters_.pyramid_levels), "missing levels");
  }

 private:
  void clear(const Pose& predicted) {
    result_.tracked.clear();
    result_.fresh.clear();
    result_.ended.clear();
    result_.refuted.clear();
    result_.T_odom_camera = predicted;
    result_.localised = result_.turned = false;
    result_.corners = result_.candidates = 0;
    result_.inlier_share = result_.reprojection_px = 0.0;
    result_.disparity_step = {};
  }

  /// Starts new landmarks. In the first frame they are started again if a row offset between the images is found, with
  /// that offset.
  void replenish(FrameId frame) {
    const bool first = !rows_.isKnown();
    startTracks(frame);
    if (!first || std::abs(rows_.px()) < kNoticedRowOffsetPx) return;
    for (const Observation& observation : result_.fresh) tracks_.end(observation.landmark);
    result_.fresh.clear();
    startTracks(frame);
  }

  void startTracks(FrameId frame) {
    replenisher_.replenish(frame, corners_, result_.T_odom_camera, matches_, tracks_, result_.fresh, rows_);
    for (const Observation& observation : result_.fresh) tracks_.find(observation.landmark)->born_edges = edges_.left;
    rows_.learn();
  }

  bool isPair(const StereoPair& pair) const {
    const auto fits = [this](const urban_nav_core::ImageView& view) {
      return !view.empty() && view.width == camera_.left.width && view.height == camera_.left.height;
    };
    return fits(pair.left) && fits(pair.right);
  }

  /// Returns odom into the camera for the prediction with the rotation between the images, unless sensors are more
  /// accurate.
  Pose turn(const Pose& last, const Pose& predicted, bool is_known) {
    const Pose T_now_last = predicted.inverse() * last;
    listParallax(camera_, last.inverse(), T_now_last.t(), matches_, parallax_);
    const RotationEstimate seen =
        rotation_.track(corners_.image(Side::Left, corners_.top()), corners_.top(), T_now_last.q(), parallax_);
    result_.turned = seen.found && !(is_known && position_is_lost_);
    if (!result_.turned) return predicted.inverse();
    // The camera is rotated at its predicted position.
    const Quaterniond correction = seen.q_now_last * T_now_last.q().inverse();
    return Pose(correction, Eigen::Vector3d::Zero()) * predicted.inverse();
  }

  /// Sets the blur relative to the first observation, equal in both images: a difference would bias the disparity.
  void setBlur(Track& track) const {
    const double size = 1.0 / urban_nav_core::Pyramid::scale(track.level);
    track.blur = widening(edges_, {track.born_edges, track.born_edges}) / (size * size);
    track.sharper = !widening(track.born_edges, edges_.left.cwiseMax(edges_.right)).isZero();
  }

  /// Matches the map with the tracks; ends landmarks and tracks without a counterpart.
  void gather(const std::vector<MapPoint>& map) {
    matches_.clear();
    for (const MapPoint& point : map) {
      Match match;
      match.track = tracks_.find(point.landmark);
      match.p_odom = point.p_odom;
      if (match.track != nullptr && point.p_odom.allFinite()) matches_.push_back(match);
      else result_.ended.push_back(point.landmark);
    }
    for (Match& match : matches_) setBlur(*match.track);
    std::sort(matches_.begin(), matches_.end(),
              [](const Match& a, const Match& b) { return a.track->id < b.track->id; });
    std::size_t next = 0;
    orphans_.clear();
    for (int i = 0; i < tracks_.size(); ++i) {
      while (next < matches_.size() && matches_[next].track->id < tracks_.idAt(i)) ++next;
      if (next >= matches_.size() || matches_[next].track->id != tracks_.idAt(i)) orphans_.push_back(tracks_.idAt(i));
    }
    for (const LandmarkId id : orphans_) tracks_.end(id);
  }

  /// Updates the noise scale with the residuals of the previous frame at the updated estimates, corrected for the
  /// degrees of freedom of the landmark's own position.
  void updateNoise() {
    for (const Match& match : matches_) {
      Track& track = *match.track;
      if (track.measured != frame_ || track.seen < 2) continue;
      const auto left = projectInto(Side::Left, camera_, T_window_odom_, match.p_odom),
                 right = projectInto(Side::Right, camera_, T_window_odom_, match.p_odom);
      if (!left || !right) continue;
      const Eigen::Vector3d r = track.z - Eigen::Vector3d(left->x(), left->y(), right->x());
      const auto coordinates = static_cast<double>((track.information.diagonal().array() > 0.0).count());
      noise_.see(r.dot(track.information * r), coordinates * (1.0 - 1.0 / track.seen), track.noise);
    }
    noise_.learn();
  }

  /// Returns the pose supported by most first matches, in one image each, accurate to about a pixel.
  PoseEstimate matchCoarsely(const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    matchTemporal(corners_, camera_, T_turned_odom, radius_.px(), matches_, rows_.px());
    for (Match& match : matches_) measure(match);
    starts_.assign({T_predicted_odom, T_turned_odom});
    const PoseEstimatorOptions options{kCoarseSlackPx, parameters_.lost_features};
    return pose_estimator_.locate(starts_, options, matches_);
  }

  /// Matches at the previous position with the rotation between the images: the camera may have stopped or turned back.
  /// Keeps the previous result unless there are more inliers.
  PoseEstimate matchAsIfStill(const PoseEstimate& moving, const Pose& T_turned_odom) {
    spare_ = matches_;
    const Pose T_still_odom(T_turned_odom.q(), -(T_turned_odom.q() * T_window_odom_.inverse().t()));
    const PoseEstimate still = matchCoarsely(T_still_odom, T_still_odom);
    if (still.found && still.inliers > moving.inliers) return still;
    matches_.swap(spare_);
    return moving;
  }

  /// Variant for predictions that may be far off after frames without measurements, mainly in heading, so that
  /// templates are warped badly. Tries headings around the prediction and the previous position (the gap may be a clock
  /// jump), then matches again from the pose with most inliers.
  PoseEstimate matchAfterLoss(PoseEstimate best, const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    radius_.setUnknown();
    if (!best.found || 2 * best.inliers < best.candidates) {
      const auto tryFrom = [&](const Pose& T_camera_odom) {
        const PoseEstimate other = matchCoarsely(T_camera_odom, T_camera_odom);
        if (other.found && (!best.found || other.inliers > best.inliers)) best = other;
      };
      for (const double share : {0.0, -0.5, 0.5, -1.0, 1.0}) {
        const double yaw = std::atan(share * radius_.px() / camera_.left.fx);
        const Quaterniond q(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()));
        tryFrom(Pose(q, Eigen::Vector3d::Zero()) * T_predicted_odom);
      }
      tryFrom(T_window_odom_);
    }
    if (!best.found) return matchCoarsely(T_turned_odom, T_predicted_odom);
    radius_.setUsual();
    return matchCoarsely(best.T_camera_odom, best.T_camera_odom);
  }

  /// Searches a large region if nothing matches at the predicted positions, as with a large first step, and matches
  /// again from the motion found. Returns it if it explains clearly more than `explained` matches; else restores the
  /// matches.
  std::optional<PoseEstimate> searchWidely(const Pose& T_turned_odom, int explained) {
    spare_ = matches_;
    matchAnywhere(corners_, camera_, T_turned_odom, radius_.anywhere(), matches_, rows_.px());
    for (Match& match : matches_) measure(match);
    starts_.assign({T_turned_odom});
    const PoseEstimatorOptions options{kCoarseSlackPx, parameters_.lost_features, kWideSamples};
    const PoseEstimate guess = pose_estimator_.locate(starts_, options, matches_);
    if (guess.found) {
      const PoseEstimate coarse = matchCoarsely(guess.T_camera_odom, guess.T_camera_odom);
      if (coarse.found && coarse.inliers > 2 * explained) return coarse;
    }
    matches_.swap(spare_);
    return std::nullopt;
  }

  /// Updates the search radius from the distances between inliers and their predictions.
  void updateRadius(const Pose& T_expected_odom) {
    listPredictionErrors(camera_, T_expected_odom, matches_, errors_);
    radius_.learn(errors_);
  }

  /// Completes matches of the coarse motion in the other image and refines them to hundredths of a pixel.
  PoseEstimate matchFinely(const PoseEstimate& coarse, const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    for (Match& match : matches_) {
      match.contradicted = coarse.found && match.measured && !match.inlier;
      if (match.contradicted) match.left = match.right = PixelMeasurement();
    }
    matchAcross(corners_, camera_, coarse.found ? coarse.T_camera_odom : T_turned_odom, matches_, rows_.px());
    for (Match& match : matches_) {
      dropOutliers(match);
      measure(match);
    }
    T_coarse_odom_ = coarse.found ? coarse.T_camera_odom : T_predicted_odom;
    if (coarse.found) result_.disparity_step = steps_.measure(camera_, T_coarse_odom_, matches_);
    starts_.assign({T_coarse_odom_});
    PoseEstimatorOptions options;
    options.slack_px = position_is_lost_ ? kLostSlackPx : kFineSlackPx;
    options.least_inliers = parameters_.lost_features;
    return pose_estimator_.locate(starts_, options, matches_);
  }

  void locate(const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    if (matches_.empty()) return;
    PoseEstimate coarse = matchCoarsely(T_turned_odom, T_predicted_odom);
    if (2 * coarse.inliers < coarse.candidates && radius_.widen())
      coarse = matchCoarsely(T_turned_odom, T_predicted_odom);
    if (2 * coarse.inliers < coarse.candidates) coarse = matchAsIfStill(coarse, T_turned_odom);
    if (position_is_lost_) coarse = matchAfterLoss(coarse, T_turned_odom, T_predicted_odom);
    PoseEstimate fine = matchFinely(coarse, T_turned_odom, T_predicted_odom);
    if (fine.inliers < parameters_.degraded_features)
      if (const auto wide = searchWidely(T_turned_odom, fine.inliers))
        fine = matchFinely(*wide, T_turned_odom, T_predicted_odom);

    result_.candidates = fine.candidates;
    result_.localised = fine.found && !isOneEyed(fine.inliers) &&
                        !(position_is_lost_ && isByChance(camera_, fine.T_camera_odom, fine.inliers, matches_));
    radius_.setUnknown();
    if (!result_.localised) {
      for (Match& match : matches_) match.inlier = false;
      return;
    }
    updateRadius(T_turned_odom);
    result_.T_odom_camera = fine.T_camera_odom.inverse();
    result_.inlier_share = static_cast<double>(fine.inliers) / fine.candidates;
    result_.reprojection_px = fine.reprojection_px;
  }

  /// Estimates the pose again with the right image corrected by the turn that the steps imply, as after a knock. The
  /// turn is accepted if matches then fit better by more than chance explains; otherwise everything is restored.
  void detectTurn(const StereoPair& pair, const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    std::optional<Eigen::Vector3d> turn = right_turn_.propose(measureSteps(), pair.stamp);
    for (int i = 0; turn && i < kTurnAttempts; ++i) {
      const Eigen::Vector3d turn_before = right_turn_.turn();
      const double cost_before = robustCost(matches_);
      const auto before = std::make_tuple(matches_, result_, radius_, residual_test_);
      right_turn_.set(*turn);
      corners_.extract(right_turn_.correct(pair));
      locate(T_turned_odom, T_predicted_odom);
      const double cost = robustCost(matches_), least = kTurnEvidence * costDispersion(cost, matches_.size());
      if (!result_.localised || cost_before - cost < (i == 0 ? least : 0.0)) {
        right_turn_.set(turn_before);
        corners_.extract(right_turn_.correct(pair));
        std::tie(matches_, result_, radius_, residual_test_) = before;
        break;
      }
      turn = right_turn_.refine(measureSteps());
    }
    result_.disparity_step = right_turn_.add(result_.disparity_step, pair.stamp);
  }

  /// Returns the steps of this frame. A turn that rows show is removed from the disparity step.
  RigStep measureSteps() {
    const RowStep rows = steps_.measureRows(camera_, matches_, rows_.px());
    return {right_turn_.isLarge(rows) ? steps_.measure(camera_, T_coarse_odom_, matches_, rows.turn)
                                      : result_.disparity_step,
            rows};
  }

  void measure(Match& match) {
    if (!subpixel_) roundToPixels(match);
    combine(parameters_.pixel_noise_floor, match, rows_.px());
  }

  void dropOutliers(Match& match) {
    PatchResidualTest& test = residual_test_[static_cast<std::size_t>(match.track->level)];
    for (PixelMeasurement* sighting : {&match.left, &match.right})
      if (sighting->found && !test.isTypical(sighting->noise)) *sighting = PixelMeasurement();
  }

  /// Returns whether most matches are in one image although the other one has texture (it may be dark): the images are
  /// not a pair (swapped, or of different times), and a motion that explains one of them is wrong.
  bool isOneEyed(int inliers) const {
    const int enough = static_cast<int>(matches_.size());
    return countInBoth(matches_) < kLeastTwoEyed * inliers && corners_.count(Side::Left) > enough &&
           corners_.count(Side::Right) > enough;
  }

  /// Updates the track of a landmark after the frame, or ends it.
  void follow(FrameId frame, Match& match) {
    Track& track = *match.track;
    if (match.inlier) {
      if (match.left.found && match.right.found) rows_.see(match.right.pixel.y() - match.left.pixel.y());
      fillIn(camera_, result_.T_odom_camera.inverse(), match);
      learnSurface(corners_, camera_, result_.T_odom_camera.inverse(), match);
      ++track.seen;
      const Eigen::Matrix2d& aligned = match.left.found ? match.left.covariance : match.right.covariance;
      const double floor = parameters_.pixel_noise_floor;
      track.information = match.information;
      track.measured = frame;
      const double sigma_px = std::sqrt(0.5 * aligned.trace() + floor * floor);
      const Eigen::Matrix2d crept = creep(camera_, result_.T_odom_camera.inverse(), match);
      const double together = std::min<double>(track.seen, parameters_.window);
      const double constant = kConstantShare * track.sigma_disparity * track.sigma_disparity;
      const Eigen::Matrix2d displaced = displacedByBlur(track, match.left.found);
      track.blurred = displaced.isZero() ? 0 : track.blurred + 1;
      loosen(kSlopeShare * together * together * crept + std::min(track.blurred, kLongestAverage) * displaced,
             std::min(track.seen, kLongestAverage) * constant, match);
      const double inflation = match.inflation;
      result_.tracked.push_back({track.id, frame, match.z, match.information / inflation,
                                 inflation * whereBorn(track, crept), sigma_px, inflation});
      track.missed = track.disagreed = track.aside = 0;
      track.z = match.z;
      return;
    }
    // With a change of sharpness a missing or deviating match is not evidence against the landmark.
    const bool unlike = track.sharper || !track.blur.isZero();
    if (unlike && ++track.aside <= kLongestAside) return;
    if (result_.localised && (match.measured || match.contradicted)) {
      if (++track.disagreed < (track.seen < kYoung ? kDisagreementsRejectYoung : kDisagreementsReject)) return;
      result_.refuted.push_back(track.id);
      tracks_.end(track.id);
      return;
    }
    // Temporary loss, as with glare: well-known landmarks may be found again when the images are good.
    if (!result_.localised && track.seen >= kYoung) return;
    const int most = track.seen < kYoung ? kMostMissedYoung : kMostMissed;
    if (++track.missed < most && isInView(camera_, result_.T_odom_camera.inverse(), match)) return;
    result_.ended.push_back(track.id);
    tracks_.end(track.id);
  }

  Parameters parameters_;
  bool subpixel_;
  StereoCamera camera_;
  Corners corners_;
  RotationTracker rotation_;
  int capacity_;
  PoseEstimator pose_estimator_;
  DisparityStepMeter steps_;
  Pose T_coarse_odom_;  // of the present frame, from measurements in one image each
  SearchRadius radius_;
  Tracks tracks_;
  NoiseScale noise_;
  RowOffset rows_;
  RightTurn right_turn_;
  RigRows rig_;
  Replenisher replenisher_;
  std::vector<PatchResidualTest> residual_test_;  // for tracked landmarks, by level
  FrontEndResult result_;
  std::vector<Match> matches_, spare_;
  std::vector<LandmarkId> orphans_;
  std::vector<Parallax> parallax_;
  std::vector<Pose> starts_;
  std::vector<double> errors_;
  Edges edges_;
  bool position_is_lost_ = false;  // the previous pose is known by prediction only
  FrameId frame_ = -2;
  Pose T_odom_localised_;  // estimate of the frame processed last
  Pose T_window_odom_;     // previous frame, current estimate of the window
};

FrontEnd::FrontEnd(const Parameters& parameters, const StereoCamera& camera, bool subpixel)
    : implementation_(std::make_unique<Implementation>(parameters, camera, subpixel)) {}
FrontEnd::~FrontEnd() = default;

const FrontEndResult& FrontEnd::process(FrameId frame, const StereoPair& pair, const Pose& last, const Pose& predicted,
                                        const std::vector<MapPoint>& map, double disparity_offset,
                                        const PredictionQuality& quality, const Edges& edges) {
  return implementation_->process(frame, pair, last, predicted, map, disparity_offset, quality, edges);
}

RightTurn& FrontEnd::rightTurn() { return implementation_->rightTurn(); }
void FrontEnd::archive(urban_nav_core::Archive& archive) { implementation_->archive(archive); }

}  // namespace swf_vo
