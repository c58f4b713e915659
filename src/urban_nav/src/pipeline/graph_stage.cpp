// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/graph_stage.hpp"

#include <algorithm>
#include <chrono>

#include "pipeline/vo_files.hpp"
#include "pose_graph/graph_file.hpp"
#include "urban_nav_core/trajectory/interpolate.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using pose_graph::Closure;
using pose_graph::PoseGraph;
using pose_graph::Track;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr StampNs kLongestGap = 1'000'000'000;  // ns between frames that odometry bridges for a closure in between
constexpr StampNs kOutside =
    100'000'000;  // ns before the first and behind the last frame that their motion is good for
// Of a transform whose file does not say how good it is: five times what loop closure by stereo reaches (paper, section 4.1).
constexpr double kUnknownSigmaM = 0.25, kUnknownSigmaRad = 0.05;
constexpr double kMetresPerRadian = 10.0;  // for display of free directions: a turn moves what is seen at this distance

/// Where a moment lies beside the nearest frame.
struct Moment {
  StampNs node = 0;
  Pose T_node_moment;
};

std::optional<Moment> momentOf(const Trajectory& odometry, StampNs stamp) {
  if (odometry.empty()) return std::nullopt;
  const auto& nearest = odometry[odometry.nearest(stamp)];
  if (nearest.stamp == stamp) return Moment{stamp, Pose()};
  std::optional<Pose> there = odometry.at(stamp, kLongestGap);
  if (!there && odometry.size() >= 2 && std::abs(stamp - nearest.stamp) <= kOutside) {
    const bool before = stamp < nearest.stamp;
    const auto& a = before ? odometry[0] : odometry[odometry.size() - 2];
    const auto& b = before ? odometry[1] : odometry[odometry.size() - 1];
    there = urban_nav_core::interpolate(a.pose, b.pose,
                                        static_cast<double>(stamp - a.stamp) / static_cast<double>(b.stamp - a.stamp));
  }
  if (!there) return std::nullopt;
  return Moment{nearest.stamp, nearest.pose.inverse() * *there};
}

class Offers {
 public:
  Offers(GraphRun& run, const std::vector<const VoRun*>& runs) : run_(run) {
    for (const VoRun* one : runs) odometry_.push_back(trajectoryOf(*one));
  }

  /// Empty where the graph took it, else why not.
  std::string offer(const ClosureRow& row) {
    if (!row.T_a_b) return "no transform in the file, and no stage that finds one";
    Closure closure;
    Pose T_a_b = *row.T_a_b;
    for (const bool at_a : {true, false}) {
      const std::string& name = at_a ? row.session_a : row.session_b;
      const auto session = std::find(run_.sessions.begin(), run_.sessions.end(), name);
      if (session == run_.sessions.end()) return "no session \"" + name + "\" in this map";
      const auto moment = momentOf(odometry_[static_cast<std::size_t>(session - run_.sessions.begin())],
                                   at_a ? row.stamp_a : row.stamp_b);
      if (!moment)
        return "no frames around " + urban_nav_core::printStamp(at_a ? row.stamp_a : row.stamp_b) + " s in " + name;
      (at_a ? closure.a : closure.b) = {name, moment->node};
      T_a_b = at_a ? moment->T_node_moment * T_a_b : T_a_b * moment->T_node_moment.inverse();
    }
    const double sigma_m = row.sigma_m > 0.0 ? row.sigma_m : kUnknownSigmaM;
    const double sigma_rad = row.sigma_rad > 0.0 ? row.sigma_rad : kUnknownSigmaRad;
    closure.kind = row.kind == "icp" ? pose_graph::EdgeKind::Icp : pose_graph::EdgeKind::Stereo;
    closure.source = row.where;
    closure.measured.T_a_b = T_a_b;
    closure.measured.information.diagonal().head<3>().setConstant(1.0 / (sigma_m * sigma_m));
    closure.measured.information.diagonal().tail<3>().setConstant(1.0 / (sigma_rad * sigma_rad));
    try {
      run_.graph.addClosure(closure);
    } catch (const urban_nav_core::UserError& error) {
      return error.what();
    }
    return {};
  }

 private:
  GraphRun& run_;
  std::vector<Trajectory> odometry_;
};

void judge(GraphRun& run) {
  std::size_t refused = 0;
  const std::string* first = nullptr;
  for (ClosureRow& row : run.closures) {
    if (!row.reason.empty()) {
      row.verdict = "rejected";
      if (refused++ == 0) first = &row.reason;
      continue;
    }
    for (const auto& [id, closure] : run.graph.closures()) {
      if (closure.source != row.where) continue;
      row.verdict = closure.verdict == pose_graph::ClosureVerdict::Accepted ? "accepted" : "rejected";
      row.reason = closure.reason;
      row.weight = closure.weight;
    }
  }
  if (refused > 0)
    run.warnings.push_back(std::to_string(refused) + " closures could not be used; the first: " + *first);
}

// All sessions from one factorisation.
std::vector<std::vector<Matrix6d>> covariancesOf(const PoseGraph& graph, const std::vector<std::string>& sessions) {
  std::vector<pose_graph::Rigid<3>> poses;
  for (const Track& track : graph.tracks())
    for (const Pose& pose : track.map) poses.push_back(pose_graph::rigidOf<3>(pose));
  const pose_graph::Marginals<3> marginals(graph.problem(), poses, graph.weights());
  std::vector<std::vector<Matrix6d>> made(sessions.size());
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    const Track* track = graph.track(sessions[s]);
    if (track == nullptr || track->stamps.empty()) continue;
    const int first = *graph.poseNumber({track->session, track->stamps.front()});
    for (std::size_t i = 0; i < track->stamps.size(); ++i)
      made[s].push_back(displayed(marginals.ofPose(first + static_cast<int>(i)), kMetresPerRadian));
  }
  return made;
}

}  // namespace

bool GraphRun::joined(std::size_t session) const {
  if (session == 0) return true;
  const Track* track = graph.track(sessions[session]);
  return track != nullptr && !track->part.empty() &&
         std::all_of(track->part.begin(), track->part.end(), [](int part) { return part == 0; });
}

Trajectory GraphRun::trajectory(std::size_t session) const {
  Trajectory made;
  if (const Track* track = graph.track(sessions[session]))
    for (std::size_t i = 0; i < track->stamps.size(); ++i) made.append(track->stamps[i], track->map[i]);
  return made;
}

GraphRun runGraph(const pose_graph::Parameters& parameters, const std::vector<const VoRun*>& runs,
                  const std::vector<std::string>& sessions, std::vector<ClosureRow> closures) {
  GraphRun made;
  made.graph = PoseGraph(parameters);
  made.sessions = sessions;
  made.closures = std::move(closures);
  for (std::size_t s = 0; s < runs.size(); ++s) {
    made.graph.beginSession(sessions[s]);
    for (std::size_t i = 1; i < runs[s]->settled.size(); ++i)
      made.graph.addOdometry(sessions[s], runs[s]->settled[i].from_previous);
  }
  Offers offers(made, runs);
  for (ClosureRow& row : made.closures) row.reason = offers.offer(row);
  const auto begin = std::chrono::steady_clock::now();
  made.relaxed = made.graph.relax();
  made.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  judge(made);
  made.covariances = covariancesOf(made.graph, sessions);
  for (std::size_t s = 1; s < sessions.size(); ++s)
    if (!made.joined(s))
      made.warnings.push_back("session " + sessions[s] + " is a map of its own: no closures that agree join it to " +
                              sessions[0]);
  const urban_nav_core::Status status = made.graph.status();
  if (status.reason == static_cast<int>(pose_graph::Trouble::BrokenChain)) made.warnings.push_back(status.sentence);
  return made;
}

}  // namespace urban_nav
