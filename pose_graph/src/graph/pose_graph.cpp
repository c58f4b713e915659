// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/pose_graph.hpp"

#include <algorithm>
#include <cmath>

#include "graph/jump_gate.hpp"
#include "graph/odometry_variance.hpp"
#include "pose_graph/graph_file.hpp"
#include "solve/normal_equations.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

using urban_nav_core::Matrix6d;
using urban_nav_core::RelativePose;
using urban_nav_core::UserError;

namespace {

constexpr double kMovedDistance = 0.01, kMovedAngle = 0.02 * 3.14159265358979323846 / 180.0;  // DESIGN.md, section 5

// Live, poses are good to a hundredth of a standard deviation and the next update goes on from there; relax() is exact.
constexpr double kUpdateTolerance = 1e-5;

std::string nameOf(const NodeRef& ref) { return ref.session + " at " + urban_nav_core::printStamp(ref.stamp) + " s"; }

bool isProper(const Matrix6d& covariance) {
  return covariance.allFinite() && Eigen::LLT<Matrix6d>(covariance).info() == Eigen::Success;
}

// Round-off can make the least eigenvalues of a good covariance negative: the step counts, with those raised to what the largest
// one's last digits are. Empty where there is nothing to raise.
std::optional<Matrix6d> properCovariance(const Matrix6d& covariance) {
  if (isProper(covariance)) return covariance;
  if (!covariance.allFinite()) return std::nullopt;
  const auto eigen = urban_nav_core::symmetricEigen(0.5 * (covariance + covariance.transpose()));
  if (!eigen || !(eigen->values.maxCoeff() > 0.0)) return std::nullopt;
  const Eigen::VectorXd raised = eigen->values.cwiseMax(1e-6 * eigen->values.maxCoeff());
  const Matrix6d made = eigen->vectors * raised.asDiagonal() * eigen->vectors.transpose();
  return Matrix6d(0.5 * (made + made.transpose()));
}

bool moved(const Pose& a, const Pose& b) {
  return distanceBetween(a, b) > kMovedDistance || angleBetween(a, b) > kMovedAngle;
}

}  // namespace

const char* toString(Trouble trouble) {
  switch (trouble) {
    case Trouble::None: return "None";
    case Trouble::BrokenChain: return "BrokenChain";
    case Trouble::Separate: return "Separate";
    case Trouble::Waiting: return "Waiting";
  }
  return "";
}

PoseGraph::PoseGraph(const Parameters& parameters) : parameters_(parameters) {}

void PoseGraph::beginSession(const SessionId& session) {
  if (hasSession(session)) throw UserError("pose_graph", "session " + session + " has begun already", "a new one");
  tracks_.emplace_back();
  tracks_.back().session = session;
  steps_.emplace_back();
}

bool PoseGraph::hasSession(const SessionId& session) const { return track(session) != nullptr; }

const Track* PoseGraph::track(const SessionId& session) const {
  const auto found =
      std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) { return track.session == session; });
  return found == tracks_.end() ? nullptr : &*found;
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
  const auto append = [&](StampNs stamp, const Pose& T_odom_base, const Pose& T_map_base, int part) {
    track.stamps.push_back(stamp);
    track.odom.push_back(T_odom_base);
    track.map.push_back(T_map_base);
    track.part.push_back(part);
  };
  if (track.stamps.empty()) append(step.from, Pose(), Pose(), t == 0 ? 0 : parts_++);
  if (step.to <= track.stamps.back()) return false;
  const bool joins = step.from == track.stamps.back();
  if (!joins) {
    // The chain goes on where it broke, for want of a better guess, and as a part of its own.
    if (step.from > track.stamps.back()) {
      steps_[t].push_back({step, false, {}});
      append(step.from, track.odom.back(), track.map.back(), parts_++);
    } else {
      return false;
    }
    broken_ = true;
  }
  steps_[t].push_back({step, true, {0, 0, rigidOf<3>(step.T_from_to), chainInformation(step)}});
  append(step.to, track.odom.back() * step.T_from_to, track.map.back() * step.T_from_to, track.part.back());
  return true;
}

std::optional<int> PoseGraph::poseNumber(const NodeRef& ref) const {
  std::size_t first = 0;
  for (const Track& track : tracks_) {
    if (track.session == ref.session) {
      const auto found = std::lower_bound(track.stamps.begin(), track.stamps.end(), ref.stamp);
      if (found == track.stamps.end() || *found != ref.stamp) return std::nullopt;
      return static_cast<int>(first + static_cast<std::size_t>(found - track.stamps.begin()));
    }
    first += track.stamps.size();
  }
  return std::nullopt;
}

ClosureId PoseGraph::addClosure(const Closure& offered) {
  for (const NodeRef* ref : {&offered.a, &offered.b}) {
    if (poseNumber(*ref)) continue;
    const Track* track = this->track(ref->session);
    if (track == nullptr || track->stamps.empty())
      throw UserError("closure", "session " + ref->session + " has no poses", "a session of the graph");
    const auto above = std::lower_bound(track->stamps.begin(), track->stamps.end(), ref->stamp);
    const StampNs nearest = above == track->stamps.end() ||
                                    (above != track->stamps.begin() && ref->stamp - *(above - 1) < *above - ref->stamp)
                                ? *(above - 1)
                                : *above;
    throw UserError("closure", "no pose in session " + nameOf(*ref),
                    "stamps of poses; the nearest is " + urban_nav_core::printStamp(nearest) + " s");
  }
  if (*poseNumber(offered.a) == *poseNumber(offered.b))
    throw UserError("closure", "from a pose to itself: " + nameOf(offered.a), "");
  if (!offered.measured.T_a_b.isFinite() || !offered.measured.information.allFinite())
    throw UserError("closure", "numbers that are not finite, " + nameOf(offered.a) + " to " + nameOf(offered.b), "");
  if (offered.kind == EdgeKind::Odometry)
    throw UserError("closure", "kind odometry", "stereo, icp, plane, session, asserted");
  const Matrix6d symmetric = 0.5 * (offered.measured.information + offered.measured.information.transpose());
  const auto values = urban_nav_core::symmetricEigenvalues(symmetric);
  if (!values || (*values)[0] < -1e-9 * std::max(values->maxCoeff(), 0.0))
    throw UserError("closure",
                    "information with a negative eigenvalue, " + nameOf(offered.a) + " to " + nameOf(offered.b),
                    "positive semidefinite matrices");
  Closure taken = offered;
  const auto same = findClosure(offered.a, offered.b, offered.kind, offered.source);
  taken.id = same ? *same : next_id_++;
  taken.judged = false;
  taken.weight = 0.0;
  taken.verdict = ClosureVerdict::Waiting;
  taken.reason = "not judged yet";
  taken.contradicted_by.clear();
  closures_[taken.id] = taken;
  return taken.id;
}

bool PoseGraph::removeClosure(ClosureId id) { return closures_.erase(id) > 0; }

std::optional<ClosureId> PoseGraph::findClosure(const NodeRef& a, const NodeRef& b, EdgeKind kind,
                                                const std::string& source) const {
  for (const auto& [id, closure] : closures_)
    if (closure.a == a && closure.b == b && closure.kind == kind && closure.source == source) return id;
  return std::nullopt;
}

Problem<3> PoseGraph::problem() const {
  Problem<3> made;
  for (const Track& track : tracks_)
    for (const Pose& pose : track.odom) made.poses.push_back(rigidOf<3>(pose));
  int first = 0;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    for (std::size_t i = 0; i < steps_[t].size(); ++i) {
      const Step& step = steps_[t][i];
      if (!step.joins) continue;
      const int from = first + static_cast<int>(i);
      made.edges.push_back(step.edge);
      made.edges.back().from = from;
      made.edges.back().to = from + 1;
      made.edges.back().information /= odometry_variance_;
    }
    first += static_cast<int>(tracks_[t].stamps.size());
  }
  for (const auto& [id, closure] : closures_) {
    made.edges.push_back({*poseNumber(closure.a), *poseNumber(closure.b), rigidOf<3>(closure.measured.T_a_b),
                          closureInformation(closure.measured, ownNoise(closure.a), ownNoise(closure.b))});
  }
  return made;
}

Matrix6d PoseGraph::ownNoise(const NodeRef& ref) const {
  const Track& track = *this->track(ref.session);
  const auto& steps = steps_[static_cast<std::size_t>(&track - tracks_.data())];
  const auto i = static_cast<std::size_t>(std::lower_bound(track.stamps.begin(), track.stamps.end(), ref.stamp) -
                                          track.stamps.begin());
  if (steps.empty()) return Matrix6d::Zero();
  const Step& step = steps[i == 0 ? 0 : i - 1];
  return step.measured.drift_covariance.trace() > 0.0 ? Matrix6d(0.5 * step.measured.covariance) : Matrix6d::Zero();
}

std::vector<double> PoseGraph::weights() const {
  std::vector<double> made;
  for (const auto& steps : steps_)
    for (const Step& step : steps)
      if (step.joins) made.push_back(1.0);
  for (const auto& [id, closure] : closures_) made.push_back(closure.weight);
  return made;
}

Relaxed PoseGraph::relax(const SolveOptions& options) {
  const std::map<ClosureId, Closure> before = closures_;
  SolveOptions wanted = options;
  wanted.iterations = parameters_.iterations;
  odometry_variance_ = 1.0;
  Problem<3> problem = this->problem();
  if (problem.poses.empty()) return {};
  Solution<3> solution = judge(problem, parameters_, wanted, closures_);
  odometry_variance_ =
      takeOdometryVariance(problem, problem.edges.size() - closures_.size(), weights(), wanted, solution);
  for (auto& [id, closure] : closures_) closure.judged = true;
  return take(solution, before);
}

Relaxed PoseGraph::update() {
  const std::map<ClosureId, Closure> before = closures_;
  Problem<3> problem = this->problem();
  if (problem.poses.empty()) return {};
  std::size_t number = 0;
  for (const Track& track : tracks_)
    for (const Pose& pose : track.map) problem.poses[number++] = rigidOf<3>(pose);
  SolveOptions options;
  options.iterations = parameters_.iterations;
  options.start = Start::Vertices;
  options.tolerance = kUpdateTolerance;
  const Addition added = judgeAddition(problem, parameters_, options, closures_);
  for (auto& [id, closure] : closures_) closure.judged = true;
  Relaxed made = take(added.solution, before);
  made.needs_batch = added.disagreement;
  return made;
}

Relaxed PoseGraph::take(const Solution<3>& solution, const std::map<ClosureId, Closure>& before) {
  const std::vector<Rigid<3>>& poses = solution.poses;
  Relaxed made;
  made.revision = ++revision_;
  made.poses = poses.size();
  made.closures = closures_.size();
  for (const auto& [id, closure] : closures_) {
    made.accepted += closure.verdict == ClosureVerdict::Accepted;
    made.rejected += closure.verdict == ClosureVerdict::Rejected;
    made.waiting += closure.verdict == ClosureVerdict::Waiting;
  }
  made.cost_before = solution.cost_before;
  made.cost_after = solution.cost;
  made.iterations = solution.iterations;
  made.ending = solution.ending;
  const std::vector<int> parts = partNumbers();
  parts_ = parts.empty() ? 0 : 1 + *std::max_element(parts.begin(), parts.end());
  made.parts = parts_;

  std::size_t number = 0;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    Track& track = tracks_[t];
    if (track.stamps.empty()) continue;
    const Pose newest_before = track.map.back();
    bool in_run = false;
    for (std::size_t i = 0; i < track.map.size(); ++i, ++number) {
      const Pose now = poseOf(poses[number]);
      const bool far = moved(now, track.map[i]) || parts[number] != track.part[i];
      if (far && !in_run) made.moved.push_back({t, i, i});
      if (far) made.moved.back().last = i;
      in_run = far;
      track.map[i] = now;
      track.part[i] = parts[number];
    }
    made.edges += track.stamps.size() - 1;
    made.sessions_joined += track.part.back() == 0;
    if (t + 1 < tracks_.size()) continue;
    const double distance = distanceBetween(newest_before, track.map.back()),
                 angle = angleBetween(newest_before, track.map.back());
    if (distance <= parameters_.jump_distance && angle <= parameters_.jump_angle * 3.14159265358979323846 / 180.0)
      continue;
    Relaxed::Jump jump{{track.session, track.stamps.back()}, newest_before, track.map.back(), distance, angle, "", {}};
    for (const auto& [id, closure] : closures_) {
      const auto was = before.find(id);
      if (closure.verdict == ClosureVerdict::Accepted &&
          (was == before.end() || was->second.verdict != ClosureVerdict::Accepted))
        jump.witnesses.push_back(id);
    }
    jump.reason = jump.witnesses.empty() ? "closures that were believed are no longer"
                                         : std::to_string(jump.witnesses.size()) + " closures that agree";
    made.jump = std::move(jump);
  }
  made.edges += closures_.size();
  return made;
}

std::vector<int> PoseGraph::partNumbers() const {
  // Runs of a chain without a gap, joined by accepted closures.
  std::vector<int> run_of_pose;
  int runs = 0;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t i = 0; i < tracks_[t].stamps.size(); ++i)
      run_of_pose.push_back(i > 0 && steps_[t][i - 1].joins ? runs - 1 : runs++);
  Problem<3> joined;
  joined.poses.resize(static_cast<std::size_t>(runs));
  for (const auto& [id, closure] : closures_) {
    if (closure.weight <= 0.0) continue;
    Edge<3> edge;
    edge.from = run_of_pose[static_cast<std::size_t>(*poseNumber(closure.a))];
    edge.to = run_of_pose[static_cast<std::size_t>(*poseNumber(closure.b))];
    joined.edges.push_back(edge);
  }
  const std::vector<int> parts = unknownsOf(joined).component;
  for (int& run : run_of_pose) run = parts[static_cast<std::size_t>(run)];
  return run_of_pose;
}

Pose PoseGraph::mapFromOdom(const SessionId& session) const {
  const Track* track = this->track(session);
  if (track == nullptr || track->stamps.empty()) return {};
  return track->map.back() * track->odom.back().inverse();
}

urban_nav_core::Status PoseGraph::status() const {
  using urban_nav_core::Health;
  if (broken_)
    return {Health::Degraded, static_cast<int>(Trouble::BrokenChain),
            "the odometry has gaps; what no closure joins is a map of its own"};
  std::size_t waiting = 0;
  for (const auto& [id, closure] : closures_) waiting += closure.verdict == ClosureVerdict::Waiting;
  if (parts_ > 1)
    return {Health::Degraded, static_cast<int>(Trouble::Separate),
            std::to_string(parts_) + " maps that no accepted closure joins"};
  if (waiting > 0)
    return {Health::Ok, static_cast<int>(Trouble::Waiting),
            std::to_string(waiting) + " closures wait for a second one that agrees"};
  return {};
}

}  // namespace pose_graph
