// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "base/plot.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/map_levels.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "pose_graph_ceres/solve_by_ceres.hpp"
#include "pose_graph_relative/relative_pcg.hpp"
#include "topics/graph/closure_import.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav {

using pose_graph::Closure;
using pose_graph::Level;
using pose_graph::PoseGraph;
using pose_graph::Track;
using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;

namespace {

constexpr double kMetresPerRadian = 10.0;  // for display of free directions

constexpr std::size_t kPlaneRounds = 2;
constexpr double kSettled = 0.005;  // m: smaller moves do not change the planes found

constexpr double kManyRejected = 3.0;  // one of this many fixes rejected is reported
constexpr double kOptimistic = 2.0;    // ratio to the stated standard deviation that is reported
constexpr double kImplausible = 3.0;   // ratio to the standard deviations of odometry that is reported

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Copies the verdicts of the graph. `previous`: number of closures of previous runs; those replaced by a new one are
/// removed.
void assessClosures(GraphRun& run, std::size_t previous) {
  std::vector<MetricClosure> closures;
  std::vector<ClosureAssessment> assessments;
  std::size_t refused = 0;
  std::string first;
  for (std::size_t i = 0; i < run.closures.size(); ++i) {
    ClosureAssessment& assessment = run.assessments[i];
    if (assessment.id < 0) {
      assessment.reason = run.rejected_by_hand[static_cast<std::size_t>(-1 - assessment.id)].reason;
    } else if (assessment.id > 0) {
      const Closure& closure = run.graph.closures().at(assessment.id);
      assessment = {assessment.id, closure.verdict, closure.reason, closure.weight};
    } else if (assessment.reason.empty() && i < previous) {
      continue;
    } else if (refused++ == 0) {
      first = assessment.reason;
    }
    closures.push_back(std::move(run.closures[i]));
    assessments.push_back(std::move(assessment));
  }
  run.closures = std::move(closures);
  run.assessments = std::move(assessments);
  if (refused > 0) run.warnings.push_back(std::to_string(refused) + " closures could not be used; the first: " + first);
}

/// Relaxes with the measured specific forces. The maps stay in the frame of their first poses; GraphRun::levels has the
/// direction of gravity.
pose_graph::Relaxed relaxGraph(PoseGraph& graph, const std::vector<const SessionOdometry*>& runs) {
  pose_graph::Batch batch = graph.batch();
  for (std::size_t s = 0; s < runs.size(); ++s) batch.forces[s] = runs[s]->forces;
  pose_graph::run(batch, {}, {pose_graph::relativeSolver(), pose_graph::ceresSolver()});
  return graph.take(batch);
}

/// Calls relaxGraph() with the constraints of edits.
void relax(GraphRun& run, pose_graph::EditedGraph& edited, const std::vector<const SessionOdometry*>& runs,
           const SessionGrounds& grounds);

std::vector<pose_graph::ClosureId> planeIds(const PoseGraph& graph) {
  std::vector<pose_graph::ClosureId> ids;
  for (const auto& [id, closure] : graph.closures())
    if (closure.kind == pose_graph::EdgeKind::Plane) ids.push_back(id);
  return ids;
}

/// Returns the largest distance between poses before and after, each in the frame of its map's first pose.
double largestMove(const std::vector<Track>& before, const std::vector<Track>& after) {
  double largest = 0.0;
  for (std::size_t t = 0; t < before.size(); ++t)
    for (std::size_t i = 0; i < before[t].map.size(); ++i)
      largest = std::max(largest, distanceBetween(before[t].map[i], after[t].map[i]));
  return largest;
}

/// Sorts constraints from planes by their poses, so that the relaxation does not depend on their origin.
void sortPlanes(const GraphRun& run, std::vector<Closure>& planes) {
  const auto place = [&](const pose_graph::NodeRef& ref) {
    const auto found = std::find(run.sessions.begin(), run.sessions.end(), ref.session);
    return std::make_pair(found - run.sessions.begin(), ref.stamp);
  };
  std::stable_sort(planes.begin(), planes.end(), [&](const Closure& a, const Closure& b) {
    return std::make_pair(place(a.a), place(a.b)) < std::make_pair(place(b.a), place(b.b));
  });
}

void addPlanes(GraphRun& run, std::vector<Closure> planes) {
  sortPlanes(run, planes);
  for (const Closure& plane : planes) run.graph.addClosure(plane);
}

/// Relaxes again with constraints from the planes of the relaxed map, until the map no longer moves.
void relaxWithPlanes(GraphRun& run, pose_graph::EditedGraph& edited, const std::vector<const SessionOdometry*>& runs,
                     const SessionGrounds& grounds, const PlaneFinder& find_planes) {
  const auto begin = Clock::now();
  const std::vector<Track> without_planes = run.graph.tracks();
  run.planes.searched = true;
  double moved = kSettled;
  while (run.planes.rounds < kPlaneRounds && moved >= kSettled) {
    const PlaneClosures found = find_planes(run);
    const std::vector<pose_graph::ClosureId> earlier = planeIds(run.graph);
    run.planes.shared = found.shared;
    if (found.closures.empty() && earlier.empty()) break;
    for (const pose_graph::ClosureId id : earlier) run.graph.removeClosure(id);
    addPlanes(run, found.closures);
    const std::vector<Track> before = run.graph.tracks();
    relax(run, edited, runs, grounds);
    moved = largestMove(before, run.graph.tracks());
    ++run.planes.rounds;
  }
  run.planes.moved = largestMove(without_planes, run.graph.tracks());
  run.planes.ms = millisecondsSince(begin);
}

VerdictCounts countVerdicts(const PoseGraph& graph, bool of_planes) {
  VerdictCounts counts;
  for (const auto& [id, closure] : graph.closures()) {
    if ((closure.kind == pose_graph::EdgeKind::Plane) != of_planes) continue;
    if (closure.verdict == urban_nav_core::ClosureVerdict::Accepted) ++counts.accepted;
    else ++(closure.verdict == urban_nav_core::ClosureVerdict::Waiting ? counts.waiting : counts.rejected);
  }
  return counts;
}

// Uses one factorisation for all sessions. GPS fixes are not edges, but reveal length errors.
std::vector<std::vector<Matrix6d>> computeCovariances(const GraphRun& run) {
  const PoseGraph& graph = run.graph;
  const std::vector<std::string>& sessions = run.sessions;
  std::vector<pose_graph::Rigid<3>> poses;
  std::vector<pose_graph::NodeRef> refs;
  for (const Track& track : graph.tracks())
    for (std::size_t i = 0; i < track.map.size(); ++i) {
      poses.push_back(pose_graph::toRigid<3>(track.map[i]));
      refs.push_back({track.session, track.stamps[i]});
    }
  const auto at = [](int pose) { return static_cast<std::size_t>(pose); };
  std::vector<pose_graph::CommonError<3>> common;
  if (graph.fixUse().used == 0) common = graph.commonErrors();
  const pose_graph::Marginals<3> marginals(graph.problem(), poses, graph.weights(), common);
  std::vector<std::vector<Matrix6d>> made(sessions.size());
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    const Track* track = graph.track(sessions[s]);
    if (track == nullptr || track->stamps.empty()) continue;
    const int first = *graph.poseNumber({track->session, track->stamps.front()});
    for (std::size_t i = 0; i < track->stamps.size(); ++i) {
      const std::optional<pose_graph::NodeRef>& by_hand = run.origins[run.findMap(s)];
      const int pose = first + static_cast<int>(i),
                origin = by_hand ? *graph.poseNumber(*by_hand) : marginals.first(pose);
      Matrix6d covariance = displayed(marginals.between(origin, pose), kMetresPerRadian);
      if (pose != origin)
        covariance += pose_graph::relativeNoise(toPose(poses[at(origin)]).inverse() * track->map[i],
                                                graph.ownNoise(refs[at(origin)]), graph.ownNoise(refs[at(pose)]));
      made[s].push_back(covariance);
    }
  }
  return made;
}

/// Sets covariances of sessions without closures to those of odometry.
void leaveToOdometry(GraphRun& run, const std::vector<const SessionOdometry*>& runs) {
  std::set<std::string> touched;
  for (const auto& [id, closure] : run.graph.closures())
    if (closure.verdict == urban_nav_core::ClosureVerdict::Accepted)
      touched.insert({closure.a.session, closure.b.session});
  for (std::size_t s = 0; s < runs.size(); ++s) {
    if (touched.count(run.sessions[s]) != 0 || run.origins[run.findMap(s)] ||
        run.covariances[s].size() != runs[s]->settled.size())
      continue;
    for (std::size_t i = 0; i < runs[s]->settled.size(); ++i)
      run.covariances[s][i] = runs[s]->settled[i].T_odom_base.covariance;
  }
}

/// Returns a name of the rig of a run: the description of the cameras of the first run with the same cameras.
std::string nameRig(const std::vector<const SessionOdometry*>& runs, std::size_t run) {
  const std::string cameras = describeCameras(*runs[run]);
  for (std::size_t earlier = 0; earlier < run; ++earlier) {
    const std::string known = describeCameras(*runs[earlier]);
    if (urban_nav_registration::isSameCalibration(known, cameras)) return known;
  }
  return cameras;
}

/// Adds warnings about the use of GPS.
void addFixWarnings(const pose_graph::Parameters& parameters, GraphRun& run) {
  if (!parameters.gps) return;
  const pose_graph::FixUse& use = run.graph.fixUse();
  const std::size_t all = use.used + use.rejected;
  if (all == 0) {
    run.warnings.emplace_back("pose_graph.gps: no GPS fix at the time of a pose; GPS is not used");
    return;
  }
  if (use.unplaced > 0)
    run.warnings.push_back("pose_graph.gps: " + std::to_string(use.unplaced) + " of " +
                           std::to_string(all + use.unplaced) +
                           " GPS fixes are not used: there is no pose at their time");
  if (kManyRejected * static_cast<double>(use.rejected) > static_cast<double>(all))
    run.warnings.push_back("pose_graph.gps: " + std::to_string(use.rejected) + " of " + std::to_string(all) +
                           " GPS fixes contradict odometry and closures; not used");
  if (use.sigma_factor > kOptimistic)
    run.warnings.push_back("pose_graph.gps: the receiver's standard deviations are too small by a factor of " +
                           urban_nav_core::formatNumber(use.sigma_factor, 2));
}

/// Adds warnings about the selection among closures.
void addSelectionWarnings(GraphRun& run) {
  const pose_graph::Relaxed& relaxed = run.relaxed;
  for (const std::string& warning :
       pose_graph::selectionWarnings(relaxed.selection, relaxed.rejected, relaxed.closures))
    run.warnings.push_back(warning);
  for (const pose_graph::Relaxed::Slip& slip : relaxed.slips) run.warnings.push_back(toSentence(slip));
  const double errs = std::sqrt(run.graph.odometryVariance());
  if (errs >= kImplausible)
    run.warnings.push_back("the accepted closures contradict the covariance of odometry: its errors are at least " +
                           urban_nav_core::formatNumber(errs, 2) + " times its standard deviations");
}

/// Returns the trajectory in the frame of the graph, in which the first pose of a map is the identity.
Trajectory relaxedTrack(const GraphRun& run, std::size_t session) {
  Trajectory made;
  if (const Track* track = run.graph.track(run.sessions[session]))
    for (std::size_t i = 0; i < track->stamps.size(); ++i) made.append(track->stamps[i], track->map[i]);
  return made;
}

/// Returns the mean rotation covariance of a session, assuming fully correlated errors.
Matrix3d meanRotationCovariance(const GraphRun& run, std::size_t session) {
  Matrix3d rotations = Matrix3d::Zero();
  for (const Matrix6d& covariance : run.covariances[session]) rotations += covariance.bottomRightCorner<3, 3>();
  return rotations / static_cast<double>(std::max<std::size_t>(1, run.covariances[session].size()));
}

/// Sets unknown levels of maps from the first session of each map with a known `measured` direction.
template <typename Measured>
void addLevels(const GraphRun& run, const std::vector<std::vector<Measured>>& measured, std::vector<Level>& levels) {
  for (std::size_t s = 0; s < measured.size(); ++s) {
    const std::size_t map = run.findMap(s);
    const Track* track = run.graph.track(run.sessions[map]);
    if (levels[map].known() || measured[s].empty() || track == nullptr || track->map.empty()) continue;
    const Level level =
        pose_graph::withRotations(pose_graph::estimateLevel(relaxedTrack(run, s), measured[s], track->map.front()),
                                  meanRotationCovariance(run, s));
    if (level.known() || s == map) levels[map] = level;
  }
}

/// Returns the pose of a session in the frame of the graph. Requires a pose at this time.
Pose poseInGraph(const GraphRun& run, const pose_graph::NodeRef& ref) {
  const Track& track = *run.graph.track(ref.session);
  const auto found = std::lower_bound(track.stamps.begin(), track.stamps.end(), ref.stamp);
  return track.map[static_cast<std::size_t>(found - track.stamps.begin())];
}

std::vector<Level> estimateLevels(const GraphRun& run, const std::vector<const SessionOdometry*>& runs,
                                  const SessionGrounds& grounds) {
  std::vector<Level> levels(runs.size());
  std::vector<std::vector<urban_nav_core::SpecificForce>> forces;
  for (std::size_t s = 0; s < runs.size(); ++s) {
    forces.push_back(runs[s]->forces);
    levels[s].sentence = relaxedTrack(run, s).empty() ? "the session has fewer than two poses"
                                                      : "no accelerometer and no ground plane were measured";
  }
  addLevels(run, forces, levels);
  addLevels(run, grounds, levels);
  return levels;
}

std::vector<std::optional<pose_graph::NodeRef>> findOrigins(const GraphRun& run,
                                                            const pose_graph::EditedGraph& edited) {
  std::vector<std::optional<pose_graph::NodeRef>> origins(run.sessions.size());
  for (std::size_t s = 0; s < run.sessions.size(); ++s)
    if (run.findMap(s) == s) origins[s] = edited.origin(run.sessions[s]);
  return origins;
}

void relax(GraphRun& run, pose_graph::EditedGraph& edited, const std::vector<const SessionOdometry*>& runs,
           const SessionGrounds& grounds) {
  edited.relax(
      [&] {
        run.relaxed = relaxGraph(run.graph, runs);
        run.levels.clear();
      },
      [&](const pose_graph::SessionId& session) {
        if (run.levels.empty()) {
          run.covariances.resize(runs.size());
          run.levels = estimateLevels(run, runs, grounds);
          run.origins = findOrigins(run, edited);
        }
        return run.mapFromGraph(static_cast<std::size_t>(std::find(run.sessions.begin(), run.sessions.end(), session) -
                                                         run.sessions.begin()));
      });
}

}  // namespace

std::size_t GraphRun::findMap(std::size_t session) const {
  const Track* track = graph.track(sessions[session]);
  if (track == nullptr) return session;
  const std::size_t map = pose_graph::findMap(graph.tracks(), static_cast<std::size_t>(track - graph.tracks().data()));
  return static_cast<std::size_t>(std::find(sessions.begin(), sessions.end(), graph.tracks()[map].session) -
                                  sessions.begin());
}

std::vector<std::size_t> GraphRun::maps() const {
  std::vector<std::size_t> maps;
  for (std::size_t s = 0; s < sessions.size(); ++s) maps.push_back(findMap(s));
  return maps;
}

std::size_t GraphRun::sessionsJoined() const {
  std::size_t count = 0;
  for (std::size_t s = 0; s < sessions.size(); ++s) count += joined(s) ? 1 : 0;
  return count;
}

VerdictCounts GraphRun::closureVerdicts() const { return countVerdicts(graph, false); }
VerdictCounts GraphRun::planeVerdicts() const { return countVerdicts(graph, true); }

Pose GraphRun::mapFromGraph(std::size_t session) const {
  const std::size_t map = findMap(session);
  if (map >= levels.size()) return {};
  const bool is_level = levels[map].known();
  const Pose T_level_graph =
      is_level ? pose_graph::levelling(levels[map], graph.track(sessions[map])->map.front()) : Pose();
  if (!origins[map]) return T_level_graph;
  const Pose T_level_origin = T_level_graph * poseInGraph(*this, *origins[map]);
  if (!is_level) return T_level_origin.inverse() * T_level_graph;
  const Eigen::Vector3d forward = T_level_origin.q() * Eigen::Vector3d::UnitX();
  const Eigen::Quaterniond heading(Eigen::AngleAxisd(std::atan2(forward.y(), forward.x()), Eigen::Vector3d::UnitZ()));
  return Pose(heading, T_level_origin.t()).inverse() * T_level_graph;
}

Trajectory GraphRun::trajectory(std::size_t session) const {
  const Trajectory track = relaxedTrack(*this, session);
  const std::size_t map = findMap(session);
  if (map >= levels.size() || (!levels[map].known() && !origins[map])) return track;
  return transformed(mapFromGraph(session), track);
}

GraphRun runGraph(const pose_graph::Parameters& parameters, const std::vector<const SessionOdometry*>& runs,
                  const std::vector<std::string>& sessions, const std::vector<MetricClosure>& closures,
                  const PreviousClosures& previous, const SessionGrounds& grounds, const SessionFixes& fixes,
                  const PlaneFinder& find_planes, std::vector<pose_graph::Edit> edits) {
  GraphRun made;
  made.graph = PoseGraph(parameters);
  made.sessions = sessions;
  pose_graph::EditedGraph edited(made.graph, std::move(edits));
  for (std::size_t s = 0; s < runs.size(); ++s) {
    made.graph.beginSession(sessions[s]);
    made.graph.setRig(sessions[s], nameRig(runs, s));
    for (std::size_t i = 1; i < runs[s]->settled.size(); ++i)
      edited.addOdometry(sessions[s], runs[s]->settled[i].from_previous);
    if (s < fixes.size()) made.graph.putFixes(sessions[s], fixes[s]);
  }
  importClosures(made, edited, runs, closures, previous);
  const auto begin = Clock::now();
  if (!find_planes) addPlanes(made, previous.planes);
  relax(made, edited, runs, grounds);
  made.ms = millisecondsSince(begin);
  if (find_planes) relaxWithPlanes(made, edited, runs, grounds, find_planes);
  assessClosures(made, previous.offered.size());
  addFixWarnings(parameters, made);
  addSelectionWarnings(made);
  if (const pose_graph::Relaxed& last = made.relaxed; isEarly(last.ending))
    made.warnings.push_back(endingWarning(last.ending, last.iterations.size(), last.gradient));
  const auto relaxed = Clock::now();
  made.origins = findOrigins(made, edited);
  made.covariances = computeCovariances(made);
  leaveToOdometry(made, runs);
  made.ms_covariances = millisecondsSince(relaxed);
  made.levels = estimateLevels(made, runs, grounds);
  for (const std::string& warning : edited.warnings()) made.warnings.push_back(warning);
  for (std::size_t s = 1; s < sessions.size(); ++s)
    if (made.findMap(s) == s)
      made.warnings.push_back("session " + sessions[s] + " is a separate map: no consistent closures join it to " +
                              (s == 1 ? sessions[0] : "an earlier session"));
  const urban_nav_core::Status status = made.graph.status();
  if (status.reason == static_cast<int>(pose_graph::Trouble::BrokenChain)) made.warnings.push_back(status.sentence);
  return made;
}

}  // namespace urban_nav
