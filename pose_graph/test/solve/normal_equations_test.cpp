// SPDX-License-Identifier: BSD-3-Clause
#include "solve/normal_equations.hpp"

#include "linear/index.hpp"
#include "support/drawn.hpp"
#include "support/plain_costs.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace pose_graph::test {
namespace {

TEST(Unknowns, FirstPosesOfComponentsAreHeld) {
  Problem<2> problem;
  problem.poses.resize(7);
  problem.edges.push_back({5, 2, {}, {}});
  problem.edges.push_back({3, 1, {}, {}});
  problem.edges.push_back({4, 5, {}, {}});
  const Unknowns made = makeUnknowns(problem);
  EXPECT_EQ(made.components, 4);
  EXPECT_EQ(made.component, (std::vector<int>{0, 1, 2, 1, 2, 2, 3}));
  EXPECT_EQ(made.pose, (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(made.of_pose, (std::vector<int>{-1, -1, -1, 0, 1, 2, -1}));
}

TEST(Unknowns, FixedPosesAreNoUnknownsAndInOneComponent) {
  Problem<2> problem;
  problem.poses.resize(7);
  problem.edges.push_back({5, 2, {}, {}});
  problem.edges.push_back({3, 1, {}, {}});
  problem.edges.push_back({4, 5, {}, {}});
  problem.fixed = {3, 4, 6};
  const Unknowns made = makeUnknowns(problem);
  EXPECT_EQ(made.components, 2);
  EXPECT_EQ(made.component, (std::vector<int>{0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(made.origin, (std::vector<int>{0, 3}));
  EXPECT_EQ(made.pose, (std::vector<int>{1, 2, 5}));
  EXPECT_EQ(made.of_pose, (std::vector<int>{-1, 0, 1, -1, -1, 2, -1}));
}

TEST(Unknowns, NoPosesAndNoEdges) {
  EXPECT_EQ(makeUnknowns(Problem<3>()).components, 0);
  Problem<3> lone;
  lone.poses.resize(2);
  EXPECT_EQ(makeUnknowns(lone).components, 2);
}

/// Computes H and g as J^T W J and J^T W r of plain residuals, with J by central differences, in the order of places.
template <int D>
struct DenseSystem {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double cost = 0.0;

  DenseSystem(const NormalEquations<D>& equations, const Problem<D>& problem, Objective objective,
              const std::vector<double>& weights) {
    constexpr int kN = kTangentSize<D>;
    const Eigen::Index n = static_cast<Eigen::Index>(equations.unknowns().pose.size()) * kN;
    H = Eigen::MatrixXd::Zero(n, n);
    g = Eigen::VectorXd::Zero(n);
    for (std::size_t e = 0; e < problem.edges.size(); ++e) {
      const Edge<D>& edge = problem.edges[e];
      const PlainResidual at = plainResidual(objective, edge, problem.poses[sz(edge.from)], problem.poses[sz(edge.to)]);
      const double weight = weights.empty() ? 1.0 : weights[e];
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(at.r.size(), n);
      for (const int pose : {edge.from, edge.to}) {
        const int unknown = equations.unknowns().of_pose[sz(pose)];
        if (unknown < 0) continue;
        const Eigen::Index column = kN * equations.symbolic().place[sz(unknown)];
        for (int k = 0; k < kN; ++k) {
          const auto residual = [&](double h) {
            Rigid<D> from = problem.poses[sz(edge.from)], to = problem.poses[sz(edge.to)];
            Rigid<D>& other = pose == edge.from ? from : to;
            other = moved(other, Tangent<D>(h * Tangent<D>::Unit(k)));
            return plainResidual(objective, edge, from, to).r;
          };
          const double h = 1e-3;
          J.col(column + k) =
              (8.0 * (residual(0.5 * h) - residual(-0.5 * h)) - (residual(h) - residual(-h))) / (6.0 * h);
        }
      }
      H += weight * J.transpose() * at.W * J;
      g += weight * J.transpose() * (at.W * at.r);
      cost += weight * at.cost();
    }
  }
};

template <int D>
void expectDense(Objective objective, bool weighted, bool constrained) {
  constexpr int kN = kTangentSize<D>;
  Dice dice(7);
  Problem<D> problem = drawProblem<D>(dice, 9, 8, 0.5, 0.7);
  if (constrained) {
    problem.fixed = {2, 3, 7};
    for (Edge<D>& edge : problem.edges) edge.lever = drawTangent<D>(dice, 1.5, 0.0).template head<D>();
  }
  std::vector<double> weights;
  for (std::size_t e = 0; weighted && e < problem.edges.size(); ++e)
    weights.push_back(e % 3 == 0 ? 0.0 : dice.uniform());
  NormalEquations<D> equations(problem);
  const double cost = equations.linearise(objective, problem.poses, weights);
  const DenseSystem<D> dense(equations, problem, objective, weights);
  EXPECT_NEAR(cost, dense.cost, 1e-10 * dense.cost);
  EXPECT_NEAR(equations.cost(objective, problem.poses, weights), dense.cost, 1e-10 * dense.cost);
  const Eigen::Map<const Eigen::VectorXd> g(equations.g().data(), dense.g.size());
  EXPECT_LT((g - dense.g).norm(), 1e-7 * dense.g.norm());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(dense.H.rows(), dense.H.cols());
  const BlockPattern& pattern = equations.pattern();
  for (std::size_t k = 0; k + 1 < pattern.first.size(); ++k) {
    const Eigen::Index column = kN * static_cast<Eigen::Index>(k);
    H.block<kN, kN>(column, column) = equations.H().diagonal[k];
    for (int e = pattern.first[k]; e < pattern.first[k + 1]; ++e) {
      const Eigen::Index row = kN * pattern.row[sz(e)];
      H.block<kN, kN>(row, column) = equations.H().lower[sz(e)];
      H.block<kN, kN>(column, row) = equations.H().lower[sz(e)].transpose();
    }
  }
  EXPECT_LT((H - dense.H).norm(), 1e-7 * dense.H.norm());
}
TEST(NormalEquations, EqualDenseOnesByNumericJacobians) {
  for (const Objective objective : kObjectives) {
    for (const bool weighted : {false, true}) {
      for (const bool constrained : {false, true}) {
        expectDense<2>(objective, weighted, constrained);
        expectDense<3>(objective, weighted, constrained);
      }
    }
  }
}

TEST(NormalEquations, SameBytesWithOneThreadAndTwo) {
  Dice dice(8);
  const Problem<3> problem = drawProblem<3>(dice, 700, 500, 0.3, 0.2);
  const auto run = [&](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    NormalEquations<3> equations(problem);
    return std::pair(equations.linearise(Objective::Geodesic, problem.poses, {}),
                     equations.cost(Objective::Geodesic, problem.poses, {}));
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace pose_graph::test
