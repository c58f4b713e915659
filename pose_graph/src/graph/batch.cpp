// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "condense/chain_sum.hpp"
#include "fixes/use_fixes.hpp"
#include "graph/jump_gate.hpp"
#include "graph/odometry_variance.hpp"
#include "gravity/level_odometry.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

namespace {

// Upper bound of the variance factor of odometry: 3 of its deviations.
constexpr double kLargestVariance = 9.0;

/// Whether two closures between the same poses are bit-identical measurements.
bool isSame(const Closure& a, const Closure& b) {
  return a.measured.T_a_b.t() == b.measured.T_a_b.t() &&
         a.measured.T_a_b.q().coeffs() == b.measured.T_a_b.q().coeffs() &&
         a.measured.information == b.measured.information && a.odometry_gate == b.odometry_gate &&
         a.by_hand == b.by_hand;
}

/// Returns the graph with the accepted edges.
Problem<3> acceptedGraph(const Problem<3>& problem, const std::vector<double>& weights) {
  Problem<3> accepted = problem.withoutEdges();
  for (std::size_t e = 0; e < problem.edges.size(); ++e)
    if (weights[e] > 0.0) accepted.edges.push_back(problem.edges[e]);
  return accepted;
}

/// Relaxes with the position fixes too. The displacements are transferred to the odometry steps, as the tilt correction
/// is, so that later relaxations without fixes keep the result.
void takeFixes(Batch& batch, std::size_t chains, const std::vector<double>& weights, const SolveOptions& options) {
  std::size_t unplaced = 0;
  const std::vector<FixedPart> parts =
      placeFixes(acceptedGraph(batch.problem, weights), batch.solution.poses, batch.stamps, batch.forces, batch.fixes,
                 batch.parameters.gps_correlation, unplaced);
  const std::vector<Rigid<3>> before = batch.solution.poses;
  batch.fix_use = useFixes(batch.problem, chains, weights, parts, options, batch.solution, batch.odometry_variance);
  batch.fix_use.unplaced = unplaced;
  if (parts.empty()) return;
  for (std::size_t e = 0; e < chains; ++e) {
    Edge<3>& step = batch.problem.edges[e];
    const auto from = static_cast<std::size_t>(step.from), to = static_cast<std::size_t>(step.to);
    const Rigid<3> residual = step.Z.inverse() * (before[from].inverse() * before[to]);
    step.Z = batch.solution.poses[from].inverse() * batch.solution.poses[to] * residual.inverse();
  }
}

void append(std::vector<Relaxed::Run>& runs, const std::vector<Relaxed::Run>& more) {
  runs.insert(runs.end(), more.begin(), more.end());
}

}  // namespace

Batch PoseGraph::batch() const {
  Batch made;
  made.parameters = parameters_;
  made.problem = problem(1.0);
  auto edge = made.problem.edges.begin();
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t i = 0; i < steps_[t].size(); ++i)
      if (steps_[t][i].joins) {
        edge->Z = toRigid<3>(measured_[t][i].T_from_to);
        if (steps_[t][i].slipped) edge->information = chainInformation(measured_[t][i]);
        ++edge;
      }
  for (const auto& [id, closure_edge] : closure_edges_)
    (edge++)->information = toEdge(closures_.at(id), closure_edge.a, closure_edge.b, 1.0).information;
  for (const Track& track : tracks_) made.stamps.push_back(track.stamps);
  made.forces = forces_;
  made.fixes = fixes_;
  made.closures = closures_;
  return made;
}

void run(Batch& batch, const SolveOptions& options, const ReferenceSolvers& references) {
  const ReferenceSolver* reference = findReference(batch.parameters.solver, references);
  if (batch.problem.poses.empty()) return;
  SolveOptions wanted = options;
  wanted.iterations = batch.parameters.iterations;
  const std::size_t chains = batch.problem.edges.size() - batch.closures.size();
  if (batch.parameters.gravity) batch.odometry_lean = levelOdometry(batch.problem, chains, batch.stamps, batch.forces);
  Assessment assessment = assess(batch.problem, batch.parameters, wanted, reference, batch.closures);
  batch.solution = std::move(assessment.solution);
  batch.selection = assessment.selection;
  batch.slipped = std::move(assessment.slipped);
  std::vector<double> weights(chains, 1.0);
  for (auto& [id, closure] : batch.closures) {
    closure.judged = true;
    weights.push_back(closure.weight);
  }
  // A larger variance of odometry would also fit false closures; only the selection may choose one.
  const double begin = batch.selection.rescaled ? batch.selection.odometry_factor : 1.0;
  const double largest =
      batch.parameters.robust ? std::max(kLargestVariance, begin) : std::numeric_limits<double>::infinity();
  batch.odometry_variance =
      takeOdometryVariance(batch.problem, chains, weights, wanted, batch.solution, largest, begin);
  if (batch.parameters.gps) takeFixes(batch, chains, weights, wanted);
  if (isEarly(batch.solution.ending))
    batch.solution.gradient = gradientNorm(batch.problem, batch.solution.poses, wanted.objective, weights);
}

Relaxed PoseGraph::take(const Batch& batch) {
  if (batch.solution.poses.empty()) return {};
  const Before before = this->before();
  applyVerdicts(batch);
  odometry_variance_ = batch.odometry_variance;
  selection_ = batch.selection;
  applyClosureVariance(batch.selection.rescaled ? batch.selection.closure_factor : 1.0);
  odometry_lean_ = batch.odometry_lean;
  fix_use_ = batch.fix_use;
  applySteps(batch);
  live_.reset();
  Relaxed made;
  made.cost_before = batch.solution.cost_before;
  made.cost_after = batch.solution.cost;
  made.iterations = batch.solution.iterations;
  made.ending = batch.solution.ending;
  made.gradient = batch.solution.gradient;
  std::vector<Relaxed::Run> moved = numberParts();
  PoseTable pose_table = posesAfter(batch);
  const bool levelled = isOfRunning(level(pose_table, false));
  append(moved, applyPoses(pose_table));
  if (std::any_of(closures_.begin(), closures_.end(), [](const auto& each) { return !each.second.judged; })) {
    append(moved, evaluateNew(made));
    append(moved, numberParts());
  }
  ending_warning_ = endingWarning(made.ending, made.iterations.size(), made.gradient);
  reportCorrection(made, std::move(moved), before, levelled);
  return made;
}

void PoseGraph::applyVerdicts(const Batch& batch) {
  for (auto& [id, closure] : closures_) {
    const auto judged = batch.closures.find(id);
    if (judged != batch.closures.end() && isSame(judged->second, closure)) {
      closure = judged->second;
      continue;
    }
    closure.judged = false;
    closure.weight = 0.0;
    closure.verdict = ClosureVerdict::Waiting;
    closure.reason = "not evaluated yet";
  }
}

void PoseGraph::applySteps(const Batch& batch) {
  slips_.clear();
  auto slipped = batch.slipped.begin();
  int edge = 0;
  for (std::size_t t = 0; t < batch.stamps.size(); ++t)
    for (std::size_t i = 0; i + 1 < batch.stamps[t].size(); ++i) {
      ChainStep& step = steps_[t][i];
      if (!step.joins) continue;
      step.edge.Z = batch.problem.edges[static_cast<std::size_t>(edge)].Z;
      const bool slips = slipped != batch.slipped.end() && *slipped == edge;
      ++edge;
      if (slips) {
        ++slipped;
        const SessionId& session = tracks_[t].session;
        slips_.push_back({{session, batch.stamps[t][i]}, {session, batch.stamps[t][i + 1]}});
      }
      if (slips == step.slipped) continue;
      step.slipped = slips;
      step.edge.information = (slips ? kSlippedShare : 1.0) * chainInformation(measured_[t][i]);
      step.invertible = invert<3>(step.edge.information, step.covariance);
    }
}

void PoseGraph::applyClosureVariance(double variance) {
  if (variance == closure_variance_) return;
  closure_variance_ = variance;
  for (auto& [id, closure_edge] : closure_edges_)
    closure_edge.edge = toEdge(closures_.at(id), closure_edge.a, closure_edge.b, variance);
}

PoseGraph::PoseTable PoseGraph::posesAfter(const Batch& batch) const {
  PoseTable pose_table;
  std::size_t number = 0;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const Track& track = tracks_[t];
    const std::size_t known = t < batch.stamps.size() ? batch.stamps[t].size() : 0;
    pose_table.emplace_back();
    for (std::size_t i = 0; i < track.map.size(); ++i) {
      if (i < known) pose_table[t].push_back(toPose(batch.solution.poses[number++]));
      else if (i == 0) pose_table[t].push_back(track.map[0]);
      else pose_table[t].push_back(pose_table[t][i - 1] * (track.odom[i - 1].inverse() * track.odom[i]));
    }
  }
  return pose_table;
}

}  // namespace pose_graph
