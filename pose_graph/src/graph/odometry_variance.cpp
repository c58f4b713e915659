// SPDX-License-Identifier: BSD-3-Clause
#include "graph/odometry_variance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "manifold/rotation.hpp"
#include "pose_graph/marginals.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

namespace {

constexpr int kVarianceRounds = 5;         // in the fifth round the factor changes by 1 %
constexpr double kVarianceSettled = 0.02;  // relative change of the factor
constexpr double kVariancePrior = 6.0;     // weight of the stated variance, in degrees of freedom

// Returns the number of parts joined by closures; each join determines one pose.
int joinedParts(const Problem<3>& problem, std::size_t chains, const std::vector<double>& weights) {
  Problem<3> joined = problem.withoutEdges();
  joined.edges.assign(problem.edges.begin(), problem.edges.begin() + static_cast<std::ptrdiff_t>(chains));
  const int apart = makeUnknowns(joined).components;
  for (std::size_t e = chains; e < problem.edges.size(); ++e)
    if (weights[e] > 0.0) joined.edges.push_back(problem.edges[e]);
  return apart - makeUnknowns(joined).components;
}

// Returns the redundancy of the chains: the share of the closures' residuals absorbed by the chains.
std::optional<double> redundancyOfChains(const Problem<3>& problem, std::size_t chains,
                                         const std::vector<double>& weights, const std::vector<Rigid<3>>& poses) {
  const Marginals<3> marginals(problem, poses, weights);
  double sum = -static_cast<double>(kTangentSize<3>) * joinedParts(problem, chains, weights);
  for (std::size_t e = chains; e < problem.edges.size(); ++e) {
    if (!(weights[e] > 0.0)) continue;
    const Edge<3>& edge = problem.edges[e];
    const Marginal<3> known = marginals.between(edge.from, edge.to);
    if (known.knowledge != Knowledge::Full) return std::nullopt;
    TangentMatrix<3> turn = TangentMatrix<3>::Zero();  // from the axes of `from` to those of Z's child
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = edge.Z.R.transpose();
    if (edge.hasLever())
      turn = (turn *
              leverJacobian(edge, poses[static_cast<std::size_t>(edge.from)], poses[static_cast<std::size_t>(edge.to)]))
                 .eval();
    sum += (edge.information * (turn * known.covariance * turn.transpose())).trace();
  }
  if (!std::isfinite(sum) || sum <= 0.0) return std::nullopt;
  return sum;
}

double costOfChains(Problem<3> problem, std::size_t chains, const std::vector<Rigid<3>>& poses) {
  problem.edges.resize(chains);
  return cost(problem, poses, Objective::Geodesic);
}

}  // namespace

double takeOdometryVariance(Problem<3>& problem, std::size_t chains, const std::vector<double>& weights,
                            const SolveOptions& options, Solution<3>& solution, double largest, double begin) {
  if (std::none_of(weights.begin() + static_cast<std::ptrdiff_t>(chains), weights.end(),
                   [](double weight) { return weight > 0.0; }))
    return begin;
  SolveOptions from_here = options;
  from_here.start = Start::Vertices;
  double factor = begin;
  for (int round = 0; round < kVarianceRounds; ++round) {
    const auto redundancy = redundancyOfChains(problem, chains, weights, solution.poses);
    if (!redundancy) return factor;
    const double measured = factor * costOfChains(problem, chains, solution.poses);
    const double likeliest = (measured + kVariancePrior) / (*redundancy + kVariancePrior);
    const double next = std::clamp(likeliest, 1.0, largest), ratio = next / factor;
    if (!std::isfinite(next) || std::abs(ratio - 1.0) <= kVarianceSettled) return factor;
    factor = next;
    for (std::size_t e = 0; e < chains; ++e) problem.edges[e].information /= ratio;
    problem.poses = solution.poses;
    Solution<3> again = solve(problem, from_here, weights);
    again.cost_before = solution.cost_before;
    solution = std::move(again);
  }
  return factor;
}

}  // namespace pose_graph
