// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "manifold/rotation.hpp"
#include "support/plain_costs.hpp"

namespace pose_graph::test {

/// Returns poses that minimise a small problem, independent of the solver: plain residuals, numeric Jacobians, dense
/// Levenberg-Marquardt from `poses`. Fixed poses, or pose 0 without any, are held.
template <int D>
class DenseSolution {
  static constexpr int kN = kTangentSize<D>;

 public:
  DenseSolution(const Problem<D>& problem, Objective objective, std::vector<Rigid<D>> from, int steps = 200)
      : problem_(problem), objective_(objective), poses(std::move(from)) {
    for (int i = 0; i < static_cast<int>(poses.size()); ++i) {
      const bool is_fixed = std::binary_search(problem.fixed.begin(), problem.fixed.end(), i);
      if (is_fixed || (problem.fixed.empty() && i == 0)) continue;
      free_.push_back(static_cast<std::size_t>(i));
    }
    cost = costAt(poses);
    double damping = 1e-4;
    for (int i = 0; i < steps && damping < 1e12; ++i) damping = step(damping) ? 0.2 * damping : 8.0 * damping;
  }

 private:
  const Problem<D>& problem_;
  Objective objective_;
  std::vector<std::size_t> free_;

 public:
  std::vector<Rigid<D>> poses;
  double cost = 0.0;

  /// Returns the gradient of the cost with respect to the free poses, stacked.
  Eigen::VectorXd gradient() const {
    Eigen::MatrixXd H;
    Eigen::VectorXd g;
    linearise(H, g);
    return 2.0 * g;
  }

 private:
  double costAt(const std::vector<Rigid<D>>& at) const {
    double sum = 0.0;
    for (const Edge<D>& edge : problem_.edges) sum += residual(edge, at).cost();
    return sum;
  }
  PlainResidual residual(const Edge<D>& edge, const std::vector<Rigid<D>>& at) const {
    return plainResidual(objective_, edge, at[static_cast<std::size_t>(edge.from)],
                         at[static_cast<std::size_t>(edge.to)]);
  }

  void linearise(Eigen::MatrixXd& H, Eigen::VectorXd& g) const {
    const Eigen::Index n = kN * static_cast<Eigen::Index>(free_.size());
    H.setZero(n, n);
    g.setZero(n);
    std::vector<Rigid<D>> at = poses;
    for (const Edge<D>& edge : problem_.edges) {
      const PlainResidual here = residual(edge, poses);
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(here.r.size(), n);
      for (std::size_t u = 0; u < free_.size(); ++u) {
        const std::size_t pose = free_[u];
        if (static_cast<int>(pose) != edge.from && static_cast<int>(pose) != edge.to) continue;
        for (int k = 0; k < kN; ++k) {
          const auto moveBy = [&](double h) {
            at[pose] = moved<D>(poses[pose], Tangent<D>(h * Tangent<D>::Unit(k)));
            const Eigen::VectorXd r = residual(edge, at).r;
            at[pose] = poses[pose];
            return r;
          };
          constexpr double kStep = 1e-3;
          J.col(kN * static_cast<Eigen::Index>(u) + k) =
              (8.0 * (moveBy(0.5 * kStep) - moveBy(-0.5 * kStep)) - (moveBy(kStep) - moveBy(-kStep))) / (6.0 * kStep);
        }
      }
      H += J.transpose() * here.W * J;
      g += J.transpose() * (here.W * here.r);
    }
  }

  bool step(double damping) {
    Eigen::MatrixXd H;
    Eigen::VectorXd g;
    linearise(H, g);
    H.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd x = -H.ldlt().solve(g);
    std::vector<Rigid<D>> next = poses;
    for (std::size_t u = 0; u < free_.size(); ++u)
      next[free_[u]] = moved<D>(poses[free_[u]], Tangent<D>(x.segment<kN>(kN * static_cast<Eigen::Index>(u))));
    const double there = costAt(next);
    if (!(there < cost)) return false;
    poses = next;
    cost = there;
    return true;
  }
};

}  // namespace pose_graph::test
