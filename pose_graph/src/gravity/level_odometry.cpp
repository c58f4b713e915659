// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/level_odometry.hpp"

#include <algorithm>

#include "condense/chain_sum.hpp"
#include "gravity/tilt_drift.hpp"
#include "pose_graph/graph_file.hpp"

namespace pose_graph {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

/// Corrects an unbroken run. Its steps are edges [first_edge, first_edge + stamps.size() - 1), its first pose is
/// first_pose. Returns its largest tilt, rad.
double levelRun(Problem<3>& problem, std::size_t first_edge, std::size_t first_pose, const std::vector<StampNs>& stamps,
                const std::vector<SpecificForce>& forces) {
  Trajectory odometry;
  std::vector<double> variance{0.0};
  Rigid<3> T_first_pose;
  odometry.append(stamps.front(), {});
  for (std::size_t i = 0; i + 1 < stamps.size(); ++i) {
    const Edge<3>& step = problem.edges[first_edge + i];
    TangentMatrix<3> covariance;
    if (!invert<3>(step.information, covariance)) return 0.0;
    T_first_pose = T_first_pose * step.Z;
    odometry.append(stamps[i + 1], toPose(T_first_pose));
    variance.push_back(variance.back() + covariance.bottomRightCorner<3, 3>().trace() / 3.0);
  }
  const std::vector<Tilt> tilts = tiltDrift(odometry, variance, forces);
  if (tilts.empty()) return 0.0;
  const auto correctionAt = [&](std::size_t i) {
    const Eigen::Vector3d turn = tiltAt(tilts, stamps.front(), stamps[i]);
    return Eigen::Quaterniond(urban_nav_core::expSo3(turn) * odometry[i].pose.q());
  };
  Eigen::Quaterniond before = correctionAt(0);
  for (std::size_t i = 0; i + 1 < stamps.size(); ++i) {
    const Eigen::Quaterniond after = correctionAt(i + 1);
    Edge<3>& step = problem.edges[first_edge + i];
    step.Z.R = (before.inverse() * after).normalized().toRotationMatrix();
    problem.poses[first_pose + i + 1] = problem.poses[first_pose + i] * step.Z;
    before = after;
  }
  double most = 0.0;
  for (const Tilt& tilt : tilts) most = std::max(most, tilt.turn.norm());
  return most;
}

}  // namespace

double levelOdometry(Problem<3>& problem, std::size_t chains, const std::vector<std::vector<StampNs>>& stamps,
                     const std::vector<std::vector<SpecificForce>>& forces) {
  double most = 0.0;
  std::size_t edge = 0, pose = 0;
  for (std::size_t t = 0; t < stamps.size(); ++t) {
    const std::size_t end = pose + stamps[t].size();
    const auto leadsOn = [&](std::size_t from) {
      return edge < chains && problem.edges[edge].from == static_cast<int>(from) && from + 1 < end;
    };
    while (pose < end) {
      const std::size_t first = pose, first_edge = edge;
      for (; leadsOn(pose); ++pose) ++edge;
      ++pose;
      if (forces[t].empty()) continue;
      const auto begin = stamps[t].end() - static_cast<std::ptrdiff_t>(end - first);
      const std::vector<StampNs> of_run(begin, begin + static_cast<std::ptrdiff_t>(pose - first));
      most = std::max(most, levelRun(problem, first_edge, first, of_run, forces[t]));
    }
  }
  return most;
}

}  // namespace pose_graph
