// SPDX-License-Identifier: BSD-3-Clause
#include "start/first_guess.hpp"

#include "linear/index.hpp"
#include "start/aligned.hpp"
#include "start/along_edges.hpp"
#include "start/chordal_start.hpp"

namespace pose_graph {

template <int D>
std::vector<Rigid<D>> firstGuess(const NormalEquations<D>& equations, const Problem<D>& problem,
                                 const SolveOptions& options, const std::vector<double>& weights) {
  if (options.start == Start::Vertices) return problem.poses;
  if (options.start == Start::Odometry) return posesAlongEdges(problem);
  if (options.start == Start::Identity) {
    std::vector<Rigid<D>> poses(problem.poses.size());
    for (const int pose : problem.fixed) poses[sz(pose)] = problem.poses[sz(pose)];
    return poses;
  }
  if (!problem.fixed.empty() && !areRotationsTied(problem, weights)) {
    std::vector<Rigid<D>> aligned = posesAlongEdges(problem);
    alignWithFixed(problem, weights, aligned);
    const double cost_aligned = equations.cost(options.objective, aligned, weights);
    return cost_aligned < equations.cost(options.objective, problem.poses, weights) ? aligned : problem.poses;
  }
  const auto rotations = chordalRotations(equations, problem.poses, weights);
  if (!rotations) return problem.poses;
  const auto poses = translationsFor(equations, *rotations, problem.poses, weights);
  // The comparison also rejects poses with a cost of NaN.
  if (poses &&
      equations.cost(options.objective, *poses, weights) < equations.cost(options.objective, problem.poses, weights))
    return *poses;
  return problem.poses;
}

template std::vector<Rigid<2>> firstGuess<2>(const NormalEquations<2>&, const Problem<2>&, const SolveOptions&,
                                             const std::vector<double>&);
template std::vector<Rigid<3>> firstGuess<3>(const NormalEquations<3>&, const Problem<3>&, const SolveOptions&,
                                             const std::vector<double>&);

}  // namespace pose_graph
