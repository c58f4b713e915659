// SPDX-License-Identifier: BSD-3-Clause
#include "incremental/incremental_solver.hpp"

#include <algorithm>
#include <cmath>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "solve/minimise.hpp"

namespace pose_graph {

namespace {

// Expected further decrease, in squared standard deviations, at which an update ends (a hundredth of a deviation). The
// next update continues from there; relax() is exact.
constexpr double kLiveEnough = 1e-4;
// Squared distance of a chain's end, in standard deviations of the chain, above which the chain is updated. With 1e-2
// the poses differ from the batch by 1.7 mm, with 1e-3 by 0.3 mm, with 1e-4 by 0.1 mm; an update takes 5, 6 and 9 ms
// (20 000 poses, bench/update).
constexpr double kLiveBent = 1e-3;
// A tenth of the threshold of graph/update (docs/architecture.md).
constexpr double kWrittenDistance = 1e-3, kWrittenAngle = 0.002 * 3.14159265358979323846 / 180.0;

constexpr double kStillRoundOff = 1e-9;  // m, rad: smaller motions are round-off

double rotationAngle(const Eigen::Matrix3d& R) { return logRotation(R).norm(); }

}  // namespace

IncrementalSolver::IncrementalSolver(const GraphView& view, const std::vector<ClosureEdge>& closure_edges,
                                     int iterations, double variance)
    : steps_at_most_(iterations), variance_(variance) {
  nodes_.resize(view.tracks());
  for (const ClosureEdge& closure_edge : closure_edges) {
    insert(view, closure_edge.a);
    insert(view, closure_edge.b);
  }
  closure_edges_ = closure_edges;
  relax(view, INFINITY);
}

IncrementalSolver::Offer IncrementalSolver::offer(const GraphView& view, const ClosureEdge& closure_edge,
                                                  double hopeless) {
  nodes_.resize(view.tracks());
  const double cost_without = cost_;
  undo_.emplace_back();
  undo_.back().cost = cost_;
  undo_.back().ending = ending_;
  undo_.back().gradient = gradient_;
  insert(view, closure_edge.a);
  insert(view, closure_edge.b);
  for (const Nodes& nodes : nodes_)
    for (const auto& [index, node] : nodes) undo_.back().poses.push_back(node.pose);
  closure_edges_.push_back(closure_edge);
  bringTogether(view, closure_edge);
  Offer made;
  relax(view, cost_without + hopeless);
  made.cost = cost_;
  made.innovation = cost_ - cost_without;
  made.before = cost_before_;
  return made;
}

void IncrementalSolver::keep() { undo_.clear(); }

void IncrementalSolver::withdraw() {
  Undo undo = std::move(undo_.back());
  undo_.pop_back();
  closure_edges_.pop_back();
  std::size_t number = 0;
  for (Nodes& nodes : nodes_)
    for (auto& [index, node] : nodes) node.pose = undo.poses[number++];
  for (auto& [place, node] : undo.nodes) {
    Nodes& nodes = nodes_[place.first];
    if (node) nodes[place.second] = std::move(*node);
    else nodes.erase(place.second);
  }
  cost_ = undo.cost;
  ending_ = undo.ending;
  gradient_ = undo.gradient;
}

void IncrementalSolver::remember(const NodeIndex& place) {
  if (undo_.empty() || undo_.back().nodes.count(place)) return;
  Nodes& nodes = nodes_[place.first];
  const auto found = nodes.find(place.second);
  undo_.back().nodes.emplace(place, found == nodes.end() ? std::nullopt : std::optional<Node>(found->second));
}

// Poses before the first and after the last node of a run keep their written pose relative to that node.
Rigid<3> IncrementalSolver::hangingAt(const GraphView& view, const NodeIndex& node, const NodeIndex& place) const {
  return nodes_[node.first].at(node.second).pose * (view.pose(node).inverse() * view.pose(place));
}

Rigid<3> IncrementalSolver::pose(const GraphView& view, const NodeIndex& place) const {
  const auto& [track, index] = place;
  if (track >= nodes_.size()) return view.pose(place);
  const Nodes& nodes = nodes_[track];
  const auto next = nodes.lower_bound(index);
  if (next != nodes.end() && next->first == index) return next->second.pose;
  const auto [first_of_run, last_of_run] = view.run(place);
  const bool has_last = next != nodes.begin() && std::prev(next)->first >= first_of_run;
  const bool has_next = next != nodes.end() && next->first <= last_of_run;
  if (has_last && has_next) {
    const auto last = std::prev(next);
    return last->second.pose * last->second.onward.at(index - last->first - 1);
  }
  if (has_last) return hangingAt(view, {track, std::prev(next)->first}, place);
  if (has_next) return hangingAt(view, {track, next->first}, place);
  return view.pose(place);
}

void IncrementalSolver::insert(const GraphView& view, const NodeIndex& place) {
  const auto& [track, index] = place;
  Nodes& nodes = nodes_[track];
  const auto next = nodes.lower_bound(index);
  if (next != nodes.end() && next->first == index) return;
  const auto [first_of_run, last_of_run] = view.run(place);
  const bool has_last = next != nodes.begin() && std::prev(next)->first >= first_of_run;
  const bool has_next = next != nodes.end() && next->first <= last_of_run;
  remember(place);
  if (has_last && has_next) {
    const std::size_t begin = std::prev(next)->first;
    remember({track, begin});
    Node& last = std::prev(next)->second;
    const std::size_t link = index - begin - 1;
    Node made;
    made.pose = last.pose * last.onward.at(link);
    made.onward = last.onward.splitAfter(link, view.steps(track) + begin);
    last.is_written = false;
    nodes.emplace(index, std::move(made));
    return;
  }
  const std::size_t first = has_last ? std::prev(next)->first : index, last = has_next ? next->first : index;
  Node made;
  made.pose = pose(view, place);
  nodes.emplace(index, std::move(made));
  layChains(view, track, first, last);
}

// Builds chains between two nodes from written poses. Steps that cannot be links get nodes at both ends.
void IncrementalSolver::layChains(const GraphView& view, std::size_t track, std::size_t first, std::size_t last) {
  Nodes& nodes = nodes_[track];
  const ChainStep* steps = view.steps(track);
  const auto put = [&](std::size_t index) {
    if (nodes.count(index)) return;
    remember({track, index});
    Node made;
    made.pose = hangingAt(view, {track, first}, {track, index});
    nodes.emplace(index, std::move(made));
  };
  for (std::size_t i = first; i < last; ++i) {
    if (steps[i].invertible) continue;
    put(i);
    put(i + 1);
  }
  for (auto node = nodes.find(first); node->first < last; ++node) {
    const std::size_t begin = node->first, end = std::next(node)->first;
    remember({track, begin});
    node->second.is_written = false;
    if (end == begin + 1) continue;
    const Rigid<3> T_begin_map = view.pose({track, begin}).inverse();
    std::vector<Rigid<3>> at;
    for (std::size_t i = begin + 1; i <= end; ++i) at.push_back(T_begin_map * view.pose({track, i}));
    node->second.onward = IncrementalChain(steps + begin, at);
  }
}

void IncrementalSolver::number() {
  int number = 0;
  for (Nodes& nodes : nodes_)
    for (auto& [index, node] : nodes) node.number = number++;
}

// A closure that joins two parts moves the later part to its measured pose.
void IncrementalSolver::bringTogether(const GraphView& view, const ClosureEdge& closure_edge) {
  number();
  Problem<3> joined;
  const auto join = [&joined](int from, int to) {
    joined.edges.emplace_back();
    joined.edges.back().from = from;
    joined.edges.back().to = to;
  };
  for (std::size_t t = 0; t < nodes_.size(); ++t)
    for (auto node = nodes_[t].begin(); node != nodes_[t].end(); ++node) {
      joined.poses.push_back(node->second.pose);
      const auto next = std::next(node);
      if (next != nodes_[t].end() && node->second.leadsOn(view.steps(t), node->first, next->first))
        join(node->second.number, next->second.number);
    }
  const auto findNumber = [this](const NodeIndex& place) { return nodes_[place.first].at(place.second).number; };
  for (std::size_t b = 0; b + 1 < closure_edges_.size(); ++b)
    join(findNumber(closure_edges_[b].a), findNumber(closure_edges_[b].b));
  const std::vector<int> part = makeUnknowns(joined).component;
  const std::size_t a = sz(findNumber(closure_edge.a)), b = sz(findNumber(closure_edge.b));
  if (part[a] == part[b]) return;
  const Rigid<3> T_a_b = joined.poses[a].inverse() * joined.poses[b];
  const Rigid<3> T = part[a] < part[b]
                         ? joined.poses[a] * closure_edge.edge.Z * joined.poses[b].inverse()
                         : joined.poses[a] * T_a_b * closure_edge.edge.Z.inverse() * joined.poses[a].inverse();
  for (Nodes& nodes : nodes_)
    for (auto& [index, node] : nodes)
      if (part[sz(node.number)] == std::max(part[a], part[b])) node.pose = T * node.pose;
}

/// The core as a problem: closures and single steps, followed by the chains.
struct IncrementalSolver::Core {
  Problem<3> problem;
  std::size_t first_chain = 0;
  struct CoreChain {
    NodeIndex begin;
    Node* node;
  };
  std::vector<CoreChain> chains;
};

IncrementalSolver::Core IncrementalSolver::core(const GraphView& view) {
  number();
  Core made;
  const auto findNumber = [this](const NodeIndex& place) { return nodes_[place.first].at(place.second).number; };
  for (const ClosureEdge& closure_edge : closure_edges_) {
    made.problem.edges.push_back(closure_edge.edge);
    made.problem.edges.back().from = findNumber(closure_edge.a);
    made.problem.edges.back().to = findNumber(closure_edge.b);
  }
  for (std::size_t t = 0; t < nodes_.size(); ++t)
    for (auto at = nodes_[t].begin(); at != nodes_[t].end(); ++at) {
      auto& [index, node] = *at;
      made.problem.poses.push_back(node.pose);
      const auto next = std::next(at);
      if (next == nodes_[t].end() || !node.leadsOn(view.steps(t), index, next->first)) continue;
      if (!node.onward.empty()) {
        made.chains.push_back({{t, index}, &node});
        continue;
      }
      made.problem.edges.push_back(view.steps(t)[index].edge);
      made.problem.edges.back().from = node.number;
      made.problem.edges.back().to = node.number + 1;
      made.problem.edges.back().information /= variance_;
    }
  made.first_chain = made.problem.edges.size();
  for (const Core::CoreChain& chain : made.chains) {
    made.problem.edges.push_back(chain.node->onward.edge());
    made.problem.edges.back().from = chain.node->number;
    made.problem.edges.back().to = chain.node->number + 1;
    made.problem.edges.back().information /= variance_;
  }
  return made;
}

// Updates chains whose ends have moved relative to each other. Returns whether any was updated.
bool IncrementalSolver::layBent(const GraphView& view, Core& core) {
  bool any = false;
  for (std::size_t c = 0; c < core.chains.size(); ++c) {
    const auto& [begin, node] = core.chains[c];
    const std::size_t n = sz(node->number);
    const Rigid<3> wanted = core.problem.poses[n].inverse() * core.problem.poses[n + 1];
    if (node->onward.bend(wanted) <= kLiveBent * variance_) continue;
    remember(begin);
    const Rigid<3> by = wanted * node->onward.at(node->onward.size() - 1).inverse();
    node->bent_m += by.t.norm();
    node->bent_rad += rotationAngle(by.R);
    node->onward.lay(wanted, view.steps(begin.first) + begin.second);
    Edge<3>& edge = core.problem.edges[core.first_chain + c];
    edge.Z = node->onward.edge().Z;
    edge.information = node->onward.edge().information / variance_;
    any = true;
  }
  return any;
}

void IncrementalSolver::relax(const GraphView& view, double hopeless) {
  iterations_.clear();
  ending_ = Ending::Converged;
  cost_ = cost_before_ = gradient_ = 0.0;
  Core core = this->core(view);
  std::vector<Rigid<3>>& poses = core.problem.poses;
  if (poses.empty()) return;
  NormalEquations<3> equations(core.problem);
  BlockCholesky<6> cholesky(equations.symbolic());
  cost_ = cost_before_ = equations.linearise(Objective::Geodesic, poses, {});
  double last_gain = 0.0;
  for (;;) {
    Iteration step;
    std::vector<Rigid<3>> next;
    bool sound = cholesky.factor(equations.H(), equations.pattern());
    if (sound) {
      std::vector<double> x = equations.g();
      for (double& value : x) value = -value;
      cholesky.solve(x.data());
      for (std::size_t i = 0; i < x.size(); ++i) step.predicted -= equations.g()[i] * x[i];
      if (iterations_.empty() && cost_ - step.predicted > hopeless) {
        cost_ -= step.predicted;
        return;
      }
      next = poses;
      const Unknowns& unknowns = equations.unknowns();
      for (std::size_t u = 0; u < unknowns.pose.size(); ++u)
        next[sz(unknowns.pose[u])] =
            moved<3>(poses[sz(unknowns.pose[u])],
                     Eigen::Map<const Tangent<3>>(x.data() + 6 * sz(equations.symbolic().place[u])));
      step.cost = equations.cost(Objective::Geodesic, next, {});
      sound = std::isfinite(step.cost) && step.cost <= cost_ + kLiveEnough;
    }
    if (sound) {
      poses.swap(next);
      iterations_.push_back(step);
    } else {
      // Damped minimisation, if a plain step does not lower the cost.
      SolveOptions options;
      options.iterations = steps_at_most_ - static_cast<int>(iterations_.size());
      options.tolerance = kLiveEnough / std::max(cost_, kLiveEnough);
      const Descent descent = minimise(equations, cholesky, options, {}, poses);
      iterations_.insert(iterations_.end(), descent.iterations.begin(), descent.iterations.end());
      step.cost = descent.cost;
      ending_ = descent.ending;
    }
    const double gain = std::max({cost_ - step.cost, step.predicted, 0.0});
    cost_ = step.cost;
    const bool laid = layBent(view, core);
    if (laid) equations.renew(core.problem, core.first_chain);
    // Expected further decrease, from the ratio of successive decreases.
    const double rate = last_gain > 0.0 ? std::min(gain / last_gain, 0.999) : 0.1;
    last_gain = gain;
    if (!(gain * rate / (1.0 - rate) > kLiveEnough) || ending_ != Ending::Converged) {
      if (laid) cost_ = equations.cost(Objective::Geodesic, poses, {});
      break;
    }
    if (static_cast<int>(iterations_.size()) >= steps_at_most_) {
      ending_ = Ending::Iterations;
      break;
    }
    cost_ = equations.linearise(Objective::Geodesic, poses, {});
  }
  if (isEarly(ending_)) gradient_ = gradientNorm(core.problem, poses, Objective::Geodesic);
  for (Nodes& nodes : nodes_)
    for (auto& [index, node] : nodes) node.pose = poses[sz(node.number)];
}

void IncrementalSolver::write(GraphView& view) {
  for (std::size_t t = 0; t < nodes_.size(); ++t)
    for (auto at = nodes_[t].begin(); at != nodes_[t].end(); ++at) writeFrom(view, t, at);
}

// Writes a node, the poses after it up to the next node or the end of its run, and the poses before it if it is the
// first of its run.
void IncrementalSolver::writeFrom(GraphView& view, std::size_t track, Nodes::iterator at) {
  auto& [index, node] = *at;
  const auto next = std::next(at);
  const bool leads_on = next != nodes_[track].end() && node.leadsOn(view.steps(track), index, next->first);
  const Rigid<3> by = node.pose * node.written.inverse();
  const double angle = rotationAngle(by.R) + node.bent_rad;
  const double distance = (node.pose.t - node.written.t).norm() + node.bent_m + angle * node.onward.reach();
  // Poses after the last node follow it exactly, because the robot navigates by the newest pose.
  const bool stays = leads_on ? distance < kWrittenDistance && angle < kWrittenAngle : distance == 0.0 && angle == 0.0;
  if (node.is_written && stays) return;
  const NodeIndex here{track, index};
  const auto [first, last] = view.run(here);
  const Rigid<3> T = node.pose * view.pose(here).inverse();
  const bool is_first = at == nodes_[track].begin() || std::prev(at)->first < first;
  const bool moves = T.t.norm() > kStillRoundOff || rotationAngle(T.R) > kStillRoundOff;
  for (std::size_t i = first; i < index && is_first && moves; ++i) view.write({track, i}, T * view.pose({track, i}));
  view.write(here, node.pose);
  for (std::size_t i = index + 1; i <= last && !leads_on; ++i) view.write({track, i}, T * view.pose({track, i}));
  for (std::size_t l = 0; l + 1 < node.onward.size(); ++l)
    view.write({track, index + 1 + l}, node.pose * node.onward.at(l));
  node.written = node.pose;
  node.bent_m = node.bent_rad = 0.0;
  node.is_written = true;
}

}  // namespace pose_graph
