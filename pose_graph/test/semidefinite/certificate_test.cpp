// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/certificate.hpp"

#include "pose_graph/solution.hpp"
#include "support/drawn.hpp"
#include "support/rings.hpp"

namespace pose_graph::test {
namespace {

SolveOptions chordal(Start start = Start::Auto) {
  SolveOptions options;
  options.objective = Objective::Chordal;
  options.start = start;
  options.tolerance = 1e-12;
  return options;
}

template <int D>
void expectCertifiedAtTheOptimum() {
  Dice dice(17);
  for (int draw = 0; draw < 5; ++draw) {
    const Problem<D> problem = drawProblem<D>(dice, 50, 30, 0.05, 0.05);
    const Solution<D> solution = solve(problem, chordal());
    const Certificate certificate = certify(problem, solution.poses);
    EXPECT_TRUE(certificate.certified);
    ASSERT_TRUE(certificate.gap);
    EXPECT_LT(*certificate.gap, 1e-4 * solution.cost);
    EXPECT_DOUBLE_EQ(certificate.cost, solution.cost);
    // The bound holds at any poses; poses away from a minimum are not certified.
    std::vector<Rigid<D>> off = solution.poses;
    for (Rigid<D>& pose : off) pose = moved<D>(pose, drawTangent<D>(dice, 0.02, 0.01));
    const Certificate away = certify(problem, off);
    EXPECT_FALSE(away.certified);
    if (away.gap) {
      EXPECT_GE(*away.gap, away.cost - solution.cost);
    }
  }
}

TEST(Certificate, IsGivenAtTheOptimum) {
  expectCertifiedAtTheOptimum<2>();
  expectCertifiedAtTheOptimum<3>();
}

/// The same bound for a graph that is bent between fixed poses, and for a free one in the same problem.
template <int D>
void expectCertifiedBetweenConstants() {
  Dice dice(19);
  for (int draw = 0; draw < 5; ++draw) {
    Problem<D> problem = drawProblem<D>(dice, 50, 30, 0.05, 0.05);
    const Problem<D> other = drawProblem<D>(dice, 20, 10, 0.05, 0.05);
    problem.fixed = {3, 20, 49};
    for (const int pose : problem.fixed)
      problem.poses[static_cast<std::size_t>(pose)] =
          moved<D>(problem.poses[static_cast<std::size_t>(pose)], drawTangent<D>(dice, 0.05, 0.02));
    problem.poses.insert(problem.poses.end(), other.poses.begin(), other.poses.end());
    for (Edge<D> edge : other.edges) {
      edge.from += 50;
      edge.to += 50;
      edge.lever = drawTangent<D>(dice, 0.3, 0.0).template head<D>();
      edge.Z.t += edge.Z.R * edge.lever;
      problem.edges.push_back(edge);
    }
    const Solution<D> solution = solve(problem, chordal());
    const Certificate certificate = certify(problem, solution.poses);
    EXPECT_TRUE(certificate.certified);
    ASSERT_TRUE(certificate.gap);
    EXPECT_LT(*certificate.gap, 1e-4 * solution.cost);
    std::vector<Rigid<D>> off = solution.poses;
    for (std::size_t i = 0; i < off.size(); ++i)
      if (i != 3 && i != 20 && i != 49) off[i] = moved<D>(off[i], drawTangent<D>(dice, 0.02, 0.01));
    const Certificate away = certify(problem, off);
    EXPECT_FALSE(away.certified);
    if (away.gap) {
      EXPECT_GE(*away.gap, away.cost - solution.cost);
    }
    std::vector<Rigid<D>> found = off;
    EXPECT_TRUE(certifyConverged(problem, found).certified);
    EXPECT_EQ(found[20].t, problem.poses[20].t);
  }
}

TEST(Certificate, IsGivenBetweenConstants) {
  expectCertifiedBetweenConstants<2>();
  expectCertifiedBetweenConstants<3>();
}

TEST(Certificate, IsGivenWhereEverythingFits) { EXPECT_TRUE(certify(ring(30, 1), ring(30, 1).poses).certified); }

TEST(Certificate, IsNotGivenToAKnot) {
  // One full turn more than measured: no small motion removes it, and its cost is far from the optimum of zero.
  const Problem<2> knotted = ring(30, 2);
  const Solution<2> solution = solve(knotted, chordal(Start::Vertices));
  ASSERT_EQ(solution.ending, Ending::Converged);
  ASSERT_GT(solution.cost, 0.1);
  const Certificate certificate = certify(knotted, solution.poses);
  EXPECT_FALSE(certificate.certified);
  if (certificate.gap) {
    EXPECT_GE(*certificate.gap, solution.cost);
  }
}

/// One edge that is far stiffer than the others hides their cost in round-off: the result is not certified.
TEST(Certificate, IsNotGivenWhereRoundOffHidesTheCost) {
  Dice dice(31);
  Problem<2> problem = drawProblem<2>(dice, 20, 10, 0.05, 0.05);
  problem.edges.push_back(problem.edges.front());
  problem.edges.back().information *= 1e10;
  const Solution<2> solution = solve(problem, chordal());
  const Certificate certificate = certify(problem, solution.poses);
  ASSERT_TRUE(certificate.gap);
  EXPECT_GT(*certificate.gap, 1e-4 * certificate.cost);
  EXPECT_FALSE(certificate.certified);
}

/// A minimisation that ends early has a wide bound; the converged poses have a narrow one.
TEST(Certificate, IsNarrowWherePosesHaveConverged) {
  Dice dice(29);
  const Problem<3> problem = drawProblem<3>(dice, 50, 30, 0.1, 0.1);
  SolveOptions early = chordal();
  early.tolerance = 1e-3;
  std::vector<Rigid<3>> poses = solve(problem, early).poses;
  const Certificate wide = certify(problem, poses);
  const Certificate narrow = certifyConverged(problem, poses);
  ASSERT_TRUE(wide.gap && narrow.gap);
  EXPECT_TRUE(narrow.certified);
  EXPECT_LT(*narrow.gap, 1e-6 * narrow.cost);
  EXPECT_LT(*narrow.gap, 0.1 * *wide.gap);
  EXPECT_LE(narrow.cost, wide.cost);
  EXPECT_GE(narrow.cost, wide.cost - *wide.gap) << "the wide bound holds too";
  EXPECT_DOUBLE_EQ(narrow.cost, cost(problem, poses, Objective::Chordal)) << "poses are those of the certificate";
}

TEST(Certificate, IgnoresEdgesWithoutWeightAndSeparatesComponents) {
  Dice dice(23);
  Problem<3> problem = drawProblem<3>(dice, 20, 10, 0.05, 0.05);
  const std::size_t edges = problem.edges.size();
  for (std::size_t e = 0; e < edges; ++e) {
    problem.edges.push_back(problem.edges[e]);
    problem.edges.back().from += 20;
    problem.edges.back().to += 20;
  }
  for (int i = 0; i < 20; ++i) problem.poses.push_back(problem.poses[static_cast<std::size_t>(i)]);
  std::vector<double> weights(problem.edges.size(), 1.0);
  problem.edges.push_back({0, 5, drawRigid<3>(dice, 10.0, 3.0), 1e6 * TangentMatrix<3>::Identity()});
  weights.push_back(0.0);
  const Solution<3> solution = solve(problem, chordal(), weights);
  EXPECT_TRUE(certify(problem, solution.poses, weights).certified);
  EXPECT_FALSE(certify(problem, solution.poses).certified);
}

}  // namespace
}  // namespace pose_graph::test
