// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "linear/block_cholesky.hpp"
#include "objective/objective.hpp"
#include "pose_graph/solution.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

// The shift is tried from a gap of this share of the cost on, ten times as large each time. What is less drowns in round-off.
constexpr double kLeastShare = 1e-9, kCertified = 1e-4;
// Of the largest entry: as much as a factorisation of some thousand poses may err.
constexpr double kRoundOff = 1e-13;

/// M by poses: row and column 0 of a block are the translation, the others the rotation.
template <int D>
struct QuadraticForm {
  static constexpr int B = D + 1;
  using Block = Eigen::Matrix<double, B, B>;

  std::vector<EdgeTerm<D>> terms;
  Adjacency graph;
  Symbolic symbolic;
  BlockPattern pattern;
  BlockMatrix<B> M;

  QuadraticForm(const Problem<D>& problem, const std::vector<double>& weights)
      : graph(neighbours(problem)), symbolic(analyse(graph)), pattern(graph, symbolic) {
    M.setZero(pattern);
    for (std::size_t e = 0; e < problem.edges.size(); ++e) {
      EdgeTerm<D> term = termOf(problem.edges[e]);
      const double weight = weights.empty() ? 1.0 : weights[e];
      term.kappa *= weight;
      term.tau *= weight;
      terms.push_back(term);
      // kappa |R_j - R_i R_ij|^2 + tau |t_j - t_i - R_i t_ij|^2
      const Eigen::Matrix<double, D, 1> t = term.R_Z * term.t_Z;
      Block& from = M.diagonal[sz(symbolic.place[sz(term.from)])];
      Block& to = M.diagonal[sz(symbolic.place[sz(term.to)])];
      from(0, 0) += term.tau;
      from.template topRightCorner<1, D>() += term.tau * t.transpose();
      from.template bottomLeftCorner<D, 1>() += term.tau * t;
      from.template bottomRightCorner<D, D>() += term.tau * t * t.transpose();
      from.template bottomRightCorner<D, D>().diagonal().array() += term.kappa;
      to(0, 0) += term.tau;
      to.template bottomRightCorner<D, D>().diagonal().array() += term.kappa;
      Block across = Block::Zero();  // row of `from`, column of `to`
      across(0, 0) = -term.tau;
      across.template bottomLeftCorner<D, 1>() = -term.tau * t;
      across.template bottomRightCorner<D, D>() = -term.kappa * term.R_Z;
      const BlockPattern::Slot slot = pattern.slot(term.from, term.to);
      if (slot.turned) M.lower[sz(slot.index)] += across.transpose();
      else M.lower[sz(slot.index)] += across;
    }
  }

  static Adjacency neighbours(const Problem<D>& problem) {
    std::vector<std::pair<int, int>> pairs;
    for (const Edge<D>& edge : problem.edges) pairs.emplace_back(edge.from, edge.to);
    return adjacencyOf(static_cast<int>(problem.poses.size()), pairs);
  }
};

/// Half the gradient by each rotation, (X M)_i, seen from it and symmetric.
template <int D>
std::vector<Rotation<D>> multipliers(const std::vector<EdgeTerm<D>>& terms, const std::vector<Rigid<D>>& poses) {
  std::vector<Rotation<D>> made(poses.size(), Rotation<D>::Zero());
  for (const EdgeTerm<D>& term : terms) {
    const Rigid<D>&from = poses[sz(term.from)], &to = poses[sz(term.to)];
    const Eigen::Matrix<double, D, 1> t = term.R_Z * term.t_Z;
    const Rotation<D> turn = from.R * term.R_Z - to.R;
    const Eigen::Matrix<double, D, 1> shift = to.t - from.t - from.R * t;
    made[sz(term.from)] +=
        from.R.transpose() * (term.kappa * turn * term.R_Z.transpose() - term.tau * shift * t.transpose());
    made[sz(term.to)] -= term.kappa * to.R.transpose() * turn;
  }
  for (Rotation<D>& each : made) each = (0.5 * (each + each.transpose())).eval();
  return made;
}

}  // namespace

template <int D>
Certificate certify(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) {
  Certificate made;
  made.cost = cost(problem, poses, Objective::Chordal, weights);
  if (problem.edges.empty() || !std::isfinite(made.cost)) return made;
  QuadraticForm<D> form(problem, weights);
  const std::vector<Rotation<D>> lambda = multipliers<D>(form.terms, poses);
  BlockMatrix<D + 1>& S = form.M;
  double dual = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    dual += lambda[i].trace();
    auto& block = S.diagonal[sz(form.symbolic.place[i])];
    block.template bottomRightCorner<D, D>() -= lambda[i];
    largest = std::max(largest, block.diagonal().cwiseAbs().maxCoeff());
  }
  // All of a part may be shifted together at no cost: the translation of its first pose is held, which changes no sign.
  const Unknowns unknowns = unknownsOf(problem);
  std::vector<char> held(poses.size(), 0);  // by place
  for (std::size_t i = 0; i < poses.size(); ++i) held[sz(form.symbolic.place[i])] = unknowns.of_pose[i] < 0;
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (held[k]) {
      auto& block = S.diagonal[k];
      block.row(0).setZero();
      block.col(0).setZero();
      block(0, 0) = largest;
    }
    for (int e = form.pattern.first[k]; e < form.pattern.first[k + 1]; ++e) {
      if (held[k]) S.lower[sz(e)].col(0).setZero();
      if (held[sz(form.pattern.row[sz(e)])]) S.lower[sz(e)].row(0).setZero();
    }
  }
  const double numbers = static_cast<double>(D) * static_cast<double>(poses.size());
  BlockCholesky<D + 1> cholesky(form.symbolic);
  double shifted = 0.0;
  for (double eta = std::max(kLeastShare * made.cost / numbers, kRoundOff * largest); eta < largest; eta *= 10.0) {
    for (auto& block : S.diagonal) block.template bottomRightCorner<D, D>().diagonal().array() += eta - shifted;
    shifted = eta;
    if (!cholesky.factor(S, form.pattern)) continue;
    made.gap = std::max(made.cost - dual, 0.0) + eta * numbers;
    break;
  }
  // Where measurements fit to the last digit, the cost is nothing and any share of it less.
  const double nothing = 1e3 * kRoundOff * largest * numbers;
  made.certified = made.gap && *made.gap <= std::max(kCertified * made.cost, nothing);
  return made;
}

template Certificate certify(const Problem<2>&, const std::vector<Rigid<2>>&, const std::vector<double>&);
template Certificate certify(const Problem<3>&, const std::vector<Rigid<3>>&, const std::vector<double>&);

}  // namespace pose_graph
