// SPDX-License-Identifier: BSD-3-Clause
#include "robust/generators/slips.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/drawn.hpp"

namespace pose_graph {
namespace {

using test::Dice;

// A chain of 40 poses with closures over ten steps each; all are exact except for one step.
struct SlippedChain {
  Problem<2> problem;
  std::vector<EdgeRole> roles;
  std::vector<char> all, none;
  std::vector<Rigid<2>> odometry, truth;

  explicit SlippedChain(double metres) {
    Dice dice(3);
    truth.emplace_back();
    for (int i = 1; i < 40; ++i)
      truth.push_back(truth.back() *
                      moved(Rigid<2>(), Tangent<2>(1.0 + 0.3 * dice.normal(), 0.0, 0.3 * dice.normal())));
    const auto measure = [&](std::size_t from, std::size_t to) {
      problem.edges.push_back({static_cast<int>(from), static_cast<int>(to), truth[from].inverse() * truth[to],
                               TangentMatrix<2>::Identity() * 1e2});
    };
    for (std::size_t i = 1; i < truth.size(); ++i) measure(i - 1, i);
    for (std::size_t i = 0; i + 10 < truth.size(); ++i) measure(i, i + 10);
    problem.edges[20].Z.t[0] += metres;
    odometry.emplace_back();
    for (std::size_t i = 1; i < truth.size(); ++i) odometry.push_back(odometry.back() * problem.edges[i - 1].Z);
    problem.poses = odometry;
    roles = rolesByNumbers(problem);
    all.assign(roles.size(), 1);
    for (const EdgeRole role : roles) none.push_back(role != EdgeRole::Candidate);
  }
};

TEST(Slips, AStepThatAllClosuresContradictIsFound) {
  const SlippedChain chain(2.0);
  const auto slips = findSlips(chain.problem, chain.roles, chain.all, {}, chain.odometry);
  ASSERT_EQ(slips.size(), 1u);
  EXPECT_EQ(slips[0].edge, 20);
  EXPECT_LT((slips[0].T_from_to.t - (chain.truth[20].inverse() * chain.truth[21]).t).norm(), 0.05);
  EXPECT_TRUE(findSlips(chain.problem, chain.roles, chain.none, {}, chain.odometry).empty());
}

TEST(Slips, OverconfidentOdometryHidesASlipUntilItIsWeightedDown) {
  SlippedChain chain(1.0);
  for (std::size_t e = 0; e < chain.roles.size(); ++e)
    if (chain.roles[e] == EdgeRole::Trusted) chain.problem.edges[e].information *= 1e3;
  std::vector<char> in = chain.all;
  for (std::size_t e = 0; e < in.size(); ++e)
    in[e] = chain.roles[e] == EdgeRole::Trusted || chain.problem.edges[e].from > 20 || chain.problem.edges[e].to <= 20;
  const std::vector<char> weighted_down = mostContradicted(chain.problem, chain.roles, in, chain.all);
  ASSERT_EQ(std::count(weighted_down.begin(), weighted_down.end(), 1), 1);
  EXPECT_TRUE(weighted_down[20]);
  EXPECT_TRUE(mostContradicted(chain.problem, chain.roles, chain.all, chain.all).empty());
  EXPECT_TRUE(findSlips(chain.problem, chain.roles, chain.all, {}, chain.odometry).empty());
  const auto slips = findSlips(chain.problem, chain.roles, chain.all, weighted_down, chain.odometry);
  ASSERT_EQ(slips.size(), 1u);
  EXPECT_EQ(slips[0].edge, 20);
  EXPECT_LT((slips[0].T_from_to.t - (chain.truth[20].inverse() * chain.truth[21]).t).norm(), 0.05);
}

TEST(Slips, AStepMayHaveSlippedWhereClosuresAreOutsideOrItIsFarOff) {
  const SlippedChain slipped(2.0), right(0.0);
  const auto may = [](const SlippedChain& chain, const std::vector<char>& in, const std::vector<char>& considered,
                      const std::vector<Rigid<2>>& poses) {
    std::vector<int> row;  // each closure is its own row
    for (std::size_t e = 0; e < chain.roles.size(); ++e) row.push_back(static_cast<int>(e));
    return maySlip(chain.problem, chain.roles, in, considered, row, poses);
  };
  EXPECT_TRUE(may(slipped, slipped.none, slipped.all, slipped.odometry));    // all closures that span it are outside
  EXPECT_FALSE(may(slipped, slipped.none, slipped.none, slipped.odometry));  // none is considered
  EXPECT_TRUE(may(slipped, slipped.all, slipped.all, slipped.truth));
  EXPECT_FALSE(may(right, right.all, right.all, right.truth));
}

TEST(Slips, ClosuresThatDisagreeOnAStepShowNoSlip) {
  SlippedChain chain(0.0);
  std::vector<char> in = chain.all;
  std::vector<int> row(in.size(), -1);
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (chain.roles[e] != EdgeRole::Candidate) continue;
    row[e] = static_cast<int>(e);
    in[e] = chain.problem.edges[e].from > 20 || chain.problem.edges[e].to <= 20;
    if (!in[e]) chain.problem.edges[e].Z.t[1] += 5.0 * (chain.problem.edges[e].from - 10);
  }
  EXPECT_FALSE(maySlip(chain.problem, chain.roles, in, chain.all, row, chain.truth));
}

// The closures that span the step form one row each, one row in total, two rows, or are absent.
TEST(Slips, OneRowOfClosuresContradictsNoStep) {
  const SlippedChain chain(2.0);
  std::vector<char> in = chain.all, none_spans = chain.all;
  std::vector<int> one_row(in.size(), -1), two_rows = one_row;
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (chain.roles[e] != EdgeRole::Candidate) continue;
    one_row[e] = 39;
    two_rows[e] = chain.problem.edges[e].from < 15 ? 39 : 54;
    if (chain.problem.edges[e].from <= 20 && chain.problem.edges[e].to > 20) none_spans[e] = 0;
  }
  in[20] = none_spans[20] = 0;
  const std::vector<Slip<2>> slips = {{20, chain.truth[20].inverse() * chain.truth[21]}};
  EXPECT_FALSE(joinEndsWithoutAnyRow(chain.problem, chain.roles, in, one_row, slips));
  EXPECT_TRUE(joinEndsWithoutAnyRow(chain.problem, chain.roles, in, two_rows, slips));
  EXPECT_FALSE(joinEndsWithoutAnyRow(chain.problem, chain.roles, none_spans, two_rows, slips));
  EXPECT_TRUE(joinEndsWithoutAnyRow(chain.problem, chain.roles, none_spans, one_row, {}));
}

}  // namespace
}  // namespace pose_graph
