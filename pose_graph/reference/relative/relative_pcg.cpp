// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph_relative/relative_pcg.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "conjugate_gradients.hpp"

namespace pose_graph {
namespace {

// Number of times a step that does not lower the cost is halved before it is recomputed with damping. Evaluating the
// cost takes a hundredth of the time of a factorisation, and large steps escape rotation wrap-arounds that small ones
// do not: on manhattan from odometry, damping at every small gain ends at a cost of 3 753, this at the optimum, 3 549.
constexpr int kHalvings = 3;
// Levenberg damping in units of odometry's information of each link. Zero until a step fails; then this value,
// multiplied by 4 at each failure and by 0.1 at each success, and zero below the minimum.
constexpr double kFirstDamping = 1e-2, kLeastDamping = 1e-4;
constexpr double kMore = 4.0, kLess = 0.1;
// Above it a step is a millionth of what odometry permits, and no decrease is possible.
constexpr double kMostDamping = 1e12;
// Cost per edge below which double precision has no meaning: a residual of 1e-9 standard deviations.
constexpr double kNothing = 1e-18;

// Returns the accuracy of a step's solution: coarse at first, finer as the predicted decrease falls.
double toleranceFor(double last_share) { return std::clamp(1e-2 * std::sqrt(last_share), 1e-8, 1e-2); }

// Returns the state after the step or after its first halving that lowers the cost; nullopt if none does.
template <int D>
std::optional<ChainState<D>> lowered(const Problem<D>& problem, const ChainState<D>& state, double cost,
                                     Increments<D> step) {
  for (int i = 0; i <= kHalvings; ++i) {
    ChainState<D> next = moved(state, step);
    if (computeCost(problem, next) < cost) return next;
    step *= 0.5;
  }
  return std::nullopt;
}

}  // namespace

template <int D>
RelativeSolution<D> relaxRelative(const Problem<D>& problem, const RelativePcgOptions& options) {
  const Chain<D> chain = makeChain(problem);
  RelativeSolution<D> solution;
  solution.poses = problem.poses;
  solution.components = problem.poses.empty() ? 0 : 1;
  if (chain.links == 0) return solution;

  ChainState<D> state = makeState(problem.poses);
  LinearSystem<D> system(problem, chain, state);
  solution.cost_before = solution.cost_start = system.cost();
  solution.ending = Ending::Iterations;
  const double floor = kNothing * static_cast<double>(problem.edges.size());
  double damping = 0.0, share = 1.0;
  int refused = 0;
  for (int i = 0; i < options.iterations; ++i) {
    if (system.cost() <= floor) {
      solution.ending = Ending::Converged;
      break;
    }
    const Preconditioner<D> preconditioner(system, damping, options.coupled_closures);
    const PcgResult<D> solved =
        conjugateGradients(system, preconditioner, damping, toleranceFor(share), options.products);
    solution.products += solved.iterations;
    const double promise = 2.0 * solved.promise;
    share = std::clamp(promise / system.cost(), 0.0, 1.0);
    // A damped step predicts less than the possible decrease, by about this factor.
    if (promise * (1.0 + damping) <= options.tolerance * system.cost()) {
      solution.ending = Ending::Converged;
      break;
    }
    std::optional<ChainState<D>> next = lowered(problem, state, system.cost(), solved.step);
    if (!next) {
      ++refused;
      damping = std::max(kFirstDamping, kMore * damping);
      if (damping <= kMostDamping) continue;
      solution.ending = Ending::Stuck;
      break;
    }
    state = std::move(*next);
    system = LinearSystem<D>(problem, chain, state);
    solution.iterations.push_back({system.cost(), promise, damping, std::exchange(refused, 0)});
    damping = damping * kLess < kLeastDamping ? 0.0 : damping * kLess;
    if (options.progress && !options.progress(static_cast<int>(solution.iterations.size()), system.cost())) {
      solution.ending = Ending::Stopped;
      break;
    }
  }
  solution.cost = system.cost();
  solution.poses = std::move(state.poses);
  return solution;
}

ReferenceSolver relativeSolver() {
  const auto solve = [](const Problem<3>& problem, const SolveOptions& options, const std::vector<double>& weights) {
    Problem<3> weighted;
    weighted.poses = problem.poses;
    for (std::size_t e = 0; e < problem.edges.size(); ++e) {
      const double weight = weights.empty() ? 1.0 : weights[e];
      if (weight <= 0.0) continue;
      weighted.edges.push_back(problem.edges[e]);
      weighted.edges.back().information *= weight;
    }
    RelativePcgOptions relative;
    relative.iterations = options.iterations;
    relative.tolerance = options.tolerance;
    relative.progress = options.progress;
    return Solution<3>(relaxRelative<3>(weighted, relative));
  };
  return {"relative_pcg", solve};
}

template RelativeSolution<2> relaxRelative(const Problem<2>&, const RelativePcgOptions&);
template RelativeSolution<3> relaxRelative(const Problem<3>&, const RelativePcgOptions&);

}  // namespace pose_graph
