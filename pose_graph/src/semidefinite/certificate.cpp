// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/index.hpp"
#include "pose_graph/solution.hpp"
#include "semidefinite/quadratic_form.hpp"

namespace pose_graph {

namespace {

// The shift is tried from a gap of this share of the cost on, ten times as large each time, and then between the last
// two, by halves of the exponent. What is less drowns in round-off.
constexpr double kLeastEigenvalueShare = 1e-9, kCertified = 1e-4;
constexpr int kHalvings = 4;
// Of the cost: what a further step may still gain.
constexpr double kConverged = 1e-15;
// Of the largest entry: as much as a factorisation of some thousand poses may err.
constexpr double kFactorRoundOff = 1e-13;
// Of the same and the number of rotations' entries: the cost of residuals that are round-off.
constexpr double kNoCost = 1e-20;

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
  form.holdTranslations(S, largest);
  const double numbers = static_cast<double>(D) * static_cast<double>(poses.size());
  BlockCholesky<D + 1> cholesky(form.symbolic);
  double shifted = 0.0;
  const auto isPositive = [&](double eta) {
    for (auto& block : S.diagonal) block.template bottomRightCorner<D, D>().diagonal().array() += eta - shifted;
    shifted = eta;
    return cholesky.factor(S, form.pattern);
  };
  double eta = std::max(kLeastEigenvalueShare * made.cost / numbers, kFactorRoundOff * largest), too_small = 0.0;
  for (; eta < largest && !isPositive(eta); eta *= 10.0) too_small = eta;
  if (eta < largest) {
    for (int halving = 0; halving < kHalvings && too_small > 0.0; ++halving) {
      const double between = std::sqrt(too_small * eta);
      (isPositive(between) ? eta : too_small) = between;
    }
    made.gap = std::max(made.cost - dual, 0.0) + eta * numbers;
  }
  // Where measurements fit to the last digit, the cost is nothing and any share of it less.
  const double scale = largest * numbers;
  const bool fits = made.cost <= kNoCost * scale && made.gap && *made.gap <= 1e3 * kFactorRoundOff * scale;
  made.certified = fits || (made.gap && *made.gap <= kCertified * made.cost);
  return made;
}

template <int D>
Certificate certifyConverged(const Problem<D>& problem, std::vector<Rigid<D>>& poses,
                             const std::vector<double>& weights) {
  SolveOptions options;
  options.objective = Objective::Chordal;
  options.start = Start::Vertices;
  options.tolerance = kConverged;
  Solution<D> converged = solve(Problem<D>{poses, problem.edges}, options, weights);
  if (converged.cost <= cost(problem, poses, Objective::Chordal, weights)) poses = std::move(converged.poses);
  return certify(problem, poses, weights);
}

template Certificate certify(const Problem<2>&, const std::vector<Rigid<2>>&, const std::vector<double>&);
template Certificate certify(const Problem<3>&, const std::vector<Rigid<3>>&, const std::vector<double>&);
template Certificate certifyConverged(const Problem<2>&, std::vector<Rigid<2>>&, const std::vector<double>&);
template Certificate certifyConverged(const Problem<3>&, std::vector<Rigid<3>>&, const std::vector<double>&);

}  // namespace pose_graph
