// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/session_evaluation.hpp"

#include <algorithm>
#include <filesystem>

#include "evaluation/truth.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

using Covariances = std::vector<urban_nav_core::Matrix6d>;

std::vector<urban_nav_core::StampNs> stamps(const VoRun& run) {
  std::vector<urban_nav_core::StampNs> made;
  for (const VoRow& row : run.rows) made.push_back(row.stamp);
  return made;
}

/// Returns a row per smoothed frame. `relaxed` replaces the covariances of odometry as far as it goes.
std::vector<urban_nav_core::CovarianceRow> covarianceRows(const VoRun& run, const Covariances& relaxed) {
  std::vector<urban_nav_core::CovarianceRow> rows;
  for (const swf_vo::Settled& settled : run.settled)
    rows.push_back({settled.stamp, settled.status.health, settled.T_odom_base.covariance});
  for (std::size_t i = 0; i < std::min(rows.size(), relaxed.size()); ++i) rows[i].covariance = relaxed[i];
  return rows;
}

Evaluation compare(const MapContext& context, const VoRun& run, const TrajectoryFile& truth,
                   const urban_nav_core::Trajectory& poses, const Covariances& covariances) {
  EvaluationOptions options;
  options.spans = {{urban_nav_core::Span::Unit::Metres, 10.0}, {urban_nav_core::Span::Unit::Metres, 100.0}};
  const std::string path = (std::filesystem::path(context.options.out) / "trajectory.tum").string();
  TrajectoryFile estimate{path, true, poses, {}};
  for (const urban_nav_core::StampedPose& pose : poses) estimate.poses.push_back(pose.pose);
  return evaluate(truth, estimate, covarianceRows(run, covariances), options);
}

std::optional<TrajectoryFile> readTruth(const MapContext& context, const MapSession& session) {
  const std::string& path = context.options.truth;
  if (path.empty()) return findTruth(session.input, session.info, context.options.source);
  return truthOfBase(readTrajectory(path), session.info, stamps(*session.vo));
}

}  // namespace

std::vector<SessionEvaluations> evaluateSessions(const MapContext& context) {
  const std::size_t previous = context.previous.runs.size();
  std::vector<SessionEvaluations> evaluations(context.trajectories.size());
  for (std::size_t i = 0; i < context.sessions.size(); ++i) {
    const MapSession& session = context.sessions[i];
    const SessionTrajectory& trajectory = context.trajectories[previous + i];
    SessionEvaluations& made = evaluations[previous + i];
    try {
      const std::optional<TrajectoryFile> truth = readTruth(context, session);
      if (!truth) continue;
      for (const std::string& note : truth->notes) context.console.warn(note);
      made.map = compare(context, *session.vo, *truth, trajectory.T_map_base, trajectory.covariances);
      if (context.relaxed) made.odometry = compare(context, *session.vo, *truth, smoothedTrajectory(*session.vo), {});
      context.console.info("truth: " + truth->path +
                           (context.options.truth.empty() ? " (found; it is used for the report alone)" : ""));
    } catch (const urban_nav_core::Error& error) {
      context.console.warn(std::string("the truth is left out of the report: ") + error.what());
    }
  }
  return evaluations;
}

}  // namespace urban_nav
