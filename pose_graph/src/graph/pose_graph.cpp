// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/pose_graph.hpp"

#include <algorithm>
#include <cmath>

#include "condense/chain_sum.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::Matrix6d;
using urban_nav_core::RelativePose;
using urban_nav_core::UserError;

namespace {

std::string toText(const NodeRef& ref) { return ref.session + " at " + urban_nav_core::printStamp(ref.stamp) + " s"; }

bool isProper(const Matrix6d& covariance) {
  return covariance.allFinite() && urban_nav_core::SmallCholesky<6>(covariance).succeeded();
}

// Raises the smallest eigenvalues to the round-off of the largest one, since round-off can make eigenvalues of a valid
// covariance negative. Returns nullopt if the matrix is not finite or has no positive eigenvalue.
std::optional<Matrix6d> properCovariance(const Matrix6d& covariance) {
  if (isProper(covariance)) return covariance;
  if (!covariance.allFinite()) return std::nullopt;
  const auto eigen = urban_nav_core::symmetricEigen(0.5 * (covariance + covariance.transpose()));
  if (!eigen || !(eigen->values.maxCoeff() > 0.0)) return std::nullopt;
  const Eigen::VectorXd raised = eigen->values.cwiseMax(1e-6 * eigen->values.maxCoeff());
  const Matrix6d made = eigen->vectors * raised.asDiagonal() * eigen->vectors.transpose();
  return Matrix6d(0.5 * (made + made.transpose()));
}

}  // namespace

const char* toString(Trouble trouble) {
  switch (trouble) {
    case Trouble::None: return "None";
    case Trouble::BrokenChain: return "BrokenChain";
    case Trouble::Separate: return "Separate";
    case Trouble::Waiting: return "Waiting";
    case Trouble::NotStored: return "NotStored";
    case Trouble::Undecided: return "Undecided";
    case Trouble::Guess: return "Guess";
    case Trouble::Slipped: return "Slipped";
    case Trouble::Unconverged: return "Unconverged";
  }
  return "";
}

std::string toSentence(const Relaxed::Slip& slip) {
  return "odometry slipped between " + toText(slip.from) + " and " + toText(slip.to) +
         ": closures contradict this step, and the map follows them";
}

PoseGraph::PoseGraph(const Parameters& parameters, std::int64_t revision)
    : parameters_(parameters), revision_(revision) {}

void PoseGraph::beginSession(const SessionId& session) {
  if (hasSession(session)) throw UserError("pose_graph", "session " + session + " exists already", "an unused id");
  track_of_[session] = tracks_.size();
  tracks_.emplace_back();
  tracks_.back().session = session;
  steps_.emplace_back();
  measured_.emplace_back();
  rigs_.emplace_back();
  runs_.emplace_back();
  forces_.emplace_back();
  ground_.emplace_back();
  fixes_.emplace_back();
  level_.push_back(false);
  running_ = tracks_.size() - 1;
}

void PoseGraph::goOn(const SessionId& session) {
  if (hasSession(session)) running_ = track_of_.at(session);
}

const RelativePose* PoseGraph::stepTo(std::size_t track, std::size_t pose) const {
  return pose > 0 && steps_[track][pose - 1].joins ? &measured_[track][pose - 1] : nullptr;
}

bool PoseGraph::hasSession(const SessionId& session) const { return track(session) != nullptr; }

const Track* PoseGraph::track(const SessionId& session) const {
  const auto found = track_of_.find(session);
  return found == track_of_.end() ? nullptr : &tracks_[found->second];
}

bool PoseGraph::addOdometry(const SessionId& session, const RelativePose& offered) {
  if (!hasSession(session)) beginSession(session);
  const std::size_t t = static_cast<std::size_t>(track(session) - tracks_.data());
  Track& track = tracks_[t];
  RelativePose step = offered;
  const std::optional<Matrix6d> covariance = properCovariance(offered.covariance);
  if (!step.T_from_to.isFinite() || !covariance || step.to <= step.from) return false;
  step.covariance = *covariance;
  if (!isProper(step.drift_covariance)) step.drift_covariance.setZero();
  std::vector<Run>& runs = runs_[t];
  const auto append = [&](StampNs stamp, const Pose& T_odom_base, const Pose& T_map_base, bool begins) {
    if (begins) runs.push_back({t, track.stamps.size(), track.stamps.size(), parts_++});
    runs.back().last = track.stamps.size();
    track.stamps.push_back(stamp);
    track.odom.push_back(T_odom_base);
    track.map.push_back(T_map_base);
    track.part.push_back(runs.back().part);
  };
  if (track.stamps.empty()) append(step.from, Pose(), Pose(), true);
  if (step.to <= track.stamps.back() || step.from < track.stamps.back()) return false;
  if (step.from > track.stamps.back()) {
    // The new part begins at the pose where the chain broke, for lack of a better guess.
    ChainStep gap;
    gap.joins = gap.invertible = false;
    steps_[t].push_back(gap);
    measured_[t].emplace_back();
    append(step.from, track.odom.back(), track.map.back(), true);
    broken_ = true;
  }
  ChainStep joint;
  joint.edge = {0, 0, toRigid<3>(step.T_from_to), chainInformation(step)};
  joint.invertible = invert<3>(joint.edge.information, joint.covariance);
  if (step.drift_covariance.trace() > 0.0) joint.own_noise = 0.5 * step.covariance;
  steps_[t].push_back(joint);
  measured_[t].push_back(step);
  append(step.to, track.odom.back() * step.T_from_to, track.map.back() * step.T_from_to, false);
  return true;
}

std::optional<NodeIndex> PoseGraph::findNode(const NodeRef& ref) const {
  const auto track = track_of_.find(ref.session);
  if (track == track_of_.end()) return std::nullopt;
  const std::vector<StampNs>& stamps = tracks_[track->second].stamps;
  const auto found = std::lower_bound(stamps.begin(), stamps.end(), ref.stamp);
  if (found == stamps.end() || *found != ref.stamp) return std::nullopt;
  return NodeIndex{track->second, static_cast<std::size_t>(found - stamps.begin())};
}

std::optional<int> PoseGraph::poseNumber(const NodeRef& ref) const {
  const std::optional<NodeIndex> place = findNode(ref);
  if (!place) return std::nullopt;
  std::size_t number = place->second;
  for (std::size_t t = 0; t < place->first; ++t) number += tracks_[t].stamps.size();
  return static_cast<int>(number);
}

ClosureId PoseGraph::addClosure(const Closure& offered) {
  for (const NodeRef* ref : {&offered.a, &offered.b}) {
    if (findNode(*ref)) continue;
    const Track* track = this->track(ref->session);
    if (track == nullptr || track->stamps.empty())
      throw UserError("closure", "session " + ref->session + " has no poses", "a session of the graph");
    const auto above = std::lower_bound(track->stamps.begin(), track->stamps.end(), ref->stamp);
    const StampNs nearest = above == track->stamps.end() ||
                                    (above != track->stamps.begin() && ref->stamp - *(above - 1) < *above - ref->stamp)
                                ? *(above - 1)
                                : *above;
    throw UserError("closure", "no pose in session " + toText(*ref),
                    "stamps of poses; the nearest is " + urban_nav_core::printStamp(nearest) + " s");
  }
  const NodeIndex a = *findNode(offered.a), b = *findNode(offered.b);
  if (a == b) throw UserError("closure", "both ends are " + toText(offered.a), "two different poses");
  if (!offered.measured.T_a_b.isFinite() || !offered.measured.information.allFinite())
    throw UserError("closure", "non-finite values, " + toText(offered.a) + " to " + toText(offered.b),
                    "finite numbers");
  if (offered.kind == EdgeKind::Odometry)
    throw UserError("closure", "kind odometry", "stereo, icp, plane, session, asserted");
  const Matrix6d symmetric = 0.5 * (offered.measured.information + offered.measured.information.transpose());
  const auto values = urban_nav_core::symmetricEigenvalues(symmetric);
  if (!values || (*values)[0] < -1e-9 * std::max(values->maxCoeff(), 0.0))
    throw UserError("closure",
                    "information with a negative eigenvalue, " + toText(offered.a) + " to " + toText(offered.b),
                    "positive semidefinite matrices");
  Closure taken = offered;
  const auto same = findClosure(offered.a, offered.b, offered.kind, offered.source);
  taken.id = same ? *same : next_id_++;
  taken.judged = false;
  taken.weight = 0.0;
  taken.verdict = ClosureVerdict::Waiting;
  taken.reason = "not evaluated yet";
  taken.contradicted_by.clear();
  const auto earlier = closures_.find(taken.id);
  if (earlier != closures_.end() && earlier->second.weight > 0.0) live_.reset();
  closures_[taken.id] = taken;
  closure_edges_[taken.id] = {a, b, toEdge(taken, a, b, closure_variance_)};
  by_name_[makeName(taken.a, taken.b, taken.kind, taken.source)] = taken.id;
  return taken.id;
}

Edge<3> PoseGraph::toEdge(const Closure& closure, const NodeIndex& a, const NodeIndex& b, double variance) const {
  Edge<3> edge{0, 0, toRigid<3>(closure.measured.T_a_b),
               closureInformation(closure.measured, ownNoise(a), ownNoise(b))};
  if (!isVouchedFor(closure)) edge.information /= variance;
  return edge;
}

Matrix6d PoseGraph::ownNoise(const NodeIndex& place) const {
  const std::vector<ChainStep>& steps = steps_[place.first];
  return steps.empty() ? Matrix6d(Matrix6d::Zero()) : steps[place.second == 0 ? 0 : place.second - 1].own_noise;
}

Matrix6d PoseGraph::ownNoise(const NodeRef& ref) const { return ownNoise(findNode(ref).value()); }

bool PoseGraph::removeClosure(ClosureId id) {
  const auto found = closures_.find(id);
  if (found == closures_.end()) return false;
  const Closure& closure = found->second;
  if (closure.weight > 0.0) live_.reset();
  if (closure.verdict == ClosureVerdict::Accepted) removed_.push_back(closure);
  by_name_.erase(makeName(closure.a, closure.b, closure.kind, closure.source));
  closure_edges_.erase(id);
  closures_.erase(found);
  return true;
}

std::optional<ClosureId> PoseGraph::findClosure(const NodeRef& a, const NodeRef& b, EdgeKind kind,
                                                const std::string& source) const {
  const auto found = by_name_.find(makeName(a, b, kind, source));
  return found == by_name_.end() ? std::nullopt : std::optional<ClosureId>(found->second);
}

Problem<3> PoseGraph::problem() const { return problem(odometry_variance_); }

Problem<3> PoseGraph::problem(double odometry_variance) const {
  Problem<3> made;
  std::vector<int> first;  // first pose of each track
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    first.push_back(static_cast<int>(made.poses.size()));
    for (const Pose& pose : tracks_[t].odom) made.poses.push_back(toRigid<3>(pose));
  }
  const auto put = [&made](const Edge<3>& edge, int from, int to) {
    made.edges.push_back(edge);
    made.edges.back().from = from;
    made.edges.back().to = to;
  };
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t i = 0; i < steps_[t].size(); ++i) {
      const int from = first[t] + static_cast<int>(i);
      if (!steps_[t][i].joins) continue;
      put(steps_[t][i].edge, from, from + 1);
      made.edges.back().information /= odometry_variance;
    }
  for (const auto& [id, closure_edge] : closure_edges_)
    put(closure_edge.edge, first[closure_edge.a.first] + static_cast<int>(closure_edge.a.second),
        first[closure_edge.b.first] + static_cast<int>(closure_edge.b.second));
  return made;
}

std::vector<double> PoseGraph::weights() const {
  std::vector<double> made;
  for (const auto& steps : steps_)
    for (const ChainStep& step : steps)
      if (step.joins) made.push_back(1.0);
  for (const auto& [id, closure] : closures_) made.push_back(closure.weight);
  return made;
}

urban_nav_core::Status PoseGraph::status() const {
  using urban_nav_core::Health;
  if (broken_)
    return {Health::Degraded, static_cast<int>(Trouble::BrokenChain),
            "odometry has gaps; sections not joined by closures are separate maps"};
  std::size_t waiting = 0, rejected = 0;
  for (const auto& [id, closure] : closures_) {
    waiting += closure.verdict == ClosureVerdict::Waiting;
    rejected += closure.verdict == ClosureVerdict::Rejected;
  }
  const std::vector<std::string> warnings = selectionWarnings(selection_, rejected, closures_.size());
  if (!warnings.empty())
    return {Health::Degraded, static_cast<int>(selection_.undecided ? Trouble::Undecided : Trouble::Guess),
            warnings.front()};
  if (!slips_.empty()) return {Health::Degraded, static_cast<int>(Trouble::Slipped), toSentence(slips_.front())};
  if (parts_ > 1)
    return {Health::Degraded, static_cast<int>(Trouble::Separate),
            std::to_string(parts_) + " maps not joined by an accepted closure"};
  if (!ending_warning_.empty()) return {Health::Degraded, static_cast<int>(Trouble::Unconverged), ending_warning_};
  if (waiting > 0)
    return {Health::Ok, static_cast<int>(Trouble::Waiting),
            std::to_string(waiting) + " closures wait for confirmation by a second closure"};
  return {};
}

}  // namespace pose_graph
