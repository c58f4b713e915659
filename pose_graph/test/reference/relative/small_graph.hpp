// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "manifold/rotation.hpp"
#include "relative/linear_system.hpp"

namespace pose_graph::test {

/// Draws transforms, tangents and information; the same seed gives the same ones.
template <int D>
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  double normal() { return normal_(random_); }
  Tangent<D> tangent(double metres, double radians) {
    Tangent<D> d;
    for (int i = 0; i < kTangentSize<D>; ++i) d[i] = (i < D ? metres : radians) * normal();
    return d;
  }
  Rigid<D> rigid(double metres, double radians) { return moved(Rigid<D>(), tangent(metres, radians)); }
  /// Draws information of full rank, or of rank `rank`.
  TangentMatrix<D> information(int rank = kTangentSize<D>) {
    TangentMatrix<D> sum = TangentMatrix<D>::Zero();
    for (int i = 0; i < rank; ++i) {
      const Tangent<D> d = tangent(1.0, 2.0);
      sum += d * d.transpose();
    }
    if (rank == kTangentSize<D>) sum += TangentMatrix<D>::Identity();
    return sum;
  }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

/// A winding chain of 1 m steps with closures in both directions, some of low rank, a link measured twice and one
/// measured backwards. All measurements are disturbed by `metres` and `radians` times a normal number. The poses are
/// the measured chain.
template <int D>
Problem<D> smallGraph(int poses, int closures, double metres, double radians, unsigned seed = 1) {
  Draw<D> draw(seed);
  std::vector<Rigid<D>> truth(1);
  for (int i = 1; i < poses; ++i) {
    Tangent<D> step = draw.tangent(0.1, 0.3);
    step[0] += 1.0;
    truth.push_back(truth.back() * moved(Rigid<D>(), step));
  }
  Problem<D> problem;
  const auto add = [&](int from, int to, int rank) {
    const Rigid<D> exact = truth[static_cast<std::size_t>(from)].inverse() * truth[static_cast<std::size_t>(to)];
    problem.edges.push_back({from, to, moved(exact, draw.tangent(metres, radians)), draw.information(rank)});
  };
  for (int i = 1; i < poses; ++i) i % 4 == 3 ? add(i, i - 1, kTangentSize<D>) : add(i - 1, i, kTangentSize<D>);
  if (poses > 3) add(1, 2, 1);
  for (int i = 0; i < closures;) {
    const int from = draw.below(poses), to = draw.below(poses);
    if (std::abs(from - to) < 2) continue;
    add(from, to, i % 3 == 1 ? D : kTangentSize<D>);
    ++i;
  }
  problem.poses.resize(1);
  for (int i = 1; i < poses; ++i) {
    const Edge<D>& edge = problem.edges[static_cast<std::size_t>(i - 1)];
    problem.poses.push_back(problem.poses.back() * (edge.from < edge.to ? edge.Z : edge.Z.inverse()));
  }
  return problem;
}

/// Converts increments to one vector, and back.
template <int D>
Eigen::VectorXd stacked(const Increments<D>& step) {
  return Eigen::Map<const Eigen::VectorXd>(step.data(), step.size());
}
template <int D>
Increments<D> unstacked(const Eigen::VectorXd& step) {
  return Eigen::Map<const Increments<D>>(step.data(), kTangentSize<D>, step.size() / kTangentSize<D>);
}

/// Draws the increments of a chain.
template <int D>
Increments<D> drawIncrements(Draw<D>& draw, int links, double size = 1.0) {
  Increments<D> step(kTangentSize<D>, links);
  for (int i = 0; i < links; ++i) step.col(i) = draw.tangent(size, size);
  return step;
}

/// Returns all residuals of a state, stacked in the order of the edges.
template <int D>
Eigen::VectorXd computeResiduals(const Problem<D>& problem, const ChainState<D>& state) {
  constexpr Eigen::Index kD = kTangentSize<D>;
  Eigen::VectorXd residuals(kD * static_cast<Eigen::Index>(problem.edges.size()));
  for (std::size_t i = 0; i < problem.edges.size(); ++i) {
    const Edge<D>& edge = problem.edges[i];
    residuals.segment<kD>(kD * static_cast<Eigen::Index>(i)) = edgeResidual(
        edge, state.poses[static_cast<std::size_t>(edge.from)], state.poses[static_cast<std::size_t>(edge.to)]);
  }
  return residuals;
}

/// Returns [H; I] of (19) as a dense matrix, by Richardson extrapolation of central differences of the residuals.
template <int D>
Eigen::MatrixXd numericRows(const Problem<D>& problem, const ChainState<D>& state) {
  const Eigen::Index columns = kTangentSize<D> * static_cast<Eigen::Index>(state.links.size());
  Eigen::MatrixXd J(kTangentSize<D> * static_cast<Eigen::Index>(problem.edges.size()), columns);
  for (Eigen::Index column = 0; column < columns; ++column) {
    const auto central = [&](double h) {
      const Eigen::VectorXd d = h * Eigen::VectorXd::Unit(columns, column);
      return Eigen::VectorXd((computeResiduals(problem, moved(state, unstacked<D>(d))) -
                              computeResiduals(problem, moved(state, unstacked<D>(Eigen::VectorXd(-d))))) /
                             (2.0 * h));
    };
    J.col(column) = (4.0 * central(5e-4) - central(1e-3)) / 3.0;
  }
  return J;
}

/// Returns the weights of all residuals as a block-diagonal matrix.
template <int D>
Eigen::MatrixXd computeWeights(const Problem<D>& problem) {
  constexpr Eigen::Index kD = kTangentSize<D>;
  const auto count = static_cast<Eigen::Index>(problem.edges.size());
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(kD * count, kD * count);
  for (Eigen::Index i = 0; i < count; ++i)
    W.block<kD, kD>(kD * i, kD * i) = problem.edges[static_cast<std::size_t>(i)].information;
  return W;
}

}  // namespace pose_graph::test
