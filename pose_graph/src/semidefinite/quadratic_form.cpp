// SPDX-License-Identifier: BSD-3-Clause
#include "semidefinite/quadratic_form.hpp"

#include <utility>

#include "linear/index.hpp"

namespace pose_graph {

namespace {

/// Returns the edges with weight, with the weights in their information.
template <int D>
Problem<D> weighed(const Problem<D>& problem, const std::vector<double>& weights) {
  Problem<D> made;
  made.poses.resize(problem.poses.size());
  made.fixed = problem.fixed;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const double weight = weights.empty() ? 1.0 : weights[e];
    if (!(weight > 0.0)) continue;
    made.edges.push_back(problem.edges[e]);
    made.edges.back().information *= weight;
  }
  return made;
}

template <int D>
Adjacency neighbours(const Problem<D>& problem) {
  std::vector<std::pair<int, int>> pairs;
  for (const Edge<D>& edge : problem.edges) pairs.emplace_back(edge.from, edge.to);
  return makeAdjacency(static_cast<int>(problem.poses.size()), pairs);
}

}  // namespace

template <int D>
QuadraticForm<D>::QuadraticForm(const Problem<D>& problem, const std::vector<double>& weights)
    : QuadraticForm(weighed(problem, weights)) {}

template <int D>
QuadraticForm<D>::QuadraticForm(const Problem<D>& problem)
    : unknowns(makeUnknowns(problem)),
      graph(neighbours(problem)),
      symbolic(analyse(graph)),
      pattern(graph, symbolic),
      held_(problem.poses.size(), 0),
      fixed_(problem.poses.size(), 0) {
  M.setZero(pattern);
  for (const Edge<D>& edge : problem.edges) {
    const EdgeTerm<D> term = makeTerm(edge);
    terms.push_back(term);
    // kappa |R_j - R_i R_ij|^2 + tau |t_j + R_j lever - t_i - R_i t_ij|^2
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
    if (term.has_lever) {
      to.template topRightCorner<1, D>() += term.tau * term.lever.transpose();
      to.template bottomLeftCorner<D, 1>() += term.tau * term.lever;
      to.template bottomRightCorner<D, D>() += term.tau * term.lever * term.lever.transpose();
    }
    Block across = Block::Zero();  // row of `from`, column of `to`
    across(0, 0) = -term.tau;
    across.template bottomLeftCorner<D, 1>() = -term.tau * t;
    across.template bottomRightCorner<D, D>() = -term.kappa * term.R_Z;
    if (term.has_lever) {
      across.template topRightCorner<1, D>() = -term.tau * term.lever.transpose();
      across.template bottomRightCorner<D, D>() -= term.tau * t * term.lever.transpose();
    }
    const BlockPattern::Slot slot = pattern.slot(term.from, term.to);
    if (slot.turned) M.lower[sz(slot.index)] += across.transpose();
    else M.lower[sz(slot.index)] += across;
  }
  for (const int i : unknowns.origin) held_[sz(symbolic.place[sz(i)])] = 1;
  for (const int i : problem.fixed) fixed_[sz(symbolic.place[sz(i)])] = 1;
}

template <int D>
void QuadraticForm<D>::hold(BlockMatrix<kB>& A, double pivot) const {
  for (std::size_t k = 0; k < held_.size(); ++k) {
    auto& block = A.diagonal[k];
    if (fixed_[k]) {
      block = pivot * Block::Identity();
    } else if (held_[k]) {
      block.row(0).setZero();
      block.col(0).setZero();
      block(0, 0) = pivot;
    }
    for (int e = pattern.first[k]; e < pattern.first[k + 1]; ++e) {
      const std::size_t row = sz(pattern.row[sz(e)]);
      auto& across = A.lower[sz(e)];
      if (fixed_[k] || fixed_[row]) across.setZero();
      if (held_[k]) across.col(0).setZero();
      if (held_[row]) across.row(0).setZero();
    }
  }
}

template struct QuadraticForm<2>;
template struct QuadraticForm<3>;

}  // namespace pose_graph
