// SPDX-License-Identifier: BSD-3-Clause
#include "condense/solve_condensed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condense/condensed.hpp"
#include "linear/index.hpp"
#include "solve/minimise.hpp"
#include "start/along_edges.hpp"
#include "start/first_guess.hpp"

namespace pose_graph {

namespace {

// Minimum share of poses on chains; below it the elimination order handles them equally well (bench/size).
constexpr double kLeastChainShare = 0.5;
constexpr int kCondensedRounds = 30;
// Limits of steps in the core and of rounds. The edge of a long chain is more nonlinear than any of its links. If the
// core takes more steps, or a round does not halve the mismatch of the ends, the full graph converges faster
// (ais2klinik: 70 steps per round without convergence; 6 for the full graph).
constexpr int kCoreSteps = 12, kFreeRounds = 3;
constexpr double kContraction = 0.5;
// Limit of the mismatch of chain ends, in weighted squares, as a share of the cost: the relative error of the cost is
// its root.
constexpr double kClosed = 1e-12;
// Convergence between rounds: change of the cost relative to the tolerance of a minimisation, and negligible cost in
// squared standard deviations.
constexpr double kSettledShare = 1e-3, kSettledLeast = 1e-12, kNothing = 1e-9;
// Round-off by which the final cost may exceed the initial one.
constexpr double kCostRoundOff = 1e-9;

template <int D>
std::vector<Rigid<D>> collectPlaces(const Chains& chains, const std::vector<Rigid<D>>& poses) {
  std::vector<Rigid<D>> made;
  made.reserve(chains.core.size());
  for (const int pose : chains.core) made.push_back(poses[sz(pose)]);
  return made;
}

/// Moves each component rigidly so that its first pose has its given value. Fixed poses keep theirs.
template <int D>
void moveToFirst(const Problem<D>& problem, const Unknowns& unknowns, std::vector<Rigid<D>>& poses) {
  const int held = problem.fixed.empty() ? -1 : unknowns.component[sz(problem.fixed.front())];
  std::vector<Rigid<D>> T_given_made;
  for (const int origin : unknowns.origin)
    T_given_made.push_back(problem.poses[sz(origin)] * poses[sz(origin)].inverse());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (unknowns.of_pose[i] < 0) poses[i] = problem.poses[i];
    else if (unknowns.component[i] != held) poses[i] = T_given_made[sz(unknowns.component[i])] * poses[i];
  }
}

}  // namespace

template <int D>
std::optional<Solution<D>> solveCondensed(const Problem<D>& problem, const SolveOptions& options,
                                          const std::vector<double>& weights) {
  if (options.objective != Objective::Geodesic || options.start == Start::Identity) return std::nullopt;
  Condensed<D> condensed(problem, weights);
  const Chains& chains = condensed.chains();
  if (static_cast<double>(chains.core.size()) > (1.0 - kLeastChainShare) * static_cast<double>(problem.poses.size()))
    return std::nullopt;

  Solution<D> made;
  const Unknowns unknowns = makeUnknowns(problem);
  made.components = unknowns.components;
  made.cost_before = cost(problem, problem.poses, options.objective, weights);
  std::vector<double> core_weights;
  if (!weights.empty()) {
    for (const int e : chains.core_edges) core_weights.push_back(weights[sz(e)]);
    core_weights.resize(core_weights.size() + chains.size(), 1.0);
  }
  double chain_cost = condensed.relinearise();
  Problem<D> core = condensed.core(options.start == Start::Odometry ? posesAlongEdges(problem) : problem.poses);
  NormalEquations<D> equations(core);
  BlockCholesky<kTangentSize<D>> cholesky(equations.symbolic());
  std::vector<Rigid<D>> poses = firstGuess(equations, core, options, core_weights);
  made.cost_start = chain_cost + equations.cost(options.objective, poses, core_weights);
  // A chain at its odometry poses has zero cost, so the given poses are used only if their cost is lower.
  if (options.start != Start::Odometry && made.cost_before <= made.cost_start) {
    condensed.layBy(problem.poses);
    chain_cost = condensed.relinearise();
    poses = collectPlaces(chains, problem.poses);
    made.cost_start = made.cost_before;
    condensed.renew(core);
    equations.renew(core, chains.core_edges.size());
  }
  SolveOptions in_core = options;
  in_core.iterations = std::min(options.iterations, kCoreSteps);
  double last_cost = std::numeric_limits<double>::infinity(), last_open = last_cost;
  for (int round = 0; round < kCondensedRounds; ++round) {
    const Descent descent = minimise(equations, cholesky, in_core, core_weights, poses);
    condensed.expand(poses);
    made.iterations.insert(made.iterations.end(), descent.iterations.begin(), descent.iterations.end());
    chain_cost = condensed.relinearise();
    const double open = condensed.mismatch(poses);
    if (!std::isfinite(chain_cost) || !std::isfinite(open)) return std::nullopt;
    const bool over = descent.ending == Ending::Stopped;
    const bool closed = open <= kClosed * descent.cost || descent.cost + open <= kNothing;
    const bool settled = std::abs(descent.cost - last_cost) <=
                             std::max(kSettledLeast, kSettledShare * options.tolerance) * descent.cost ||
                         descent.cost <= kNothing;
    const bool stalls = round >= kFreeRounds && !closed && open > kContraction * last_open;
    if (stalls || descent.ending == Ending::Stuck ||
        (descent.ending == Ending::Iterations && in_core.iterations < options.iterations))
      return std::nullopt;
    last_cost = descent.cost;
    last_open = open;
    if (!over && !(closed && settled)) {
      condensed.renew(core);
      equations.renew(core, chains.core_edges.size());
      continue;
    }
    made.ending = descent.ending;
    made.poses = condensed.assemble(poses);
    moveToFirst(problem, unknowns, made.poses);
    made.cost = cost(problem, made.poses, options.objective, weights);
    if (!made.iterations.empty()) made.iterations.back().cost = made.cost;
    if (!(made.cost <= made.cost_start * (1.0 + kCostRoundOff) + kNothing)) return std::nullopt;
    return made;
  }
  return std::nullopt;
}

template std::optional<Solution<2>> solveCondensed<2>(const Problem<2>&, const SolveOptions&,
                                                      const std::vector<double>&);
template std::optional<Solution<3>> solveCondensed<3>(const Problem<3>&, const SolveOptions&,
                                                      const std::vector<double>&);

}  // namespace pose_graph
