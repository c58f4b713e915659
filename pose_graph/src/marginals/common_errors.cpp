// SPDX-License-Identifier: BSD-3-Clause
#include "marginals/common_errors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "linear/index.hpp"

namespace pose_graph {

template <int D>
std::vector<double> commonGradient(const NormalEquations<D>& equations, const std::vector<Rigid<D>>& poses,
                                   const CommonError<D>& common, const std::vector<std::size_t>& number) {
  constexpr int kN = kTangentSize<D>, kR = kRotationSize<D>;
  std::vector<double> gradient(equations.unknowns().pose.size() * kN, 0.0);
  for (std::size_t e = 0; e < number.size(); ++e) {
    if (number[e] >= common.of_edge.size() || common.of_edge[number[e]].isZero(0.0)) continue;
    const EdgeTerm<D>& term = equations.terms()[e];
    const Rigid<D>& from = poses[sz(term.from)];
    Tangent<D> off = common.of_edge[number[e]];  // in the map's axes
    off.template head<D>() = from.R * off.template head<D>().eval();
    if constexpr (D == 3) off.template tail<3>() = from.R * off.template tail<3>().eval();
    const EdgeQuadratic<D> quadratic = edgeQuadratic<Objective::Geodesic, D>(term, from, poses[sz(term.to)]);
    const Tangent<D> pull = quadratic.K * off;
    const typename NormalEquations<D>::EdgePlace& place = equations.edgePlaces()[e];
    if (place.to >= 0) Eigen::Map<Tangent<D>>(gradient.data() + sz(place.to) * kN) += pull;
    if (place.from < 0) continue;
    Tangent<D> back = pull;
    back.template tail<kR>().noalias() += turned(quadratic.d).transpose() * pull.template head<D>();
    Eigen::Map<Tangent<D>>(gradient.data() + sz(place.from) * kN) -= back;
  }
  return gradient;
}

template <int D>
void consider(const Displacements<D>& moved, Marginal<D>& marginal) {
  if (marginal.knowledge == Knowledge::Full) {
    marginal.covariance += moved * moved.transpose();
  } else if (marginal.knowledge == Knowledge::Partial) {
    const Displacements<D> seen = marginal.information * moved;
    const Eigen::MatrixXd inner =
        Eigen::MatrixXd::Identity(moved.cols(), moved.cols()) + Eigen::MatrixXd(moved.transpose() * seen);
    marginal.information -= seen * inner.llt().solve(seen.transpose());
    marginal.information = 0.5 * (marginal.information + marginal.information.transpose()).eval();
  }
}

template std::vector<double> commonGradient<2>(const NormalEquations<2>&, const std::vector<Rigid<2>>&,
                                               const CommonError<2>&, const std::vector<std::size_t>&);
template std::vector<double> commonGradient<3>(const NormalEquations<3>&, const std::vector<Rigid<3>>&,
                                               const CommonError<3>&, const std::vector<std::size_t>&);
template void consider<2>(const Displacements<2>&, Marginal<2>&);
template void consider<3>(const Displacements<3>&, Marginal<3>&);

}  // namespace pose_graph
