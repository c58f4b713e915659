// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "condense/solve_condensed.hpp"
#include "pose_graph/solution.hpp"
#include "solve/minimise.hpp"
#include "start/chordal_start.hpp"
#include "start/first_guess.hpp"

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

template <int D>
bool allFinite(const std::vector<Rigid<D>>& poses) {
  return std::all_of(poses.begin(), poses.end(),
                     [](const Rigid<D>& pose) { return pose.R.allFinite() && pose.t.allFinite(); });
}

// Radians between what an edge measures of a rotation and where it ends up: noise seldom goes so far, knots do.
constexpr double kTangled = 1.1;
constexpr double kValley = 1e-4;  // of the cost: which valley it is is decided by then

template <int D>
bool isTangled(const Problem<D>& problem, const std::vector<double>& weights, const std::vector<Rigid<D>>& poses) {
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    const bool measures =
        edge.information.template bottomRightCorner<rotation_size<D>, rotation_size<D>>().diagonal().minCoeff() > 0.0;
    if (!measures || (!weights.empty() && !(weights[e] > 0.0))) continue;
    const Rotation<D> off = edge.Z.R.transpose() * (poses[sz(edge.from)].R.transpose() * poses[sz(edge.to)].R);
    if (logRotation(off).norm() > kTangled) return true;
  }
  return false;
}

// The chordal objective has fewer valleys, since its rotations pull no harder the further they are off: down it first, from
// where no guess was needed.
template <int D>
void untangle(NormalEquations<D>& equations, BlockCholesky<tangent_size<D>>& cholesky, const Problem<D>& problem,
              const SolveOptions& options, const std::vector<double>& weights, Solution<D>& made) {
  const auto rotations = chordalRotations(equations, problem.poses, weights);
  auto poses = rotations ? translationsFor(equations, *rotations, problem.poses, weights) : std::nullopt;
  if (!poses || !allFinite(*poses)) return;
  SolveOptions chordal = options;
  chordal.objective = Objective::Chordal;
  chordal.tolerance = std::max(options.tolerance, kValley);
  minimise(equations, cholesky, chordal, weights, *poses);
  Descent descent = minimise(equations, cholesky, options, weights, *poses);
  if (!(descent.cost < made.cost)) return;
  made.poses = std::move(*poses);
  made.cost = descent.cost;
  made.iterations.insert(made.iterations.end(), descent.iterations.begin(), descent.iterations.end());
  made.ending = descent.ending;
}

}  // namespace

const char* toString(Ending ending) {
  switch (ending) {
    case Ending::Converged: return "converged";
    case Ending::Iterations: return "iterations";
    case Ending::Stopped: return "stopped";
    case Ending::Stuck: return "stuck";
  }
  return "";
}

template <int D>
double cost(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
            const std::vector<double>& weights) {
  double total = 0.0;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const EdgeTerm<D> term = termOf(problem.edges[e]);
    const Rigid<D>&from = poses[static_cast<std::size_t>(term.from)], &to = poses[static_cast<std::size_t>(term.to)];
    const double one = objective == Objective::Geodesic  ? edgeCost<Objective::Geodesic, D>(term, from, to)
                       : objective == Objective::Chordal ? edgeCost<Objective::Chordal, D>(term, from, to)
                                                         : edgeCost<Objective::G2o, D>(term, from, to);
    total += weights.empty() ? one : weights[e] * one;
  }
  return total;
}

template <int D>
Solution<D> solve(const Problem<D>& problem, const SolveOptions& options, const std::vector<double>& weights) {
  auto condensed = solveCondensed(problem, options, weights);
  const bool may_untangle = options.start == Start::Auto && options.objective != Objective::Chordal;
  if (condensed && !(may_untangle && isTangled(problem, weights, condensed->poses))) return *std::move(condensed);
  NormalEquations<D> equations(problem);
  BlockCholesky<tangent_size<D>> cholesky(equations.symbolic());
  Solution<D> made;
  made.components = equations.unknowns().components;
  made.cost_before = equations.cost(options.objective, problem.poses, weights);
  made.poses = firstGuess(equations, problem, options, weights);
  if (!allFinite(made.poses)) made.poses = problem.poses;  // measurements that add up to infinity
  made.cost_start = equations.cost(options.objective, made.poses, weights);
  Descent descent = minimise(equations, cholesky, options, weights, made.poses);
  made.cost = descent.cost;
  made.iterations = std::move(descent.iterations);
  made.ending = descent.ending;
  if (may_untangle && made.ending != Ending::Stopped && isTangled(problem, weights, made.poses))
    untangle(equations, cholesky, problem, options, weights, made);
  if (condensed && condensed->cost < made.cost) return *std::move(condensed);
  return made;
}

template double cost<2>(const Problem<2>&, const std::vector<Rigid<2>>&, Objective, const std::vector<double>&);
template double cost<3>(const Problem<3>&, const std::vector<Rigid<3>>&, Objective, const std::vector<double>&);
template Solution<2> solve<2>(const Problem<2>&, const SolveOptions&, const std::vector<double>&);
template Solution<3> solve<3>(const Problem<3>&, const SolveOptions&, const std::vector<double>&);

}  // namespace pose_graph
