// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_evaluation.hpp"

#include <algorithm>
#include <filesystem>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/truth/truth.hpp"

namespace urban_nav {

namespace {

using Covariances = std::vector<urban_nav_core::Matrix6d>;

std::vector<urban_nav_core::StampNs> stamps(const SessionOdometry& run) {
  std::vector<urban_nav_core::StampNs> result;
  for (const OdometryFrame& row : run.frames) result.push_back(row.stamp);
  return result;
}

/// Returns a row per smoothed frame. `relaxed` replaces the first covariances of odometry.
std::vector<urban_nav_core::CovarianceRow> covarianceRows(const SessionOdometry& run, const Covariances& relaxed) {
  std::vector<urban_nav_core::CovarianceRow> rows;
  for (const SmoothedFrame& settled : run.settled)
    rows.push_back({settled.stamp, settled.status.health, settled.T_odom_base.covariance});
  for (std::size_t i = 0; i < std::min(rows.size(), relaxed.size()); ++i) rows[i].covariance = relaxed[i];
  return rows;
}

Evaluation compare(const MapContext& context, const SessionOdometry& run, const urban_nav_input::TrajectoryFile& truth,
                   const urban_nav_core::Trajectory& poses, const Covariances& covariances) {
  EvaluationOptions options;
  options.spans = {{urban_nav_core::Span::Unit::Metres, 10.0}, {urban_nav_core::Span::Unit::Metres, 100.0}};
  const std::string path = (std::filesystem::path(context.options.out) / "trajectory.tum").string();
  urban_nav_input::TrajectoryFile estimate{path, true, poses, {}};
  for (const urban_nav_core::StampedPose& pose : poses) estimate.poses.push_back(pose.pose);
  return evaluate(truth, estimate, covarianceRows(run, covariances), options);
}

std::optional<urban_nav_input::TrajectoryFile> readTruth(const MapContext& context, const MapSession& session) {
  const std::string& path = context.options.truth;
  if (path.empty()) return urban_nav_input::findTruth(session.input, session.info, context.options.source);
  return urban_nav_input::truthOfBase(urban_nav_input::readTrajectory(path), session.info, stamps(*session.odometry));
}

}  // namespace

std::vector<SessionEvaluations> evaluateSessions(const MapContext& context) {
  std::vector<SessionEvaluations> evaluations(context.trajectories.size());
  for (std::size_t i = 0; i < context.sessions.size(); ++i) {
    const MapSession& session = context.sessions[i];
    const SessionTrajectory& trajectory = context.trajectories[context.number(i)];
    SessionEvaluations& result = evaluations[context.number(i)];
    try {
      const std::optional<urban_nav_input::TrajectoryFile> truth = readTruth(context, session);
      if (!truth) continue;
      for (const std::string& note : truth->notes) context.console.warn(note);
      result.map = compare(context, *session.odometry, *truth, trajectory.T_map_base, trajectory.covariances);
      if (context.relaxed)
        result.odometry = compare(context, *session.odometry, *truth, smoothedTrajectory(*session.odometry), {});
      context.console.info("truth: " + truth->path +
                           (context.options.truth.empty() ? " (found; used for the report only)" : ""));
    } catch (const urban_nav_core::Error& error) {
      context.console.warn(std::string("the truth is left out of the report: ") + error.what());
    }
  }
  return evaluations;
}

}  // namespace urban_nav
