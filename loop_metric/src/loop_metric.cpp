// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/loop_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "candidate/keyframe_pairs.hpp"
#include "candidate/odometry_gate.hpp"
#include "loop_metric/evidence.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Constraint;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::TopologicalClosure;
using urban_nav_registration::align;
using urban_nav_registration::Alignment;
using urban_nav_registration::AlignmentPrior;
using urban_nav_registration::betweenBases;
using urban_nav_registration::SearchMode;
using urban_nav_registration::StereoClosure;

namespace {

constexpr std::size_t kKeptMatches = 8;  // about 50 kB each

std::string closureReason(const char* format, double value, double threshold) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), format, value, threshold);
  return text.data();
}

/// Returns T_a_b between the poses from that between two keyframes near them. Zero information if it cannot be
/// computed.
Constraint atMoments(const Constraint& views, const NearbyKeyframe& a, const NearbyKeyframe& b) {
  Constraint made;
  const auto covariance = urban_nav_core::invertPositiveDefinite(views.information);
  made.T_a_b = a.T_place_keyframe.pose * views.T_a_b * b.T_place_keyframe.pose.inverse();
  if (!covariance) return made;
  const PoseWithCovariance moments = urban_nav_core::compose(
      urban_nav_core::compose(a.T_place_keyframe, PoseWithCovariance{views.T_a_b, Matrix6d(*covariance)}),
      urban_nav_core::invert(b.T_place_keyframe));
  made.T_a_b = moments.pose;
  if (const auto information = urban_nav_core::invertPositiveDefinite(moments.covariance))
    made.information = Matrix6d(*information);
  return made;
}

}  // namespace

/// Measurement of one candidate.
class Measuring {
 public:
  Measuring(LoopMetric& stage, const TopologicalClosure& candidate, const PlaceData& place_data)
      : stage_(stage), parameters_(stage.parameters_), place_data_(place_data) {
    measurement_.metric.a = candidate.a;
    measurement_.metric.b = candidate.b;
    measurement_.metric.probability = candidate.probability;
    measurement_.metric.source = "loop_metric";
    if (const auto path = place_data.between(candidate.a, candidate.b))
      gate_.emplace(*path, parameters_.registration.odometry_scale);
  }

  CandidateMeasurement run() {
    judge();
    measurement_.metric.reason_name = toString(static_cast<LoopReason>(measurement_.metric.reason));
    measurement_.metric.evidence = printEvidence(collectEvidence(measurement_));
    return std::move(measurement_);
  }

 private:
  void judge() {
    MetricClosure& metric = measurement_.metric;
    for (const urban_nav_core::PoseRef* at : {&metric.a, &metric.b}) {
      std::string why;
      if (!place_data_.knows(*at, why)) return refuse(LoopReason::UnknownMoment, why);
    }
    if (gate_) {
      const double apart = gate_->leastDistance(parameters_.gate);
      if (!test("least_distance_m", apart, parameters_.place_radius))
        return refuse(LoopReason::Odometry,
                      closureReason("distance by odometry at least %.0f m, larger than place_radius %.0f m", apart,
                                    parameters_.place_radius));
    }
    if (parameters_.stereo && byStereo()) return;
    if (parameters_.icp && byClouds()) return;
    if (metric.reason != 0) return;  // a transform was found, but rejected
    if (measurement_.attempts.stereo.empty() && !measurement_.attempts.icp)
      return refuse(LoopReason::NothingKept, "neither keyframes with a common view nor clouds at both poses");
    std::string sentence;
    if (!measurement_.attempts.stereo.empty())
      sentence = "stereo: " + measurement_.attempts.stereo.front().result.sentence;
    if (measurement_.attempts.icp)
      sentence += (sentence.empty() ? "icp: " : "; icp: ") + measurement_.attempts.icp->sentence;
    refuse(LoopReason::NotRegistered, sentence);
  }

  bool byStereo() {
    const double search_distance = parameters_.keyframe_search_distance;
    std::optional<PoseWithCovariance> T_a_b;
    if (gate_) T_a_b = gate_->T_a_b();
    for (const KeyframePair& pair :
         chooseKeyframePairs(place_data_.views(measurement_.metric.a, search_distance),
                             place_data_.views(measurement_.metric.b, search_distance), T_a_b, search_distance,
                             static_cast<std::size_t>(parameters_.stereo_tries))) {
      StereoAttempt made{pair.a, pair.b, stage_.match(pair.a, pair.b, place_data_)};
      measurement_.attempts.stereo.push_back(made);
      if (made.result.verdict != ClosureVerdict::Accepted) continue;
      const Constraint measured =
          atMoments(betweenBases(made.result.lefts, stage_.T_base_left_), made.keyframe_a, made.keyframe_b);
      if (accept(ClosureMethod::Stereo, measured, {}, made.result.sentence)) return true;
    }
    return false;
  }

  bool byClouds() {
    const auto target = place_data_.cloud(measurement_.metric.a, parameters_.registration.cloud_half_length),
               source = place_data_.cloud(measurement_.metric.b, parameters_.registration.cloud_half_length);
    if (target.points.empty() || source.points.empty()) return false;
    Pose guess;
    SearchMode search = SearchMode::AtOnce;
    AlignmentPrior known;
    known.deformation_sigma =
        std::hypot(place_data_.deformationSigma(measurement_.metric.a, parameters_.registration.cloud_half_length),
                   place_data_.deformationSigma(measurement_.metric.b, parameters_.registration.cloud_half_length));
    if (gate_) {
      guess = gate_->T_a_b().pose;
      search = SearchMode::IfRejected;
      known.is_possible = [this](const Constraint& T_a_b) { return gate_->deviations(T_a_b) <= parameters_.gate; };
    }
    measurement_.attempts.icp_guess = guess;
    measurement_.attempts.icp = align(source, target, parameters_.registration, guess, search, known);
    Alignment& found = *measurement_.attempts.icp;
    if (found.verdict == ClosureVerdict::Rejected) return false;
    if (found.verdict == ClosureVerdict::Degenerate && !gate_) {
      // A single planar facade matches any other: a transform with free directions does not identify the place, unless
      // odometry confirms it.
      found.sentence += "; without odometry between the poses this does not identify the place";
      return false;
    }
    return accept(ClosureMethod::Icp, {found.T_target_source, found.information}, found.free_directions,
                  found.sentence);
  }

  /// Returns false, with the reason set, if the transform is inconsistent with odometry.
  bool accept(ClosureMethod method, const Constraint& measured,
              const std::vector<urban_nav_core::Vector6d>& free_directions, const std::string& sentence) {
    MetricClosure& metric = measurement_.metric;
    metric.method = method;
    metric.measured.T_a_b = measured.T_a_b;
    metric.free_directions = free_directions;
    const double apart = measured.T_a_b.t().norm();
    if (!test("distance_m", apart, parameters_.place_radius)) {
      refuse(LoopReason::OtherPlace, closureReason("distance of the poses %.1f m, larger than place_radius %.1f m",
                                                   apart, parameters_.place_radius));
      return false;
    }
    if (gate_) {
      const double deviations = gate_->deviations(measured);
      if (!test(method == ClosureMethod::Stereo ? "stereo_against_odometry" : "icp_against_odometry", deviations,
                parameters_.gate)) {
        refuse(LoopReason::Odometry,
               closureReason("the transform differs from odometry by %.1f standard deviations, at most %.1f allowed",
                             deviations, parameters_.gate));
        return false;
      }
      metric.odometry_gate = true;
    }
    metric.measured.information = measured.information;
    metric.verdict = ClosureVerdict::Accepted;
    metric.reason = static_cast<int>(LoopReason::None);
    metric.sentence = sentence;
    return true;
  }

  bool test(const char* name, double value, double threshold) {
    measurement_.attempts.tests.push_back({name, value, threshold, false, value <= threshold});
    return value <= threshold;
  }

  void refuse(LoopReason reason, const std::string& sentence) {
    measurement_.metric.verdict = ClosureVerdict::Rejected;
    measurement_.metric.reason = static_cast<int>(reason);
    measurement_.metric.sentence = sentence;
    measurement_.metric.measured.information.setZero();
  }

  LoopMetric& stage_;
  const Parameters& parameters_;
  const PlaceData& place_data_;
  std::optional<OdometryGate> gate_;
  CandidateMeasurement measurement_;
};

const char* toString(LoopReason reason) {
  switch (reason) {
    case LoopReason::None: return "";
    case LoopReason::UnknownMoment: return "unknown_moment";
    case LoopReason::NothingKept: return "nothing_kept";
    case LoopReason::NotRegistered: return "not_registered";
    case LoopReason::Odometry: return "odometry";
    case LoopReason::Contradicted: return "contradicted";
    case LoopReason::OtherPlace: break;
  }
  return "other_place";
}

LoopMetric::LoopMetric(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                       const Pose& T_base_left)
    : parameters_(parameters), T_base_left_(T_base_left), matcher_(camera, parameters.registration) {}

const StereoClosure& LoopMetric::match(const NearbyKeyframe& a, const NearbyKeyframe& b, const PlaceData& place_data) {
  for (const StereoAttempt& known : matched_)
    if (known.keyframe_a.at == a.at && known.keyframe_b.at == b.at) return known.result;
  matched_.push_front({a, b, matcher_.match(place_data.keyframe(a.at), place_data.keyframe(b.at))});
  if (matched_.size() > kKeptMatches) matched_.pop_back();
  return matched_.front().result;
}

CandidateMeasurement LoopMetric::measure(const TopologicalClosure& candidate, const PlaceData& place_data) {
  return Measuring(*this, candidate, place_data).run();
}

}  // namespace loop_metric
