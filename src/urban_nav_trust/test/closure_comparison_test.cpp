// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/closure_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace urban_nav_trust {
namespace {

/// Consecutive closures of one place. The error of odometry, `scale` times what it states, is common to all.
std::vector<ClosureDifference> row(unsigned seed, double scale, bool by_laser = true) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Eigen::VectorXd sigma(6), shared(6);
  sigma << 0.1, 0.1, 0.05, 0.003, 0.003, 0.006;
  for (Eigen::Index i = 0; i < 6; ++i) shared[i] = scale * sigma[i] * normal(random);
  std::vector<ClosureDifference> closures(12);
  for (std::size_t k = 0; k < closures.size(); ++k) {
    ClosureDifference& closure = closures[k];
    closure.interval = {static_cast<urban_nav_core::StampNs>(k), 30'000'000'000};
    closure.by_laser = by_laser;
    closure.odometry = sigma.cwiseAbs2().asDiagonal();
    closure.closure = 0.01 * closure.odometry;
    closure.difference = shared;
    for (Eigen::Index i = 0; i < 6; ++i) closure.difference[i] += 0.1 * sigma[i] * normal(random);
    closure.distance_m = closure.difference.head<3>().norm();
  }
  return closures;
}

TestResults test(const std::vector<ClosureDifference>& closures) {
  TestResults results;
  testClosures(closures, results);
  return results;
}

TEST(ClosureComparison, IsSilentWhereCovariancesAreRightOrSmallByAFewTimes) {
  for (const double scale : {1.0, 3.0, 6.0})
    for (unsigned seed = 1; seed <= 100; ++seed) {
      const TestResults results = test(row(seed, scale));
      ASSERT_EQ(results.tests.size(), 1U);
      EXPECT_GT(results.tests[0].p_value, 1e-5) << scale << " " << seed;
    }
}

TEST(ClosureComparison, OdometryThatIsBeyondAnyFactorFails) {
  std::vector<ClosureDifference> closures = row(1, 1.0);
  for (ClosureDifference& closure : closures) closure.difference[0] += 12.0;  // m
  const TestResults results = test(closures);
  ASSERT_EQ(results.tests.size(), 1U);
  EXPECT_EQ(results.tests[0].name, kLaserClosureTest);
  EXPECT_LT(results.tests[0].p_value, 1e-5);
  EXPECT_FALSE(results.tests[0].remedy.empty());
  EXPECT_EQ(results.absent.size(), 1U);  // none by stereo
}

// Twelve closures of the same place have the evidence of one.
TEST(ClosureComparison, ARowOfClosuresIsEvidenceOnce) {
  std::vector<ClosureDifference> closures = row(2, 1.0);
  const TestResults all = test(closures);
  std::sort(closures.begin(), closures.end(), [](const ClosureDifference& a, const ClosureDifference& b) {
    const auto distance = [](const ClosureDifference& each) {
      return each.difference.dot((each.odometry + each.closure).ldlt().solve(each.difference));
    };
    return distance(a) < distance(b);
  });
  const TestResults one = test({closures[closures.size() / 2]});
  EXPECT_EQ(all.turns.probabilities(), one.turns.probabilities());
  EXPECT_GT(all.turns.probabilities()[0], 0.5);
}

TEST(ClosureComparison, StereoMeasuresLengthsWithTheSameCameras) {
  const TestResults stereo = test(row(3, 1.0, false)), laser = test(row(3, 1.0, true));
  EXPECT_FALSE(stereo.turns.isEmpty());
  EXPECT_TRUE(stereo.lengths.isEmpty());
  EXPECT_FALSE(laser.lengths.isEmpty());
  EXPECT_FALSE(confirm(stereo).lengths);
  EXPECT_TRUE(confirm(laser).isComplete());
}

TEST(ClosureComparison, NoClosureOrNoNumbersIsAbsent) {
  ClosureDifference broken = row(1, 1.0)[0];
  broken.difference[2] = std::nan("");
  for (const TestResults& results : {test({}), test({broken})}) {
    EXPECT_TRUE(results.tests.empty());
    EXPECT_EQ(results.absent.size(), 2U);
  }
}

/// Constraints from planes of as many places as there are `seeds`, each with errors as stated.
std::vector<ClosureDifference> planes(unsigned seed, int places, double scale = 1.0) {
  std::vector<ClosureDifference> all;
  for (int i = 0; i < places; ++i) all.push_back(row(100 * seed + static_cast<unsigned>(i), scale)[0]);
  return all;
}

ConsistencyTest testPassesIn(const std::vector<ClosureDifference>& differences) {
  TestResults results;
  testPlanes(differences, "no lasers", results);
  EXPECT_EQ(results.tests.size(), 1U);
  EXPECT_TRUE(confirm(results).scales == ScaleEvidence().probabilities()) << "planes are no evidence on odometry";
  return results.tests.empty() ? ConsistencyTest() : results.tests[0];
}

TEST(PlanePasses, PValuesOfSoundPassesAreAtLeastUniform) {
  for (const int places : {1, 2, 8})
    for (const double scale : {1.0, 5.0}) {
      int below = 0;
      for (unsigned seed = 1; seed <= 200; ++seed) {
        const double p = testPassesIn(planes(seed, places, scale)).p_value;
        below += p < 0.1 ? 1 : 0;
        EXPECT_GT(p, 1e-5) << places << ", " << scale << ", " << seed;
      }
      EXPECT_LE(below, 31) << places << ", " << scale;  // 99 % of a binomial variable with 200 and 0.1
    }
}

TEST(PlanePasses, ALaserThatMovedBetweenThePassesFails) {
  std::vector<ClosureDifference> moved = planes(1, 8);
  for (ClosureDifference& each : moved) each.difference[5] += 1.0;  // rad
  const ConsistencyTest test = testPassesIn(moved);
  EXPECT_EQ(test.name, kPassTest);
  EXPECT_LT(test.p_value, 1e-5);
  EXPECT_NE(test.sentence.find("8 constraints"), std::string::npos) << test.sentence;
  EXPECT_FALSE(test.remedy.empty());
}

TEST(PlanePasses, AThirdOfThePlanesMayBeConfused) {
  std::vector<ClosureDifference> some = planes(2, 9);
  for (std::size_t i = 0; i < 3; ++i) some[i].difference[0] += 100.0;  // m
  EXPECT_GT(testPassesIn(some).p_value, 0.01);
}

TEST(PlanePasses, WithoutPlanesItIsAbsentWithTheReason) {
  TestResults results;
  testPlanes({}, "no lasers", results);
  EXPECT_TRUE(results.tests.empty());
  ASSERT_EQ(results.absent.size(), 1U);
  EXPECT_EQ(results.absent[0].reason, "no lasers");
}

}  // namespace
}  // namespace urban_nav_trust
