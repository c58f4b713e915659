// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/front_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "front_end/across.hpp"
#include "front_end/corners.hpp"
#include "front_end/disparity_step.hpp"
#include "front_end/match_list.hpp"
#include "front_end/noise_scale.hpp"
#include "front_end/patch_residual_test.hpp"
#include "front_end/pose_estimation.hpp"
#include "front_end/refine.hpp"
#include "front_end/replenish.hpp"
#include "front_end/right_turn.hpp"
#include "front_end/rig_rows.hpp"
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

constexpr double kReferenceArea = 512.0 * 384.0;  // of the parameter `features`
constexpr int kTopWidth = 160;                    // the image whose rotation is found is at most this wide
constexpr double kCoarseSlackPx = 1.0, kFineSlackPx = 0.1, kNoticedRowOffsetPx = 0.1;
// A template that was last seen a while ago has been warped far, by a slant of its surface that is known roughly.
constexpr double kAstraySlackPx = 0.5;
// By chance 8 % of the landmarks in view agreed, once in ten simulated minutes with gaps (the soak of
// src/urban_nav/bench); where the pose was right at least 21 % did, after a second without pictures in a real street
// seen from a car (the recordings of bench/faults).
constexpr double kLeastShareInView = 0.15;
// Motions that are tried where so little agrees that nothing is known of the motion, for one match in five to be
// right.
constexpr int kWideSamples = 400;
// Within the window a landmark stands still, and what it creeps by there has to be in its measurements: n of them with
// this share of n^2 steps added to their variance show a motion along the track as badly as n steps of a random walk do
// (6 / (5 n) q = 12 / n^3 R).
constexpr double kSlopeShare = 0.1;
// Part of the error of a disparity stays the same as long as the landmark lives (that of its slope, and of what else
// is in its patch): this share of the variance it was born with. Measured in rendered rooms at 1, 3 and 6 grey levels
// of noise (bench/creep). However many measurements there are, up to this many, their mean is no better.
constexpr double kConstantShare = 0.2;
constexpr int kLongestAverage = 30;
constexpr double kLeastTwoEyed = 0.3;                 // share of the inliers
constexpr int kMostMissed = 3, kMostMissedYoung = 1;  // frames
// A turn of the right camera and two corrections of it. It has to lower the robust cost by the quantile 1e-6 of a
// chi-square of one degree of freedom, three times over: landmarks share errors (docs/derivations/rig_constants.md).
constexpr int kTurnAttempts = 3;
constexpr double kTurnEvidence = 3.0 * 24.0;
constexpr int kLongestAside = 50;                     // frames: what was known as long ago has left the view
constexpr int kDisagreementsRefute = 2, kDisagreementsRefuteYoung = 1, kYoung = 3;  // frames

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
    if (next) learnNoise();
    for (Match& match : matches_) match.inflation = noise_.of(match.track->noise);
    if (!next || quality.astray) radius_.setUnknown();
    astray_ = astray_ || quality.astray || !next;
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
    astray_ = !result_.localised && !matches_.empty();
    frame_ = frame;
    T_odom_localised_ = result_.T_odom_camera;
    return result_;
  }

  /// The state that the next frame finds; everything else is made anew in each.
  void archive(urban_nav_core::Archive& archive) {
    archive(corners_, rotation_);
    tracks_.archive(archive, parameters_.pyramid_levels);
    archive(noise_, rows_, right_turn_, rig_, replenisher_, residual_test_, result_.row_offset_px, result_.noise_scale);
    archive(radius_, astray_, frame_, T_odom_localised_, T_window_odom_);
    archive.require(residual_test_.size() == static_cast<std::size_t>(parameters_.pyramid_levels),
                    "levels are missing");
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

  /// New landmarks. The first frame is looked at twice where the rows of its images turn out to differ: its landmarks
  /// want to be right too.
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

  /// The prediction with the rotation that the images show, unless it is known better; odom into the camera.
  Pose turn(const Pose& last, const Pose& predicted, bool is_known) {
    const Pose T_now_last = predicted.inverse() * last;
    listParallax(camera_, last.inverse(), T_now_last.t(), matches_, parallax_);
    const RotationEstimate seen =
        rotation_.track(corners_.image(Side::Left, corners_.top()), corners_.top(), T_now_last.q(), parallax_);
    result_.turned = seen.found && !(is_known && astray_);
    if (!result_.turned) return predicted.inverse();
    // The camera stays where it was predicted to be and is turned there.
    const Quaterniond correction = seen.q_now_last * T_now_last.q().inverse();
    return Pose(correction, Eigen::Vector3d::Zero()) * predicted.inverse();
  }

  /// By what the images are less sharp than when the track was born; in both by the same: a difference would go into
  /// the disparity.
  void setBlur(Track& track) const {
    const double size = 1.0 / urban_nav_core::Pyramid::scale(track.level);
    track.blur = widening(edges_, {track.born_edges, track.born_edges}) / (size * size);
    track.sharper = !widening(track.born_edges, edges_.left.cwiseMax(edges_.right)).isZero();
  }

  /// Pairs the map with what is followed. What is in one only has come to its end.
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
      const LandmarkId id = tracks_.idAt(i);
      while (next < matches_.size() && matches_[next].track->id < id) ++next;
      if (next >= matches_.size() || matches_[next].track->id != id) orphans_.push_back(id);
    }
    for (const LandmarkId id : orphans_) tracks_.end(id);
  }

  /// Residuals of the measurements of the frame before, now that the window has them. A landmark's own place takes up
  /// its share.
  void learnNoise() {
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

  /// First matches, in one image each, and the pose that most of them agree on to about a pixel.
  PoseEstimate matchCoarsely(const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    matchTemporal(corners_, camera_, T_turned_odom, radius_.px(), matches_, rows_.px());
    for (Match& match : matches_) measure(match);
    starts_.assign({T_predicted_odom, T_turned_odom});
    const PoseEstimatorOptions options{kCoarseSlackPx, parameters_.lost_features};
    return pose_estimator_.locate(starts_, options, matches_);
  }

  /// The camera may have stopped or turned back: turned as the images show, it is sought where it was. Without more
  /// matches that agree, all stays as it was.
  PoseEstimate matchAsIfStill(const PoseEstimate& moving, const Pose& T_turned_odom) {
    spare_ = matches_;
    const Pose T_still_odom(T_turned_odom.q(), -(T_turned_odom.q() * T_window_odom_.inverse().t()));
    const PoseEstimate still = matchCoarsely(T_still_odom, T_still_odom);
    if (still.found && still.inliers > moving.inliers) return still;
    matches_.swap(spare_);
    return moving;
  }

  /// After frames without measurements the prediction may be far off, most of all in heading, and what is warped by it
  /// fits badly. From the headings about it, and from where the camera was last, for a clock may jump and the camera
  /// need not; then from the pose that most matches agree on, they are sought again.
  PoseEstimate matchAstray(PoseEstimate best, const Pose& T_turned_odom, const Pose& T_predicted_odom) {
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

  /// Nothing fits where it was expected, as when the first step is a large one: looks far around for a motion, then
  /// matches again from there. Taken if it explains clearly more than `explained` matches; else all stays as it was.
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

  /// Learns the width of the next search from what this frame's inliers were away from where they had been expected.
  void learnRadius(const Pose& T_expected_odom) {
    errors_.clear();
    for (const Match& match : matches_) {
      if (!match.inlier || !match.left.found) continue;
      const auto expected = projectInto(Side::Left, camera_, T_expected_odom, match.p_odom);
      if (expected) errors_.push_back((match.left.pixel - *expected).norm());
    }
    radius_.learn(errors_);
  }

  /// What the coarse motion explains is completed in the other image and placed to a hundredth of a pixel.
  PoseEstimate matchFinely(const PoseEstimate& coarse, const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    for (Match& match : matches_) {
      match.contradicted = coarse.found && match.measured && !match.inlier;
      if (match.contradicted) match.left = match.right = PixelMeasurement();
    }
    matchAcross(corners_, camera_, coarse.found ? coarse.T_camera_odom : T_turned_odom, matches_, rows_.px());
    for (Match& match : matches_) {
      dropMisfits(match);
      measure(match);
    }
    if (coarse.found) result_.disparity_step = disparity_step_meter_.measure(camera_, coarse.T_camera_odom, matches_);
    starts_.assign({coarse.found ? coarse.T_camera_odom : T_predicted_odom});
    PoseEstimatorOptions options;
    options.slack_px = astray_ ? kAstraySlackPx : kFineSlackPx;
    options.least_inliers = parameters_.lost_features;
    return pose_estimator_.locate(starts_, options, matches_);
  }

  void locate(const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    if (matches_.empty()) return;
    PoseEstimate coarse = matchCoarsely(T_turned_odom, T_predicted_odom);
    if (2 * coarse.inliers < coarse.candidates && radius_.widen())
      coarse = matchCoarsely(T_turned_odom, T_predicted_odom);
    if (2 * coarse.inliers < coarse.candidates) coarse = matchAsIfStill(coarse, T_turned_odom);
    if (astray_) coarse = matchAstray(coarse, T_turned_odom, T_predicted_odom);
    PoseEstimate fine = matchFinely(coarse, T_turned_odom, T_predicted_odom);
    if (fine.inliers < parameters_.degraded_features)
      if (const auto wide = searchWidely(T_turned_odom, fine.inliers))
        fine = matchFinely(*wide, T_turned_odom, T_predicted_odom);

    result_.candidates = fine.candidates;
    result_.localised = fine.found && !isOneEyed(fine.inliers) && !(astray_ && isByChance(fine));
    radius_.setUnknown();
    if (!result_.localised) {
      for (Match& match : matches_) match.inlier = false;
      return;
    }
    learnRadius(T_turned_odom);
    result_.T_odom_camera = fine.T_camera_odom.inverse();
    result_.inlier_share = static_cast<double>(fine.inliers) / fine.candidates;
    result_.reprojection_px = fine.reprojection_px;
  }

  /// Locates the frame again with the right camera turned by what the disparity step asks for, as after a knock. The
  /// turn is taken where the matches then fit better by more than chance; else all stays as it was.
  void detectTurn(const StereoPair& pair, const Pose& T_turned_odom, const Pose& T_predicted_odom) {
    std::optional<Eigen::Vector3d> turn = right_turn_.propose(measureSteps(), pair.stamp);
    for (int i = 0; turn && i < kTurnAttempts; ++i) {
      const Eigen::Vector3d turn_before = right_turn_.turn();
      const double cost_before = robustCost(matches_);
      const std::vector<Match> matches = matches_;
      const FrontEndResult result = result_;
      right_turn_.set(*turn);
      corners_.extract(right_turn_.correct(pair));
      locate(T_turned_odom, T_predicted_odom);
      const double needed = i == 0 ? kTurnEvidence : 0.0;
      if (!result_.localised || robustCost(matches_) > cost_before - needed) {
        right_turn_.set(turn_before);
        corners_.extract(right_turn_.correct(pair));
        matches_ = matches;
        result_ = result;
        break;
      }
      turn = right_turn_.refine(measureSteps());
    }
    result_.disparity_step = right_turn_.add(result_.disparity_step, pair.stamp);
  }

  RigStep measureSteps() {
    return {result_.disparity_step, disparity_step_meter_.measureRows(camera_, matches_, rows_.px())};
  }

  void measure(Match& match) {
    if (!subpixel_) roundToPixels(match);
    combine(parameters_.pixel_noise_floor, match, rows_.px());
  }

  void dropMisfits(Match& match) {
    for (PixelMeasurement* sighting : {&match.left, &match.right})
      if (sighting->found && !residual_test_[static_cast<std::size_t>(match.track->level)].isTypical(sighting->noise))
        *sighting = PixelMeasurement();
  }

  /// Of the landmarks that such a pose would have in view, are those that say so a few only? Where one has searched far
  /// around, some patches of any other place look like some of before, and a few of them agree; and so does what was
  /// carried along.
  bool isByChance(const PoseEstimate& found) const {
    const auto in_view = std::count_if(matches_.begin(), matches_.end(),
                                       [&](const Match& match) { return isInView(camera_, found.T_camera_odom, match); });
    return found.inliers < kLeastShareInView * static_cast<double>(in_view);
  }

  /// Do most matches live in one image although the other has something to show? Then the two images are no pair
  /// (swapped, or of different times), and a motion that explains one of them is wrong. A dark image is another matter:
  /// one eye is enough.
  bool isOneEyed(int inliers) const {
    const int both = countInBoth(matches_);
    const int enough = static_cast<int>(matches_.size());
    return both < kLeastTwoEyed * inliers && corners_.count(Side::Left) > enough &&
           corners_.count(Side::Right) > enough;
  }

  /// Decides the future of a landmark.
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
    // Less or more sharp than it was, it is looked for in vain, or found elsewhere; that says nothing of it.
    const bool unlike = track.sharper || !track.blur.isZero();
    if (unlike && ++track.aside <= kLongestAside) return;
    if (result_.localised && (match.measured || match.contradicted)) {
      if (++track.disagreed < (track.seen < kYoung ? kDisagreementsRefuteYoung : kDisagreementsRefute)) return;
      result_.refuted.push_back(track.id);
      tracks_.end(track.id);
      return;
    }
    // Lost for a moment, as in a flash of light: what was known well may still be found when the images are good again.
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
  DisparityStepMeter disparity_step_meter_;
  SearchRadius radius_;
  Tracks tracks_;
  NoiseScale noise_;
  RowOffset rows_;
  RightTurn right_turn_;
  RigRows rig_;
  Replenisher replenisher_;
  std::vector<PatchResidualTest> residual_test_;  // of landmarks that are followed, by level
  FrontEndResult result_;
  std::vector<Match> matches_, spare_;
  std::vector<LandmarkId> orphans_;
  std::vector<Parallax> parallax_;
  std::vector<Pose> starts_;
  std::vector<double> errors_;
  Edges edges_;
  bool astray_ = false;  // nothing says where the frame before was but the prediction
  FrameId frame_ = -2;
  Pose T_odom_localised_;  // of the frame processed here last, as it was localised
  Pose T_window_odom_;     // of the frame before, as the window has it now
};

FrontEnd::FrontEnd(const Parameters& parameters, const StereoCamera& camera, bool subpixel)
    : implementation_(std::make_unique<Implementation>(parameters, camera, subpixel)) {}
FrontEnd::~FrontEnd() = default;

const FrontEndResult& FrontEnd::process(FrameId frame, const StereoPair& pair, const Pose& last, const Pose& predicted,
                                        const std::vector<MapPoint>& map, double disparity_offset,
                                        const PredictionQuality& quality, const Edges& edges) {
  return implementation_->process(frame, pair, last, predicted, map, disparity_offset, quality, edges);
}

void FrontEnd::archive(urban_nav_core::Archive& archive) { implementation_->archive(archive); }

}  // namespace swf_vo
