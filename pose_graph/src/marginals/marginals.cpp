// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/marginals.hpp"

#include <utility>

#include "linear/index.hpp"
#include "marginals/common_errors.hpp"
#include "marginals/free_directions.hpp"
#include "marginals/selected_inverse.hpp"
#include "solve/normal_equations.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"

namespace pose_graph {

namespace {

/// The edges with information, with weights applied, and their numbers among all edges.
template <int D>
struct InformativeEdges {
  Problem<D> problem;
  std::vector<std::size_t> number;

  InformativeEdges(const Problem<D>& all, const std::vector<double>& weights) {
    problem.poses.resize(all.poses.size());
    problem.fixed = all.fixed;
    problem.edges.reserve(all.edges.size());
    for (std::size_t e = 0; e < all.edges.size(); ++e) {
      Edge<D> one = all.edges[e];
      if (!weights.empty()) one.information *= weights[e];
      if (one.information.isZero(0.0)) continue;
      problem.edges.push_back(one);
      number.push_back(e);
    }
  }
};

/// A factor of the normal equations, with pins if they are singular, and its inverse on the pattern.
template <int D>
struct Inverse {
  static constexpr int kN = kTangentSize<D>;
  BlockCholesky<kN> cholesky;
  BlockMatrix<kN> selected;

  explicit Inverse(const Symbolic& symbolic) : cholesky(symbolic) {}

  /// Returns the block of two unknowns, row a and column b.
  TangentMatrix<D> block(const BlockPattern& pattern, int a, int b) const {
    const Symbolic& shape = *pattern.symbolic;
    if (a == b) return selected.diagonal[sz(shape.place[sz(a)])];
    const BlockPattern::Slot slot = pattern.slot(a, b);
    if (slot.index < 0) return cholesky.inverseBlock(shape.place[sz(a)], shape.place[sz(b)]);
    const auto& block = selected.lower[sz(slot.index)];
    if (slot.turned) return block.transpose();
    return block;
  }
};

/// d_ab = J_a x_a + J_b x_b: change of T_a_b, in the axes of a, if both poses are moved in the map frame.
template <int D>
struct Between {
  TangentMatrix<D> J_a = TangentMatrix<D>::Zero(), J_b = TangentMatrix<D>::Zero();

  Between(const Rigid<D>& a, const Rigid<D>& b) {
    constexpr int kR = kRotationSize<D>;
    J_b.template topLeftCorner<D, D>() = a.R.transpose();
    J_b.template bottomRightCorner<kR, kR>().setIdentity();
    if constexpr (D == 3) J_b.template bottomRightCorner<3, 3>() = a.R.transpose();
    TangentMatrix<D> T = TangentMatrix<D>::Identity();
    T.template topRightCorner<D, kR>() = turned(Eigen::Matrix<double, D, 1>(b.t - a.t));
    J_a = -J_b * T;
  }
};

}  // namespace

const char* toString(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::Full: return "full";
    case Knowledge::Partial: return "partial";
    case Knowledge::None: return "none";
  }
  return "";
}

urban_nav_core::Matrix6d displayed(const Marginal<3>& marginal, double length) {
  if (marginal.knowledge == Knowledge::Full) return marginal.covariance;
  return urban_nav_core::covarianceForDisplay(marginal.information, length);
}

template <int D>
struct Marginals<D>::Parts {
  static constexpr int kN = kTangentSize<D>;

  NormalEquations<D> equations;
  std::vector<Rigid<D>> poses;
  // One; for singular equations a second one with pins of double strength; empty: overflow.
  std::vector<Inverse<D>> inverse;
  std::vector<std::vector<double>> displaced;  // displacement of the poses by each common error, by places

  Parts(const InformativeEdges<D>& edges, const std::vector<Rigid<D>>& at, const std::vector<CommonError<D>>& common)
      : equations(edges.problem), poses(at) {
    equations.linearise(Objective::Geodesic, poses, {});
    BlockMatrix<kN>& H = equations.H();
    std::vector<int> pinned;
    inverse.emplace_back(equations.symbolic());
    if (!inverse[0].cholesky.factorPinned(H, equations.pattern(), pinned)) {
      inverse.clear();
      return;
    }
    inverse[0].selected = selectedInverse(inverse[0].cholesky, equations.pattern());
    for (const CommonError<D>& each : common) {
      displaced.push_back(commonGradient(equations, poses, each, edges.number));
      if (!displaced.back().empty()) inverse[0].cholesky.solve(displaced.back().data());
    }
    if (pinned.empty()) return;
    std::vector<double> pins;
    for (const int entry : pinned) pins.push_back(BlockCholesky<kN>::computePin(H, entry));
    for (std::size_t k = 0; k < pinned.size(); ++k)
      H.diagonal[sz(pinned[k] / kN)](pinned[k] % kN, pinned[k] % kN) += 2.0 * pins[k];
    inverse.emplace_back(equations.symbolic());
    if (!inverse[1].cholesky.factor(H, equations.pattern())) inverse.clear();
    else inverse[1].selected = selectedInverse(inverse[1].cholesky, equations.pattern());
  }

  /// Returns the change of T_a_b by each common error.
  Displacements<D> displacements(int a, int b) const {
    const Between<D> moves(poses[sz(a)], poses[sz(b)]);
    Displacements<D> changes(kN, static_cast<Eigen::Index>(displaced.size()));
    changes.setZero();
    for (std::size_t c = 0; c < displaced.size(); ++c)
      for (const auto& [pose, J] : {std::make_pair(a, moves.J_a), std::make_pair(b, moves.J_b)}) {
        const int unknown = equations.unknowns().of_pose[sz(pose)];
        if (unknown < 0) continue;
        const double* moved = displaced[c].data() + kN * sz(equations.symbolic().place[sz(unknown)]);
        changes.col(static_cast<Eigen::Index>(c)) += J * Eigen::Map<const Tangent<D>>(moved);
      }
    return changes;
  }

  TangentMatrix<D> between(const Inverse<D>& of, int a, int b) const {
    const Between<D> moves(poses[sz(a)], poses[sz(b)]);
    const int unknown_a = equations.unknowns().of_pose[sz(a)], unknown_b = equations.unknowns().of_pose[sz(b)];
    TangentMatrix<D> sum = TangentMatrix<D>::Zero();
    const auto add = [&](int row, int column, const TangentMatrix<D>& J_row, const TangentMatrix<D>& J_column) {
      if (row >= 0 && column >= 0) sum += J_row * of.block(equations.pattern(), row, column) * J_column.transpose();
    };
    add(unknown_a, unknown_b, moves.J_a, moves.J_b);
    sum += TangentMatrix<D>(sum.transpose());
    add(unknown_a, unknown_a, moves.J_a, moves.J_a);
    add(unknown_b, unknown_b, moves.J_b, moves.J_b);
    return sum;
  }
};

template <int D>
Marginals<D>::Marginals(const Problem<D>& problem, const std::vector<Rigid<D>>& poses,
                        const std::vector<double>& weights, const std::vector<CommonError<D>>& common)
    : parts_(std::make_unique<Parts>(InformativeEdges<D>(problem, weights), poses, common)) {}
template <int D>
Marginals<D>::~Marginals() = default;
template <int D>
Marginals<D>::Marginals(Marginals&&) noexcept = default;
template <int D>
Marginals<D>& Marginals<D>::operator=(Marginals&&) noexcept = default;

template <int D>
int Marginals<D>::first(int pose) const {
  const Unknowns& unknowns = parts_->equations.unknowns();
  return unknowns.origin[sz(unknowns.component[sz(pose)])];
}

template <int D>
Marginal<D> Marginals<D>::between(int a, int b) const {
  Marginal<D> made;
  if (first(a) != first(b) || parts_->inverse.empty()) return made;
  made.knowledge = Knowledge::Full;
  if (a == b) return made;
  made.covariance = parts_->between(parts_->inverse[0], a, b);
  if (parts_->inverse.size() > 1) {
    const TangentMatrix<D> stiffer = parts_->between(parts_->inverse[1], a, b);
    made = withoutPins<D>(made.covariance, 2.0 * (made.covariance - stiffer));
  }
  if (!parts_->displaced.empty()) consider<D>(parts_->displacements(a, b), made);
  return made;
}

template class Marginals<2>;
template class Marginals<3>;

}  // namespace pose_graph
