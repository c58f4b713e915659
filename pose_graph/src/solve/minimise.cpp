// SPDX-License-Identifier: BSD-3-Clause
#include "solve/minimise.hpp"

#include <algorithm>
#include <cmath>

#include "linear/index.hpp"

namespace pose_graph {

namespace {

constexpr double kFirstDamping = 1e-10, kLeastDamping = 1e-16, kLargestDamping = 1e8;
// Share of the largest diagonal entry below which an entry is round-off and the direction has no information.
constexpr double kZeroDiagonal = 1e-12;
// Round-off of a residual relative to the lengths that it is the difference of, or to one radian.
constexpr double kLeast = 1e-14;

// Scale of the damping: the diagonal, or its largest entry for directions without information, which are thereby held.
template <int D>
std::vector<Tangent<D>> dampingScale(const std::vector<TangentMatrix<D>>& diagonal) {
  double largest = 0.0;
  for (const TangentMatrix<D>& block : diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  std::vector<Tangent<D>> made;
  made.reserve(diagonal.size());
  for (const TangentMatrix<D>& block : diagonal)
    made.push_back((block.diagonal().array() > kZeroDiagonal * largest).select(block.diagonal(), largest));
  return made;
}

template <int D>
void addDamping(BlockMatrix<kTangentSize<D>>& H, const std::vector<TangentMatrix<D>>& undamped,
                const std::vector<Tangent<D>>& scale, double damping) {
  for (std::size_t k = 0; k < undamped.size(); ++k) {
    H.diagonal[k] = undamped[k];
    H.diagonal[k].diagonal() += damping * scale[k];
  }
}

// Returns the cost of residuals at round-off level; a lower cost is not meaningful.
template <int D>
double roundOff(const NormalEquations<D>& equations, const std::vector<Rigid<D>>& poses,
                const std::vector<double>& weights) {
  double sum = 0.0;
  for (std::size_t e = 0; e < equations.terms().size(); ++e) {
    const EdgeTerm<D>& term = equations.terms()[e];
    const double metres =
        poses[sz(term.from)].t.norm() + poses[sz(term.to)].t.norm() + term.t_Z.norm() + term.lever.norm();
    Tangent<D> least = Tangent<D>::Constant(kLeast);
    least.template head<D>() *= metres;
    sum += (weights.empty() ? 1.0 : weights[e]) * least.cwiseAbs2().dot(term.information.diagonal());
  }
  return sum;
}

template <int D>
std::vector<Rigid<D>> stepped(const NormalEquations<D>& equations, const std::vector<double>& x,
                              const std::vector<Rigid<D>>& poses) {
  constexpr int kN = kTangentSize<D>;
  std::vector<Rigid<D>> made = poses;
  const Unknowns& unknowns = equations.unknowns();
  for (std::size_t u = 0; u < unknowns.pose.size(); ++u) {
    const std::size_t place = sz(equations.symbolic().place[u]), pose = sz(unknowns.pose[u]);
    made[pose] = moved<D>(poses[pose], Eigen::Map<const Tangent<D>>(x.data() + place * kN));
  }
  return made;
}

double dotProduct(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Predicts the further decrease of the cost from the ratio of successive decreases.
class Forecast {
 public:
  double remaining(double gained) {
    const double rate = last_ > 0.0 ? std::min(gained / last_, 0.999) : 0.1;
    last_ = gained;
    return gained * rate / (1.0 - rate);
  }

 private:
  double last_ = 0.0;
};

}  // namespace

template <int D>
Descent minimise(NormalEquations<D>& equations, BlockCholesky<kTangentSize<D>>& cholesky, const SolveOptions& options,
                 const std::vector<double>& weights, std::vector<Rigid<D>>& poses) {
  constexpr std::size_t kN = kTangentSize<D>;
  Descent made;
  made.ending = Ending::Iterations;
  double damping = 0.0;
  double least_damping = 0.0;  // least damping with which the factorisation succeeded
  Forecast forecast;
  std::vector<double> x;
  std::vector<TangentMatrix<D>> undamped;
  made.cost = equations.linearise(options.objective, poses, weights);
  if (equations.unknowns().pose.empty() || made.cost <= 0.0) {
    made.ending = Ending::Converged;
    return made;
  }
  while (static_cast<int>(made.iterations.size()) < options.iterations) {
    undamped = equations.H().diagonal;
    const std::vector<Tangent<D>> scale = dampingScale<D>(undamped);
    Iteration step;
    std::vector<Rigid<D>> next;
    bool was_plain = damping <= least_damping;
    for (;; ++step.refused) {
      if (damping > kLargestDamping) {
        made.ending = Ending::Stuck;
        return made;
      }
      if (damping > 0.0 || step.refused > 0) addDamping<D>(equations.H(), undamped, scale, damping);
      const double more_damping = damping > 0.0 ? 10.0 * damping : kFirstDamping;
      if (cholesky.factor(equations.H(), equations.pattern())) {
        x = equations.g();
        for (double& value : x) value = -value;
        cholesky.solve(x.data());
        step.predicted = -dotProduct(equations.g(), x);
        for (std::size_t k = 0; k < undamped.size() && damping > 0.0; ++k) {
          const Eigen::Map<const Tangent<D>> part(x.data() + k * kN);
          step.predicted += damping * part.dot(scale[k].cwiseProduct(part));
        }
        next = stepped(equations, x, poses);
        step.cost = equations.cost(options.objective, next, weights);
        if (std::isfinite(step.cost) && step.cost <= made.cost) break;
        // At the minimum round-off dominates, and a predicted decrease of about zero indicates convergence. Only the
        // undamped step is conclusive, since a strongly damped one predicts little decrease anywhere.
        const bool is_nothing = step.predicted <= options.tolerance * made.cost;
        if ((is_nothing && damping <= least_damping) || made.cost <= roundOff(equations, poses, weights)) {
          made.ending = Ending::Converged;
          return made;
        }
        if (is_nothing && was_plain) {
          made.ending = Ending::Stuck;
          return made;
        }
        if (is_nothing) {
          was_plain = true;
          damping = least_damping;
          continue;
        }
      } else {
        least_damping = std::max(least_damping, more_damping);
      }
      damping = more_damping;
    }
    step.damping = damping;
    poses.swap(next);
    const double gained = made.cost - step.cost, ratio = gained / step.predicted;
    made.cost = step.cost;
    made.iterations.push_back(step);
    const double still = forecast.remaining(std::max(gained, step.predicted));
    const bool is_settled = still <= options.tolerance * made.cost;
    if ((is_settled && damping <= least_damping) || made.cost <= 0.0) {
      made.ending = Ending::Converged;
      return made;
    }
    if (options.progress && !options.progress(static_cast<int>(made.iterations.size()), made.cost)) {
      made.ending = Ending::Stopped;
      return made;
    }
    if (is_settled) damping = least_damping;
    else if (ratio > 0.75 && step.refused == 0) damping = damping > kLeastDamping ? damping / 10.0 : 0.0;
    else if (ratio < 0.25) damping = std::max(4.0 * damping, kFirstDamping);
    if (static_cast<int>(made.iterations.size()) < options.iterations)
      equations.linearise(options.objective, poses, weights);
  }
  return made;
}

template Descent minimise<2>(NormalEquations<2>&, BlockCholesky<3>&, const SolveOptions&, const std::vector<double>&,
                             std::vector<Rigid<2>>&);
template Descent minimise<3>(NormalEquations<3>&, BlockCholesky<6>&, const SolveOptions&, const std::vector<double>&,
                             std::vector<Rigid<3>>&);

}  // namespace pose_graph
