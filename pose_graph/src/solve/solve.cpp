// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>

#include "condense/solve_condensed.hpp"
#include "pose_graph/solution.hpp"
#include "semidefinite/lifted_poses.hpp"
#include "solve/minimise.hpp"
#include "solve/tangled.hpp"
#include "start/first_guess.hpp"

namespace pose_graph {

namespace {

template <int D>
bool allFinite(const std::vector<Rigid<D>>& poses) {
  return std::all_of(poses.begin(), poses.end(),
                     [](const Rigid<D>& pose) { return pose.R.allFinite() && pose.t.allFinite(); });
}

// Limit of poses for the search for another local minimum; above it the search takes too long.
constexpr std::size_t kMostUntangled = 100000;

// Minimum number of poses to condense chains. The full solution of a smaller graph takes fewer and very cheap steps (2
// to 4, instead of 6 of the core graph including all rounds, for random walks of 12 to 30 poses).
constexpr std::size_t kLeastCondensed = 200;

// Rotation (rad) below which two solutions belong to the same local minimum: a wrap-around rotates some poses by a full
// turn.
constexpr double kSameMinimum = 1.0;

template <int D>
bool areInSameMinimum(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (logRotation(Rotation<D>(a[i].R.transpose() * b[i].R)).norm() > kSameMinimum) return false;
  return true;
}

template <int D>
void untangle(NormalEquations<D>& equations, BlockCholesky<kTangentSize<D>>& cholesky, const Problem<D>& problem,
              const SolveOptions& options, const std::vector<double>& weights, Solution<D>& made) {
  auto poses = liftedPoses(problem, made.poses, weights);
  if (!poses || areInSameMinimum(*poses, made.poses)) return;
  Descent descent = minimise(equations, cholesky, options, weights, *poses);
  if (!(descent.cost < made.cost)) return;
  made.poses = std::move(*poses);
  made.cost = descent.cost;
  made.iterations.insert(made.iterations.end(), descent.iterations.begin(), descent.iterations.end());
  made.ending = descent.ending;
}

}  // namespace

template <int D>
double cost(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
            const std::vector<double>& weights) {
  double total = 0.0;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const EdgeTerm<D> term = makeTerm(problem.edges[e]);
    const Rigid<D>&from = poses[static_cast<std::size_t>(term.from)], &to = poses[static_cast<std::size_t>(term.to)];
    const double one = objective == Objective::Geodesic  ? edgeCost<Objective::Geodesic, D>(term, from, to)
                       : objective == Objective::Chordal ? edgeCost<Objective::Chordal, D>(term, from, to)
                                                         : edgeCost<Objective::G2o, D>(term, from, to);
    total += weights.empty() ? one : weights[e] * one;
  }
  return total;
}

template <int D>
Solution<D> solve(const Problem<D>& problem, const SolveOptions& given, const std::vector<double>& weights) {
  SolveOptions options = given;
  // In the plane both objectives are equal, and only the geodesic solver condenses chains, as long chains require.
  if (D == 2 && options.objective == Objective::G2o) options.objective = Objective::Geodesic;
  std::optional<Solution<D>> condensed;
  if (problem.poses.size() >= kLeastCondensed) condensed = solveCondensed(problem, options, weights);
  const bool may_untangle = options.untangle && options.start == Start::Auto;
  const bool is_large = problem.poses.size() > kMostUntangled;
  if (condensed) {
    const bool is_tangled = may_untangle && isTangled(problem, weights, condensed->poses);
    condensed->may_be_tangled = is_tangled && is_large;
    if (!is_tangled || is_large) return *std::move(condensed);
  }
  NormalEquations<D> equations(problem);
  BlockCholesky<kTangentSize<D>> cholesky(equations.symbolic());
  Solution<D> made;
  made.components = equations.unknowns().components;
  made.cost_before = equations.cost(options.objective, problem.poses, weights);
  made.poses = firstGuess(equations, problem, options, weights);
  if (!allFinite(made.poses)) made.poses = problem.poses;  // measurements overflowed
  made.cost_start = equations.cost(options.objective, made.poses, weights);
  Descent descent = minimise(equations, cholesky, options, weights, made.poses);
  made.cost = descent.cost;
  made.iterations = std::move(descent.iterations);
  made.ending = descent.ending;
  if (may_untangle && made.ending != Ending::Stopped && isTangled(problem, weights, made.poses)) {
    if (is_large) made.may_be_tangled = true;
    else untangle(equations, cholesky, problem, options, weights, made);
  }
  if (condensed && condensed->cost < made.cost) return *std::move(condensed);
  if (isEarly(made.ending)) made.gradient = gradientNorm(problem, made.poses, options.objective, weights);
  return made;
}

template double cost<2>(const Problem<2>&, const std::vector<Rigid<2>>&, Objective, const std::vector<double>&);
template double cost<3>(const Problem<3>&, const std::vector<Rigid<3>>&, Objective, const std::vector<double>&);
template Solution<2> solve<2>(const Problem<2>&, const SolveOptions&, const std::vector<double>&);
template Solution<3> solve<3>(const Problem<3>&, const SolveOptions&, const std::vector<double>&);

}  // namespace pose_graph
