// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/belief_history.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace fabmap_node {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kHistorySecond = 1'000'000'000, kYesterday = 86'400 * kHistorySecond;

constexpr std::array<PlaceVerdict, 4> kAllVerdicts = {PlaceVerdict::Accepted, PlaceVerdict::Rejected,
                                                      PlaceVerdict::Confirmed, PlaceVerdict::Withdrawn};

double toOdds(double probability) { return probability / (1.0 - probability); }

/// Belief at metre `at` of today's path, one metre a second, that the place `place` m along a session is likely.
PlaceBelief beliefAt(int at, double probability, int place, const std::string& session = "yesterday") {
  PlaceBelief belief;
  belief.at = {"today", kYesterday + at * kHistorySecond};
  belief.travelled = at;
  belief.likeliest.push_back({{session, place * kHistorySecond}, probability, static_cast<double>(place), {}});
  decide(Parameters(), belief);
  return belief;
}

VerifiedClosure closureAt(int at, int place, PlaceVerdict verdict, const std::string& session = "yesterday") {
  return {{session, place * kHistorySecond},
          {"today", kYesterday + at * kHistorySecond},
          static_cast<double>(place),
          static_cast<double>(at),
          verdict};
}

TEST(BeliefHistory, AVerdictMultipliesTheOddsByItsRatio) {
  for (const PlaceVerdict verdict : kAllVerdicts) {
    BeliefHistory history{Parameters()};
    history.add(beliefAt(10, 0.3, 50));
    const auto changed = history.addVerdict(closureAt(10, 50, verdict));
    ASSERT_EQ(changed.size(), 1u);
    const LikelyPlace& place = changed[0].likeliest.at(0);
    EXPECT_NEAR(std::log(toOdds(place.probability)), std::log(toOdds(0.3)) + logRatio(verdict), 1e-6);
    EXPECT_EQ(place.verdict, verdict);
    EXPECT_DOUBLE_EQ(changed[0].p_new, 1.0 - place.probability);
  }
}

TEST(BeliefHistory, AnyProposedPlaceBecomesKnownByTheGraphAndARejectedOneLessProbable) {
  const double least = Parameters().closure_probability;  // a proposed place has more
  BeliefHistory history{Parameters()};
  history.add(beliefAt(10, least + 0.001, 50));
  history.add(beliefAt(100, 0.995, 140));
  const auto accepted = history.addVerdict(closureAt(10, 50, PlaceVerdict::Accepted));
  ASSERT_EQ(accepted.size(), 1u);
  EXPECT_GT(accepted[0].likeliest.at(0).probability, 0.5) << "of one that is hardly proposed";
  const auto confirmed = history.addVerdict(closureAt(10, 50, PlaceVerdict::Confirmed));
  ASSERT_EQ(confirmed.size(), 1u);
  EXPECT_EQ(confirmed[0].at.stamp, kYesterday + 10 * kHistorySecond);
  EXPECT_EQ(confirmed[0].knowledge, PlaceKnowledge::Known);
  const auto rejected = history.addVerdict(closureAt(100, 140, PlaceVerdict::Rejected));
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_LT(rejected[0].likeliest.at(0).probability, 0.995);
  EXPECT_NE(rejected[0].knowledge, PlaceKnowledge::Known);
}

TEST(BeliefHistory, TheVerdictOfTheGraphIsTheLaterOneWhateverTheOrderOfArrival) {
  BeliefHistory history{Parameters()};
  history.add(beliefAt(10, 0.6, 50));
  ASSERT_EQ(history.addVerdict(closureAt(10, 50, PlaceVerdict::Accepted)).at(0).knowledge, PlaceKnowledge::Known);
  const PlaceBelief withdrawn = history.addVerdict(closureAt(10, 50, PlaceVerdict::Withdrawn)).at(0);
  EXPECT_LT(withdrawn.likeliest.at(0).probability, 0.6) << "less than by appearance alone";
  EXPECT_TRUE(history.addVerdict(closureAt(10, 50, PlaceVerdict::Accepted)).empty());
  EXPECT_EQ(history.withVerdicts(beliefAt(10, 0.6, 50)).p_new, withdrawn.p_new);
  EXPECT_EQ(history.addVerdict(closureAt(10, 50, PlaceVerdict::Confirmed)).at(0).knowledge, PlaceKnowledge::Known);
}

TEST(BeliefHistory, CountsForNeighboursOnTheSamePathAndLessWithDistance) {
  BeliefHistory history{Parameters()};
  for (const int at : {0, 5, 10, 20, 200}) history.add(beliefAt(at, 0.3, 50 + at));
  history.addVerdict(closureAt(0, 50, PlaceVerdict::Accepted));
  double before = 1.0;
  for (const int at : {0, 5, 10, 20, 200}) {
    const double probability = history.withVerdicts(beliefAt(at, 0.3, 50 + at)).likeliest.at(0).probability;
    EXPECT_LT(probability, before) << at;
    EXPECT_GE(probability, 0.3) << at;
    before = probability;
  }
  EXPECT_DOUBLE_EQ(before, 0.3);
  // Elsewhere along the earlier path, in another session, and in the opposite direction of travel.
  EXPECT_DOUBLE_EQ(history.withVerdicts(beliefAt(5, 0.3, 80)).likeliest.at(0).probability, 0.3);
  EXPECT_DOUBLE_EQ(history.withVerdicts(beliefAt(5, 0.3, 55, "sunday")).likeliest.at(0).probability, 0.3);
  EXPECT_GT(history.withVerdicts(beliefAt(5, 0.3, 45)).likeliest.at(0).probability, 0.3);
}

TEST(BeliefHistory, VerdictsOnOnePlaceAreNotIndependent) {
  BeliefHistory once{Parameters()}, often{Parameters()};
  once.addVerdict(closureAt(10, 50, PlaceVerdict::Rejected));
  for (const int at : {8, 9, 10, 11}) often.addVerdict(closureAt(at, 40 + at, PlaceVerdict::Rejected));
  EXPECT_EQ(once.withVerdicts(beliefAt(10, 0.6, 50)).p_new, often.withVerdicts(beliefAt(10, 0.6, 50)).p_new);
}

TEST(BeliefHistory, ABeliefAfterTheVerdictIncludesIt) {
  BeliefHistory history{Parameters()};
  history.add(beliefAt(10, 0.3, 50));
  history.addVerdict(closureAt(10, 50, PlaceVerdict::Accepted));
  EXPECT_GT(history.add(beliefAt(12, 0.3, 52)).likeliest.at(0).probability, 0.9);
  history.clear();
  EXPECT_EQ(history.add(beliefAt(12, 0.3, 52)).likeliest.at(0).probability, 0.3);
}

TEST(BeliefHistory, VerdictsOnPlacesThatAreNotLikelyChangeNothing) {
  BeliefHistory history{Parameters()};
  EXPECT_TRUE(history.addVerdict(closureAt(10, 50, PlaceVerdict::Accepted)).empty()) << "no belief yet";
  PlaceBelief dark;
  dark.at = {"today", kYesterday};
  dark.observation = ObservationStatus::Dark;
  EXPECT_EQ(history.add(dark).p_new, 1.0);
  EXPECT_TRUE(history.add(beliefAt(100, 0.0, 50)).likeliest.at(0).probability == 0.0);
  const PlaceBelief certain = history.addVerdict(closureAt(100, 50, PlaceVerdict::Rejected)).at(0);
  EXPECT_TRUE(std::isfinite(certain.p_new));
  EXPECT_LE(certain.p_new, 1.0);
}

TEST(BeliefHistory, WithoutOdometryAVerdictCountsForItsPosesOnly) {
  BeliefHistory history{Parameters()};
  const auto still = [](int at, int place) {
    PlaceBelief belief = beliefAt(at, 0.3, place);
    belief.travelled = belief.likeliest[0].travelled = 0.0;
    return belief;
  };
  VerifiedClosure closure = closureAt(10, 50, PlaceVerdict::Accepted);
  closure.travelled_a = closure.travelled_b = 0.0;
  history.addVerdict(closure);
  EXPECT_GT(history.withVerdicts(still(10, 50)).likeliest.at(0).probability, 0.9);
  EXPECT_EQ(history.withVerdicts(still(30, 70)).likeliest.at(0).probability, 0.3);
  EXPECT_EQ(history.withVerdicts(still(10, 70)).likeliest.at(0).probability, 0.3);
}

TEST(PlaceVerdict, MissingDataAreNoVerdict) {
  urban_nav_core::MetricClosure closure;
  closure.verdict = urban_nav_core::ClosureVerdict::Rejected;
  closure.reason_name = "not_registered";
  EXPECT_EQ(placeVerdict(closure), PlaceVerdict::Rejected);
  for (const char* missing : {"nothing_kept", "unknown_moment"}) {
    closure.reason_name = missing;
    EXPECT_EQ(placeVerdict(closure), std::nullopt) << missing;
  }
  closure.verdict = urban_nav_core::ClosureVerdict::Waiting;
  EXPECT_EQ(placeVerdict(closure), std::nullopt);
  closure.verdict = urban_nav_core::ClosureVerdict::Accepted;
  EXPECT_EQ(placeVerdict(closure), PlaceVerdict::Accepted);
  closure.source = "pose_graph";
  EXPECT_EQ(placeVerdict(closure), PlaceVerdict::Confirmed);
  closure.verdict = urban_nav_core::ClosureVerdict::Rejected;
  EXPECT_EQ(placeVerdict(closure), PlaceVerdict::Withdrawn);
}

TEST(PlaceVerdict, RatiosHaveTheSignOfTheVerdict) {
  EXPECT_GT(logRatio(PlaceVerdict::Accepted), 0.0);
  EXPECT_GT(logRatio(PlaceVerdict::Confirmed), logRatio(PlaceVerdict::Accepted));
  EXPECT_LT(logRatio(PlaceVerdict::Rejected), 0.0);
  EXPECT_LT(logRatio(PlaceVerdict::Withdrawn), 0.0);
}

}  // namespace
}  // namespace fabmap_node
