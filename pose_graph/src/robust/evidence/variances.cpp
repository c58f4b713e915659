// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/variances.hpp"

#include <algorithm>
#include <cmath>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "objective/whitened_edge.hpp"
#include "pose_graph/marginals.hpp"
#include "pose_graph/scales.hpp"

namespace pose_graph {

namespace {

const double kDeviationPrior = std::log(kStatedWithin);
constexpr double kLargestFactor = 1e8;       // applies if the residuals are all zero or have no redundancy
constexpr std::size_t kLeastClosures = 100;  // deviations are then accurate to 1/15

}  // namespace

template <int D>
VarianceComponents varianceComponents(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                      const std::vector<double>& weights, const std::vector<Rigid<D>>& poses) {
  constexpr int kR = kRotationSize<D>;
  const Marginals<D> marginals(problem, poses, weights);
  VarianceComponents made;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (!(weights[e] > 0.0)) continue;
    const Edge<D>& edge = problem.edges[e];
    const Marginal<D> marginal = marginals.between(edge.from, edge.to);
    if (marginal.knowledge != Knowledge::Full) continue;
    const Rotation<D> A = poses[sz(edge.from)].R * edge.Z.R;
    Tangent<D> error;
    error.template head<D>() = A.transpose() * (edge.measured(poses[sz(edge.to)]).t - poses[sz(edge.from)].t) -
                               edge.Z.R.transpose() * edge.Z.t;
    error.template tail<kR>() = logRotation(Rotation<D>(A.transpose() * poses[sz(edge.to)].R));
    TangentMatrix<D> turn = TangentMatrix<D>::Identity();
    turn.template topLeftCorner<D, D>() = edge.Z.R.transpose();
    if constexpr (D == 3) turn.template bottomRightCorner<3, 3>() = edge.Z.R.transpose();
    if (edge.hasLever()) turn = (turn * leverJacobian(edge, poses[sz(edge.from)], poses[sz(edge.to)])).eval();
    const TangentMatrix<D> covariance = turn * marginal.covariance * turn.transpose();
    const Tangent<D> weighted = edge.information * error;
    const TangentMatrix<D> leverage = weights[e] * edge.information * covariance;
    VarianceComponent* const group = made.of[roles[e] == EdgeRole::Candidate];
    const int rank = whitened(edge).rank;
    const double rank_turn =
        std::min(rank, edge.information.template bottomRightCorner<kR, kR>().trace() > 0.0 ? kR : 0);
    group[0].squares += error.template head<D>().dot(weighted.template head<D>());
    group[0].redundancy += std::max(0.0, rank - rank_turn - leverage.template topLeftCorner<D, D>().trace());
    group[1].squares += error.template tail<kR>().dot(weighted.template tail<kR>());
    group[1].redundancy += std::max(0.0, rank_turn - leverage.template bottomRightCorner<kR, kR>().trace());
  }
  return made;
}

double likeliestFactor(const VarianceComponent& component) {
  double u = 0.0;  // log of the factor
  const double variance = 4.0 * kDeviationPrior * kDeviationPrior;
  for (int i = 0; i < 60; ++i) {
    const double ratio = std::max(0.0, component.squares) * std::exp(-u);
    const double gradient = 0.5 * (ratio - component.redundancy) - u / variance;
    const double step = gradient / (0.5 * ratio + 1.0 / variance);
    u += std::max(-2.0, std::min(2.0, step));
    if (std::abs(step) < 1e-6) break;
  }
  return std::max(1.0 / kLargestFactor, std::min(kLargestFactor, std::exp(u)));
}

double logPriorOfFactor(double factor) {
  const double z = 0.5 * std::log(factor) / kDeviationPrior;
  return -0.5 * z * z;
}

template <int D>
DeviationScales estimateScales(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<EdgeAssessment>& edges, const std::vector<Rigid<D>>& poses,
                               const SelectionReport& selection) {
  std::vector<double> weights;
  std::size_t closures = 0;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const bool closure = roles[e] == EdgeRole::Candidate;
    weights.push_back(edges[e].weight / (closure ? selection.closure_factor : selection.odometry_factor));
    closures += closure && edges[e].weight > 0.0;
  }
  if (closures < kLeastClosures) return {};
  const VarianceComponents components = varianceComponents(problem, roles, weights, poses);
  const auto deviation = [&](int group, int kind) { return std::sqrt(likeliestFactor(components.of[group][kind])); };
  return {deviation(0, 0), deviation(0, 1), deviation(1, 0), deviation(1, 1)};
}

namespace {

// Loops of near closures (closure_loops.hpp) do not contain errors that appear only over long paths. Until closures
// determine the factor, twice the deviation is assumed. A factor of 1 rejects more true closures (manhattan: 25
// instead of 12 of 1954), 2 performs equally.
constexpr double kCaution = 4.0;
constexpr double kPriorTangents = 10.0;

}  // namespace

template <int D>
double varianceFactor(const ClosureEvaluator<D>& evaluator, const std::vector<char>& in,
                      const std::vector<Rigid<D>>& poses, int unknowns, const Thresholds& thresholds, double scale) {
  const double expected = scale < 1.0 ? std::min(1.0, kCaution * scale) : scale;
  std::vector<std::pair<double, int>> squares;
  double redundancy = -static_cast<double>(unknowns) * kTangentSize<D>;
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (!in[e]) continue;
    const WhitenedEdge<D>& edge = evaluator.edge(static_cast<int>(e));
    squares.emplace_back(whitenedError(edge, poses[sz(edge.from)], poses[sz(edge.to)]).squaredNorm(), edge.rank);
    redundancy += edge.rank;
  }
  if (redundancy <= 0.0) return expected;
  const double prior = kPriorTangents * kTangentSize<D>;
  double factor = expected;
  for (int i = 0; i < 8; ++i) {
    double sum = prior * expected;
    for (const auto& [square, rank] : squares) sum += std::min(square, factor * thresholds.limit[sz(rank)]);
    factor = std::min(sum / (redundancy + prior), std::max(1.0, scale));
  }
  return factor;
}

template VarianceComponents varianceComponents<2>(const Problem<2>&, const std::vector<EdgeRole>&,
                                                  const std::vector<double>&, const std::vector<Rigid<2>>&);
template VarianceComponents varianceComponents<3>(const Problem<3>&, const std::vector<EdgeRole>&,
                                                  const std::vector<double>&, const std::vector<Rigid<3>>&);
template DeviationScales estimateScales<2>(const Problem<2>&, const std::vector<EdgeRole>&,
                                           const std::vector<EdgeAssessment>&, const std::vector<Rigid<2>>&,
                                           const SelectionReport&);
template DeviationScales estimateScales<3>(const Problem<3>&, const std::vector<EdgeRole>&,
                                           const std::vector<EdgeAssessment>&, const std::vector<Rigid<3>>&,
                                           const SelectionReport&);
template double varianceFactor<2>(const ClosureEvaluator<2>&, const std::vector<char>&, const std::vector<Rigid<2>>&,
                                  int, const Thresholds&, double);
template double varianceFactor<3>(const ClosureEvaluator<3>&, const std::vector<char>&, const std::vector<Rigid<3>>&,
                                  int, const Thresholds&, double);

}  // namespace pose_graph
