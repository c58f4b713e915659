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

// Search of the shift: from a gap of this share of the cost, increased by a factor of ten, then bisected between the
// last two values on a logarithmic scale. A smaller gap is round-off.
constexpr double kLeastEigenvalueShare = 1e-9, kCertified = 1e-4;
constexpr int kHalvings = 4;
// Convergence: share of the cost that a further step may gain.
constexpr double kConverged = 1e-15;
// Round-off of a factorisation of some thousand poses, relative to the largest entry.
constexpr double kFactorRoundOff = 1e-13;
// Cost of residuals at round-off level, relative to the largest entry and the number of rotation entries.
constexpr double kNoCost = 1e-20;

/// Half the gradient of the cost with respect to a pose, (X M)_i, and the corresponding multiplier.
template <int D>
struct PoseGradient {
  Eigen::Matrix<double, D, 1> by_t = Eigen::Matrix<double, D, 1>::Zero();
  Rotation<D> by_R = Rotation<D>::Zero();
  Rotation<D> lambda = Rotation<D>::Zero();  ///< sym(R_i^T (X M)_i)
};

template <int D>
std::vector<PoseGradient<D>> gradients(const std::vector<EdgeTerm<D>>& terms, const std::vector<Rigid<D>>& poses) {
  std::vector<PoseGradient<D>> result(poses.size());
  for (const EdgeTerm<D>& term : terms) {
    const Rigid<D>& from = poses[sz(term.from)];
    const Rigid<D> to = term.measured(poses[sz(term.to)]);
    const Eigen::Matrix<double, D, 1> t = term.R_Z * term.t_Z;
    const Rotation<D> turn = from.R * term.R_Z - to.R;
    const Eigen::Matrix<double, D, 1> shift = to.t - from.t - from.R * t;
    PoseGradient<D>&at_from = result[sz(term.from)], &at_to = result[sz(term.to)];
    at_from.by_t -= term.tau * shift;
    at_from.by_R += term.kappa * turn * term.R_Z.transpose() - term.tau * shift * t.transpose();
    at_to.by_t += term.tau * shift;
    at_to.by_R -= term.kappa * turn;
    if (term.has_lever) at_to.by_R += term.tau * shift * term.lever.transpose();
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Rotation<D> seen = poses[i].R.transpose() * result[i].by_R;
    result[i].lambda = 0.5 * (seen + seen.transpose());
  }
  return result;
}

/// Returns by pose whether it is free and its component has a fixed pose.
template <int D>
std::vector<char> findAnchored(const Problem<D>& problem, const Unknowns& unknowns) {
  std::vector<char> result(problem.poses.size(), 0);
  if (problem.fixed.empty()) return result;
  const int part = unknowns.component[sz(problem.fixed.front())];
  for (const int i : unknowns.pose) result[sz(i)] = unknowns.component[sz(i)] == part;
  return result;
}

/// Returns how far the minimum of a component's quadratic form, given its fixed poses, is below its value at these
/// poses: tr(B S^-1 B^T), with B half the gradient there. `cholesky`: factor of S with `eta` added to its rotations.
template <int D>
double depthOfAnchored(const QuadraticForm<D>& form, const BlockCholesky<D + 1>& cholesky,
                       const std::vector<PoseGradient<D>>& gradient, const std::vector<Rigid<D>>& poses,
                       const std::vector<char>& anchored, double eta) {
  const std::size_t n = poses.size();
  std::vector<double> B(n * (D + 1) * D, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (!anchored[i]) continue;
    const Rotation<D> by_R = gradient[i].by_R - poses[i].R * gradient[i].lambda + eta * poses[i].R;
    for (std::size_t row = 0; row < D; ++row) {
      double* const at = B.data() + (row * n + sz(form.symbolic.place[i])) * (D + 1);
      at[0] = gradient[i].by_t[static_cast<Eigen::Index>(row)];
      for (int c = 0; c < D; ++c) at[c + 1] = by_R(static_cast<Eigen::Index>(row), c);
    }
  }
  std::vector<double> x = B;
  cholesky.solve(x.data(), D);
  double sum = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += B[k] * x[k];
  return sum;
}

}  // namespace

template <int D>
Certificate certify(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) {
  Certificate made;
  made.cost = cost(problem, poses, Objective::Chordal, weights);
  if (problem.edges.empty() || !std::isfinite(made.cost)) return made;
  QuadraticForm<D> form(problem, weights);
  const std::vector<PoseGradient<D>> gradient = gradients<D>(form.terms, poses);
  const std::vector<char> anchored = findAnchored(problem, form.unknowns);
  BlockMatrix<D + 1>& S = form.M;
  double dual = 0.0, largest = 0.0, free_cost = made.cost;
  std::size_t free = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool is_free = !anchored[i] && !form.isFixed(form.symbolic.place[i]);
    if (is_free) dual += gradient[i].lambda.trace();
    free += is_free;
    auto& block = S.diagonal[sz(form.symbolic.place[i])];
    block.template bottomRightCorner<D, D>() -= gradient[i].lambda;
    largest = std::max(largest, block.diagonal().cwiseAbs().maxCoeff());
  }
  if (!problem.fixed.empty()) {
    free_cost = 0.0;
    const int part = form.unknowns.component[sz(problem.fixed.front())];
    for (const EdgeTerm<D>& term : form.terms)
      if (form.unknowns.component[sz(term.from)] != part)
        free_cost += edgeCost<Objective::Chordal, D>(term, poses[sz(term.from)], poses[sz(term.to)]);
  }
  // A free component may be shifted at no cost: holding the translation of its first pose does not change definiteness.
  form.hold(S, largest);
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
    made.gap = std::max(free_cost - dual, 0.0) + eta * static_cast<double>(D) * static_cast<double>(free);
    if (free < poses.size() && isPositive(eta))
      *made.gap += depthOfAnchored(form, cholesky, gradient, poses, anchored, eta);
  }
  // If measurements fit to the last digit, the cost is zero up to round-off and has no meaningful share.
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
  Solution<D> converged = solve(Problem<D>{poses, problem.edges, problem.fixed}, options, weights);
  if (converged.cost <= cost(problem, poses, Objective::Chordal, weights)) poses = std::move(converged.poses);
  return certify(problem, poses, weights);
}

template Certificate certify(const Problem<2>&, const std::vector<Rigid<2>>&, const std::vector<double>&);
template Certificate certify(const Problem<3>&, const std::vector<Rigid<3>>&, const std::vector<double>&);
template Certificate certifyConverged(const Problem<2>&, std::vector<Rigid<2>>&, const std::vector<double>&);
template Certificate certifyConverged(const Problem<3>&, std::vector<Rigid<3>>&, const std::vector<double>&);

}  // namespace pose_graph
