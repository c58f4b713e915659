// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::Matched;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr double kFew = 0.5;  // share of the shorter trajectory below which an offset is looked for

std::string secondsText(StampNs ns) { return urban_nav_core::printNumber(1e-9 * static_cast<double>(ns)) + " s"; }

Matched match(const urban_nav_input::TrajectoryFile& truth, const urban_nav_input::TrajectoryFile& estimate,
              Evaluation& evaluation, bool find_offset) {
  if (!truth.stamped || !estimate.stamped) {
    std::optional<Matched> matched = urban_nav_core::associateByIndex(truth.poses, estimate.poses);
    if (matched) return *matched;
    throw DataError(estimate.path,
                    std::to_string(estimate.poses.size()) + " poses for " + std::to_string(truth.poses.size()) +
                        " of the truth, and no stamps to associate them",
                    "");
  }
  Matched matched = urban_nav_core::associate(truth.trajectory, estimate.trajectory);
  const auto shorter = static_cast<double>(std::min(truth.poses.size(), estimate.poses.size()));
  if (static_cast<double>(matched.stamps.size()) >= kFew * shorter && !find_offset) return matched;
  evaluation.offset = urban_nav_core::findOffset(truth.trajectory, estimate.trajectory);
  if (evaluation.offset && find_offset) {
    evaluation.offset_applied = true;
    return urban_nav_core::associate(truth.trajectory, estimate.trajectory, evaluation.offset->offset);
  }
  if (matched.stamps.empty()) {
    const std::string help = evaluation.offset
                                 ? "; with " + secondsText(evaluation.offset->offset) +
                                       " added to the estimate's stamps " + std::to_string(evaluation.offset->matched) +
                                       " poses match: urban_nav evaluate --find-offset applies that"
                                 : "";
    throw DataError(estimate.path, "no stamp is within 0.02 s of one of the truth" + help, "");
  }
  return matched;
}

std::vector<urban_nav_core::Matrix6d> computeCovariances(const urban_nav_input::TrajectoryFile& estimate,
                                                         const Matched& matched,
                                                         const std::vector<urban_nav_core::CovarianceRow>& rows) {
  std::map<StampNs, const urban_nav_core::CovarianceRow*> by_stamp;
  for (const urban_nav_core::CovarianceRow& row : rows) by_stamp[row.stamp] = &row;
  std::vector<urban_nav_core::Matrix6d> result;
  for (const std::size_t index : matched.estimate_index) {
    const urban_nav_core::CovarianceRow* row = nullptr;
    if (estimate.stamped) {
      const auto found = by_stamp.find(estimate.trajectory[index].stamp);
      row = found == by_stamp.end() ? nullptr : found->second;
    } else if (rows.size() == estimate.poses.size()) {
      row = &rows[index];
    }
    if (row == nullptr) return {};
    result.push_back(row->covariance);
  }
  return result;
}

Evaluation::End evaluateEnd(const Matched& matched, const std::vector<urban_nav_core::Matrix6d>& covariances) {
  const Pose truth = matched.truth.front().inverse() * matched.truth.back();
  const Pose estimate = matched.estimate.front().inverse() * matched.estimate.back();
  Evaluation::End end;
  end.m = urban_nav_core::distanceBetween(truth, estimate);
  end.deg = urban_nav_core::angleBetween(truth, estimate) * 180.0 / M_PI;
  if (!covariances.empty()) end.nees = urban_nav_core::nees(truth, {estimate, covariances.back()});
  return end;
}

/// Returns the covariance of T_first_i of a truth whose poses have independent errors: that of pose i, that of the
/// first pose, and the rotation error of the first pose times the distance.
Matrix6d truthCovariance(const Pose& T_first_i, const TruthSigma& sigma) {
  const double m2 = sigma.m * sigma.m, rad2 = std::pow(sigma.deg * M_PI / 180.0, 2);
  Matrix6d covariance = Matrix6d::Zero();
  const urban_nav_core::Matrix3d arm = urban_nav_core::skew(T_first_i.t());
  covariance.topLeftCorner<3, 3>() = 2.0 * m2 * urban_nav_core::Matrix3d::Identity() + rad2 * arm * arm.transpose();
  covariance.topRightCorner<3, 3>() = -rad2 * arm;
  covariance.bottomLeftCorner<3, 3>() = -rad2 * arm.transpose();
  covariance.bottomRightCorner<3, 3>() = 2.0 * rad2 * urban_nav_core::Matrix3d::Identity();
  return covariance;
}

}  // namespace

Evaluation evaluate(const urban_nav_input::TrajectoryFile& truth, const urban_nav_input::TrajectoryFile& estimate,
                    const std::vector<urban_nav_core::CovarianceRow>& covariances, const EvaluationOptions& options) {
  using urban_nav_core::TrajectoryAlignment;
  Evaluation evaluation;
  evaluation.truth = truth.path;
  evaluation.frames_truth = truth.poses.size();
  evaluation.frames_estimate = estimate.poses.size();
  evaluation.matched = match(truth, estimate, evaluation, options.find_offset);
  evaluation.axes = detectAxes(evaluation.matched);
  applyAxes(evaluation.axes, evaluation.matched);
  const Matched& m = evaluation.matched;
  evaluation.length_m = urban_nav_core::pathLength(m.truth);
  evaluation.first = urban_nav_core::absoluteError(m.truth, m.estimate, TrajectoryAlignment::First);
  evaluation.se3 = urban_nav_core::absoluteError(m.truth, m.estimate, TrajectoryAlignment::Se3);
  evaluation.sim3 = urban_nav_core::absoluteError(m.truth, m.estimate, TrajectoryAlignment::Sim3);
  evaluation.ten_frames =
      urban_nav_core::relativeError(m.truth, m.estimate, {urban_nav_core::Span::Unit::Frames, 10.0});
  for (const urban_nav_core::Span& span : options.spans) {
    if (const auto error = urban_nav_core::relativeError(m.truth, m.estimate, span))
      evaluation.spans.push_back({span, *error});
  }
  evaluation.covariances = computeCovariances(estimate, m, covariances);
  for (std::size_t i = 0; i < evaluation.covariances.size(); ++i) {
    Matrix6d& covariance = evaluation.covariances[i];
    covariance = applyAxes(evaluation.axes, covariance);
    if (i > 0) covariance += truthCovariance(m.truth.front().inverse() * m.truth[i], options.truth_sigma);
  }
  if (!evaluation.covariances.empty())
    evaluation.nees = urban_nav_core::neesOfTrajectory(m.truth, m.estimate, evaluation.covariances);
  evaluation.end = evaluateEnd(m, evaluation.covariances);
  return evaluation;
}

void addToJson(const Evaluation& evaluation, Json& json) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // printed as null
  json["truth"] = evaluation.truth;
  json["ate_m"] = evaluation.first.rmse;
  json["ate_se3_m"] = evaluation.se3.rmse;
  json["ate_sim3_m"] = evaluation.sim3.rmse;
  json["rpe_percent"] = evaluation.ten_frames ? evaluation.ten_frames->percent : kNone;
  json["rpe_deg_per_m"] = evaluation.ten_frames ? evaluation.ten_frames->deg_per_m : kNone;
  json["step_ratio"] = evaluation.ten_frames ? evaluation.ten_frames->step_ratio : kNone;
  json["nees_mean"] = evaluation.nees ? evaluation.nees->mean : kNone;
  Json& end = json["end"] = Json::object();
  end["error_m"] = evaluation.end.m;
  end["error_deg"] = evaluation.end.deg;
  end["nees"] = evaluation.end.nees.value_or(kNone);
  json["frames_truth"] = evaluation.frames_truth;
  json["frames_estimate"] = evaluation.frames_estimate;
  json["frames_matched"] = evaluation.matched.truth.size();
  json["length_truth_m"] = evaluation.length_m;
  if (evaluation.offset) {
    json["offset_s"] = 1e-9 * static_cast<double>(evaluation.offset->offset);
    json["offset_applied"] = evaluation.offset_applied;
  }
  if (evaluation.axes.axes != Axes::Same) json["axes"] = axesKey(evaluation.axes);
  Json& spans = json["spans"] = Json::object();
  for (const SpanError& each : evaluation.spans) {
    Json& entry = spans[printSpan(each.span)] = Json::object();
    entry["percent"] = each.error.percent;
    entry["deg_per_m"] = each.error.deg_per_m;
    entry["count"] = each.error.count;
  }
}

std::vector<urban_nav_core::Span> parseSpans(const std::vector<std::string>& words) {
  std::vector<urban_nav_core::Span> spans;
  for (const std::string& word : words) {
    const std::optional<urban_nav_core::Span> span = urban_nav_core::parseSpan(word);
    if (!span) throw UserError("--spans", "\"" + word + "\"", "frames or metres above zero: 10f, 10m, 100m");
    spans.push_back(*span);
  }
  return spans;
}

std::string printSpan(const urban_nav_core::Span& span) {
  std::ostringstream text;
  text << span;
  return text.str();
}

}  // namespace urban_nav
