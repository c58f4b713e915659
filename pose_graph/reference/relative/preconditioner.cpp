// SPDX-License-Identifier: BSD-3-Clause
#include "preconditioner.hpp"

#include <algorithm>
#include <numeric>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

template <int D>
Preconditioner<D>::Preconditioner(const LinearSystem<D>& system, double damping, int coupled) : system_(system) {
  const auto links = static_cast<std::size_t>(system.links());
  inverses_.reserve(links);
  spread_.reserve(links + 1);
  spread_.push_back(TangentMatrix<D>::Zero());
  for (std::size_t i = 0; i < links; ++i) {
    const TangentMatrix<D> N = (1.0 + damping) * system.blocks()[i];
    inverses_.push_back(urban_nav_core::SmallCholesky<kTangentSize<D>>(N).inverse());
    const TangentMatrix<D> U = system.linkMatrix(static_cast<int>(i));
    spread_.push_back(spread_.back() + U * inverses_.back() * U.transpose());
  }
  choose(static_cast<std::size_t>(std::max(coupled, 0)));
  factorise();
}

template <int D>
void Preconditioner<D>::choose(std::size_t coupled) {
  const auto& rows = system_.rows();
  chosen_.resize(rows.size());
  std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
  if (rows.size() <= coupled) return;
  std::vector<double> strain;
  strain.reserve(rows.size());
  for (const auto& row : rows) {
    const auto low = static_cast<std::size_t>(std::min(row.from, row.to));
    const auto high = static_cast<std::size_t>(std::max(row.from, row.to));
    strain.push_back((row.G * (spread_[high] - spread_[low]) * row.G.transpose()).trace());
  }
  std::stable_sort(chosen_.begin(), chosen_.end(),
                   [&strain](std::size_t a, std::size_t b) { return strain[a] > strain[b]; });
  chosen_.resize(coupled);
  std::sort(chosen_.begin(), chosen_.end());
}

template <int D>
void Preconditioner<D>::factorise() {
  constexpr Eigen::Index kD = kTangentSize<D>;
  const auto count = static_cast<Eigen::Index>(chosen_.size());
  factor_ = Eigen::MatrixXd::Zero(kD * count, kD * count);
  for (Eigen::Index column = 0; column < count; ++column) {
    const auto& b = system_.rows()[chosen_[static_cast<std::size_t>(column)]];
    for (Eigen::Index line = column; line < count; ++line) {
      const auto& a = system_.rows()[chosen_[static_cast<std::size_t>(line)]];
      const int low = std::max(std::min(a.from, a.to), std::min(b.from, b.to));
      const int high = std::min(std::max(a.from, a.to), std::max(b.from, b.to));
      if (low >= high) continue;
      const double sign = (a.from < a.to) == (b.from < b.to) ? 1.0 : -1.0;
      const TangentMatrix<D> common = spread_[static_cast<std::size_t>(high)] - spread_[static_cast<std::size_t>(low)];
      factor_.block<kD, kD>(kD * line, kD * column) = sign * (a.G * common * b.G.transpose());
    }
    factor_.block<kD, kD>(kD * column, kD * column) += TangentMatrix<D>::Identity();
  }
  // The identity keeps it positive definite except for round-off in the prefix sums; in that case only the chain is
  // used.
  if (!urban_nav_core::choleskyInPlace(factor_)) chosen_.clear();
}

template <int D>
void Preconditioner<D>::apply(const Increments<D>& step, Increments<D>& result, Increments<D>& scratch) const {
  constexpr Eigen::Index kD = kTangentSize<D>;
  result.resize(Eigen::NoChange, step.cols());
  const auto chain_alone = [this](const Increments<D>& in, Increments<D>& out) {
    for (Eigen::Index i = 0; i < in.cols(); ++i)
      out.col(i) = (inverses_[static_cast<std::size_t>(i)] * in.col(i)).eval();
  };
  chain_alone(step, result);
  if (chosen_.empty()) return;
  system_.sweep(result, scratch);
  Eigen::MatrixXd y(kD * static_cast<Eigen::Index>(chosen_.size()), 1);
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const auto& row = system_.rows()[chosen_[i]];
    y.block<kD, 1>(kD * static_cast<Eigen::Index>(i), 0) = row.G * (scratch.col(row.to) - scratch.col(row.from));
  }
  urban_nav_core::solveLowerInPlace(factor_, y);
  urban_nav_core::solveLowerTransposedInPlace(factor_, y);
  scratch.setZero();
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const auto& row = system_.rows()[chosen_[i]];
    const Tangent<D> pull = row.G.transpose() * y.block<kD, 1>(kD * static_cast<Eigen::Index>(i), 0);
    scratch.col(row.to) -= pull;
    scratch.col(row.from) += pull;
  }
  Increments<D> force(kD, step.cols());
  system_.sweepBack(scratch, force);
  chain_alone(force, force);
  result += force;
}

template class Preconditioner<2>;
template class Preconditioner<3>;

}  // namespace pose_graph
