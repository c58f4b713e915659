// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "linear/index.hpp"
#include "objective/objective.hpp"
#include "pose_graph/solution.hpp"
#include "solve/normal_equations.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace pose_graph {

namespace {

template <Objective objective, int D>
std::vector<Tangent<D>> gradientAs(const Problem<D>& problem, const std::vector<Rigid<D>>& poses,
                                   const std::vector<double>& weights) {
  std::vector<Tangent<D>> result(poses.size(), Tangent<D>::Zero());
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const double weight = weights.empty() ? 1.0 : weights[e];
    if (weight == 0.0) continue;
    const EdgeTerm<D> term = makeTerm(problem.edges[e]);
    const EdgeQuadratic<D> at = edgeQuadratic<objective, D>(term, poses[sz(term.from)], poses[sz(term.to)]);
    const Tangent<D> by_to = 2.0 * weight * at.g_to;
    Tangent<D> by_from = -by_to;
    by_from.template tail<kRotationSize<D>>() -= turned(at.d).transpose() * by_to.template head<D>();
    result[sz(term.to)] += by_to;
    result[sz(term.from)] += by_from;
  }
  return result;
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

std::string endingWarning(Ending ending, std::size_t iterations, double gradient) {
  if (!isEarly(ending)) return "";
  const std::string away = ": the gradient of the cost is " + urban_nav_core::formatNumber(gradient, 3);
  if (ending == Ending::Iterations)
    return "the relaxation ended after " + std::to_string(iterations) + " iterations before it reached the minimum" +
           away + "; allow more with pose_graph.iterations";
  return "the relaxation found no step that lowers the cost, but did not reach the minimum" + away +
         "; the information of edges differs by more than double precision resolves, or is zero in some direction";
}

template <int D>
double gradientNorm(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
                    const std::vector<double>& weights) {
  const std::vector<Tangent<D>> gradient =
      objective == Objective::Geodesic  ? gradientAs<Objective::Geodesic, D>(problem, poses, weights)
      : objective == Objective::Chordal ? gradientAs<Objective::Chordal, D>(problem, poses, weights)
                                        : gradientAs<Objective::G2o, D>(problem, poses, weights);
  double sum = 0.0;
  for (const int pose : makeUnknowns(problem).pose) sum += gradient[sz(pose)].squaredNorm();
  return std::sqrt(sum);
}

template double gradientNorm<2>(const Problem<2>&, const std::vector<Rigid<2>>&, Objective, const std::vector<double>&);
template double gradientNorm<3>(const Problem<3>&, const std::vector<Rigid<3>>&, Objective, const std::vector<double>&);

}  // namespace pose_graph
