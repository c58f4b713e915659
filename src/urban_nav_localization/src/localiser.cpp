// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/localiser.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace urban_nav_localization {

using urban_nav_core::Constraint;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StampNs;
using urban_nav_core::Vector6d;

namespace {

constexpr std::size_t kMaxMatches = 40;      // compared pair by pair
constexpr int kMinMatches = 2;               // one may be false
constexpr double kMinMatchDistance = 0.5;    // m; nearer, a second match repeats the first one
constexpr double kMetresPerRadian = 10.0;    // for directions without information
constexpr double kMaxLocalizedSigma = 0.33;  // m; three of them are the metre that Localized promises
// Probability that a query matches a wrong place: three registrations each, of which 3 of 2100 may be accepted at 95 %
// confidence, since none of 2100 pairs of different places was (docs/results/registration.md).
constexpr double kFalseMatchRate = 3.0 * 3.0 / 2100.0;
constexpr int kMaxMisses = 3;             // consecutive queries without a match
constexpr int kMinContradictions = 3;     // consecutive consistent matches against all before them
constexpr std::size_t kMaxSteps = 20000;  // of odometry: 10 to 30 minutes, 1.1 kB each

double positionSigma(const PoseWithCovariance& pose) {
  const auto values = urban_nav_core::symmetricEigenvalues(pose.covariance.topLeftCorner<3, 3>());
  return values ? std::sqrt(std::max(0.0, (*values)[2])) : 1e6;
}

/// Returns the probability of the best hypothesis among three: it is right and all others are false, the next best one
/// is right, or all are false; equally likely a priori.
double computeProbability(int supporting_matches, int against) {
  const double odds_best = std::pow((1.0 - kFalseMatchRate) / kFalseMatchRate, supporting_matches);
  const double odds_other = std::pow((1.0 - kFalseMatchRate) / kFalseMatchRate, against);
  return odds_best / (odds_best + odds_other + 1.0);
}

std::string metres(double value) {
  const int centimetres = static_cast<int>(std::lround(std::min(value, 1e4) * 100.0));
  return std::to_string(centimetres / 100) + "." + std::to_string(centimetres / 10 % 10) +
         std::to_string(centimetres % 10) + " m";
}

}  // namespace

const char* toString(LocalizationState state) {
  switch (state) {
    case LocalizationState::Uncertain: return "UNCERTAIN";
    case LocalizationState::Localized: return "LOCALIZED";
    case LocalizationState::Unmapped: break;
  }
  return "UNMAPPED";
}

const char* toString(LocalizationReason reason) {
  switch (reason) {
    case LocalizationReason::None: return "None";
    case LocalizationReason::NoMatch: return "NoMatch";
    case LocalizationReason::NothingSimilar: return "NothingSimilar";
    case LocalizationReason::InitialPoseOnly: return "InitialPoseOnly";
    case LocalizationReason::SingleMatch: return "SingleMatch";
    case LocalizationReason::Contested: return "Contested";
    case LocalizationReason::TooLongAgo: return "TooLongAgo";
    case LocalizationReason::NotConfirmed: return "NotConfirmed";
    case LocalizationReason::OdometryLost: break;
  }
  return "OdometryLost";
}

Localiser::Localiser(const Parameters& parameters) : parameters_(parameters) {}

bool Localiser::addOdometry(const urban_nav_core::RelativePose& step) {
  if (!odometry_.append(step)) return false;
  steps_.push_back(step);
  if (step.status.health == urban_nav_core::Health::Lost) lost_.push_back({step.from, step.to});
  if (steps_.size() >= kMaxSteps) forgetOldSteps();
  return true;
}

void Localiser::forgetOldSteps() {
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(kMaxSteps / 2));
  odometry_ = urban_nav_core::OdometryChain();
  for (const urban_nav_core::RelativePose& step : steps_) odometry_.append(step);
  const StampNs begin = steps_.front().from;
  lost_.erase(std::remove_if(lost_.begin(), lost_.end(), [begin](const auto& lost) { return lost.to <= begin; }),
              lost_.end());
  const auto first =
      std::find_if(matches_.begin(), matches_.end(), [begin](const MapMatch& match) { return match.stamp >= begin; });
  if (first == matches_.begin()) return;
  matches_.erase(matches_.begin(), first);
  choose();
}

void Localiser::addMatch(StampNs b, const Pose& T_map_a, const Constraint& measured, bool is_firm) {
  MapMatch match;
  match.stamp = b;
  const Matrix6d covariance = urban_nav_core::covarianceForDisplay(measured.information, kMetresPerRadian);
  const double sigma = parameters_.map_sigma;
  Matrix6d of_map = Matrix6d::Zero();
  of_map.diagonal() << Eigen::Vector3d::Constant(sigma * sigma),
      Eigen::Vector3d::Constant(sigma * sigma / (kMetresPerRadian * kMetresPerRadian));
  match.T_map_base = compose(PoseWithCovariance{T_map_a, of_map}, PoseWithCovariance{measured.T_a_b, covariance});
  match.may_begin = is_firm && positionSigma(match.T_map_base) < 1.0;
  if (match.T_map_base.pose.isFinite() && match.T_map_base.covariance.allFinite()) add(match);
}

void Localiser::addInitialPose(StampNs at, const PoseWithCovariance& T_map_base) {
  MapMatch initial_pose;
  initial_pose.stamp = at;
  initial_pose.T_map_base = T_map_base;
  initial_pose.is_match = false;
  if (T_map_base.pose.isFinite() && T_map_base.covariance.allFinite()) add(initial_pose);
}

void Localiser::addMiss(StampNs, bool expected) {
  ++misses_;
  if (expected) ++unconfirmed_;
}

void Localiser::add(const MapMatch& match) {
  if (!odometry_.nearestFrame(match.stamp)) return;  // odometry does not cover it
  misses_ = 0;
  const auto place = std::upper_bound(matches_.begin(), matches_.end(), match,
                                      [](const MapMatch& a, const MapMatch& b) { return a.stamp < b.stamp; });
  matches_.insert(place, match);
  if (matches_.size() > kMaxMatches) matches_.erase(matches_.begin());
  choose();
  if (against() >= kMinContradictions) {
    matches_.erase(matches_.begin(), matches_.begin() + static_cast<std::ptrdiff_t>(best_.members.back()) + 1);
    choose();
  }
  if (!best_.members.empty() && matches_[best_.members.back()].stamp == match.stamp) unconfirmed_ = 0;
}

int Localiser::against() const {
  const auto newest = std::find_if(matches_.rbegin(), matches_.rend(),
                                   [](const MapMatch& each) { return each.is_match && each.may_begin; });
  if (newest == matches_.rend() || best_.supporting_matches == 0) return 0;
  const auto last = best_.members.back();
  const Hypothesis other = around(static_cast<std::size_t>(matches_.rend() - newest) - 1);
  return other.members.front() > last ? other.supporting_matches : 0;
}

bool Localiser::agree(const MapMatch& one, const MapMatch& other) const {
  const auto way = odometry_.between(one.stamp, other.stamp);
  if (!way) return false;
  PoseWithCovariance expected = compose(one.T_map_base, *way);
  const double common = parameters_.registration.odometry_scale *
                        std::abs(odometry_.distance(one.stamp) - odometry_.distance(other.stamp));
  expected.covariance.diagonal().head<3>().array() += common * common;
  expected.covariance += other.T_map_base.covariance;
  const auto squares = urban_nav_core::nees(other.T_map_base.pose, expected);
  return squares && std::sqrt(*squares / 6.0) <= parameters_.gate;
}

Localiser::Hypothesis Localiser::around(std::size_t match) const {
  Hypothesis made;
  double last = -1e9;
  if (!matches_[match].is_match) {
    made.members.push_back(match);  // an initial pose is no evidence: a vague one agrees with everything
    return made;
  }
  for (std::size_t i = 0; i < matches_.size(); ++i) {
    if (i != match && (!matches_[i].is_match || !agree(matches_[match], matches_[i]))) continue;
    made.members.push_back(i);
    const double here = odometry_.distance(matches_[i].stamp);
    if (here - last < kMinMatchDistance) continue;
    ++made.supporting_matches;
    last = here;
  }
  return made;
}

void Localiser::choose() {
  std::vector<Hypothesis> all;
  for (std::size_t i = 0; i < matches_.size(); ++i)
    if (matches_[i].may_begin) all.push_back(around(i));
  // The most supporting matches; among equals the one with the latest match.
  const auto better = [&](const Hypothesis& x, const Hypothesis& y) {
    return x.supporting_matches != y.supporting_matches ? x.supporting_matches > y.supporting_matches
                                                        : x.members.back() > y.members.back();
  };
  best_ = second_ = Hypothesis();
  for (const Hypothesis& each : all)
    if (best_.members.empty() || better(each, best_)) best_ = each;
  for (const Hypothesis& each : all) {
    const bool shares = std::any_of(each.members.begin(), each.members.end(), [&](std::size_t member) {
      return std::find(best_.members.begin(), best_.members.end(), member) != best_.members.end();
    });
    if (!shares && (second_.members.empty() || better(each, second_))) second_ = each;
  }
}

PoseWithCovariance Localiser::fuse(const Hypothesis& hypothesis, StampNs stamp) const {
  // All matches are carried to the last one, and from there on by odometry, whose errors are common to all.
  const MapMatch& last = matches_[hypothesis.members.back()];
  PoseWithCovariance sum = last.T_map_base;
  for (auto member = hypothesis.members.rbegin() + 1; member != hypothesis.members.rend(); ++member) {
    const MapMatch& match = matches_[*member];
    const auto way = odometry_.between(match.stamp, last.stamp);
    if (!way) continue;
    PoseWithCovariance there = compose(match.T_map_base, *way);
    const double common = parameters_.registration.odometry_scale *
                          std::abs(odometry_.distance(last.stamp) - odometry_.distance(match.stamp));
    there.covariance.diagonal().head<3>().array() += common * common;
    // Kalman update with a measurement of the whole pose.
    const auto inverse = urban_nav_core::invertPositiveDefinite(Matrix6d(sum.covariance + there.covariance));
    if (!inverse) continue;
    const Matrix6d gain = sum.covariance * *inverse;
    const Vector6d d = boxMinus(there.pose, sum.pose);
    sum.pose = boxPlus(sum.pose, gain * d);
    const Matrix6d covariance = sum.covariance - gain * sum.covariance;
    sum.covariance = 0.5 * (covariance + covariance.transpose());
  }
  // The error of the map is common to all of them.
  const double sigma = parameters_.map_sigma;
  sum.covariance.diagonal().head<3>().array() += sigma * sigma;
  const auto way = odometry_.between(last.stamp, stamp);
  if (!way) return sum;
  PoseWithCovariance now = compose(sum, *way);
  const double common =
      parameters_.registration.odometry_scale * std::abs(odometry_.distance(stamp) - odometry_.distance(last.stamp));
  now.covariance.diagonal().head<3>().array() += common * common;
  return now;
}

bool Localiser::isLost(StampNs after, StampNs until) const {
  const auto lost = std::upper_bound(lost_.begin(), lost_.end(), after,
                                     [](StampNs stamp, const auto& interval) { return stamp < interval.to; });
  return lost != lost_.end() && lost->from < until;
}

bool Localiser::isUnconfirmedPrediction(StampNs stamp) const {
  if (lost_.empty()) return false;
  if (isLost(stamp - 1, stamp)) return true;
  return std::all_of(best_.members.begin(), best_.members.end(), [&](std::size_t member) {
    const MapMatch& match = matches_[member];
    return !match.is_match || isLost(std::min(match.stamp, stamp), std::max(match.stamp, stamp));
  });
}

double Localiser::distanceSinceMatch() const {
  if (odometry_.empty()) return 0.0;
  const double driven = odometry_.distance(odometry_.trajectory().back().stamp);
  const auto last =
      std::find_if(matches_.rbegin(), matches_.rend(), [](const MapMatch& match) { return match.is_match; });
  return last == matches_.rend() ? driven : driven - odometry_.distance(last->stamp);
}

LocalizationEstimate Localiser::now() const {
  return odometry_.empty() ? LocalizationEstimate() : at(odometry_.trajectory().back().stamp);
}

LocalizationEstimate Localiser::at(StampNs stamp) const {
  LocalizationEstimate estimate;
  estimate.stamp = stamp;
  const auto because = [&](LocalizationState state, LocalizationReason reason, const std::string& sentence) {
    estimate.state = state;
    estimate.reason = reason;
    estimate.sentence = sentence;
    return estimate;
  };
  const bool finds_nothing = misses_ >= kMaxMisses;
  if (best_.members.empty() || !odometry_.nearestFrame(stamp))
    return finds_nothing ? because(LocalizationState::Unmapped, LocalizationReason::NothingSimilar,
                                   "no keyframe or cloud of the surroundings matches the map")
                         : because(LocalizationState::Uncertain, LocalizationReason::NoMatch,
                                   "no place of the map was recognised yet");
  estimate.T_map_base = fuse(best_, stamp);
  estimate.supporting_matches = best_.supporting_matches;
  estimate.probability = computeProbability(best_.supporting_matches, second_.supporting_matches);
  const double sigma = positionSigma(*estimate.T_map_base);
  if (best_.supporting_matches == 0)
    return because(LocalizationState::Uncertain, LocalizationReason::InitialPoseOnly,
                   "the pose is an initial pose that no match confirmed yet");
  if (best_.supporting_matches < kMinMatches)
    return because(LocalizationState::Uncertain, LocalizationReason::SingleMatch,
                   "one match, without a second consistent one");
  if (second_.supporting_matches >= best_.supporting_matches || against() >= kMinMatches)
    return because(LocalizationState::Uncertain, LocalizationReason::Contested, "as many matches support another pose");
  if (isUnconfirmedPrediction(stamp))
    return because(LocalizationState::Uncertain, LocalizationReason::OdometryLost,
                   "odometry was lost, and no match since then confirms the pose");
  if (unconfirmed_ >= kMaxMisses)
    return because(LocalizationState::Uncertain, LocalizationReason::NotConfirmed,
                   "keyframes of the map at this pose do not match");
  if (sigma > kMaxLocalizedSigma)
    return because(finds_nothing ? LocalizationState::Unmapped : LocalizationState::Uncertain,
                   LocalizationReason::TooLongAgo,
                   "the last match is too long ago: odometry since then is accurate to " + metres(sigma));
  return because(LocalizationState::Localized, LocalizationReason::None,
                 std::to_string(best_.supporting_matches) + " consistent matches, accurate to " + metres(sigma));
}

}  // namespace urban_nav_localization
