// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fabmap_node/recognition/compact_look.hpp"
#include "support/synthetic_places.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kWords = 60;
constexpr std::size_t kSimilarPlaces = 1300, kOtherPlaces = 400;

/// Words that are mostly below 30, or mostly from 30 on.
WordSet drawWordsOfPlace(bool low, urban_nav_core::testing::Dice& dice) {
  WordSet set;
  for (Word q = 0; q < kWords; ++q)
    if (dice.chance((q < kWords / 2) == low ? 0.7 : 0.1)) set.push_back(q);
  return set;
}

ChowLiuTree learnTree() {
  urban_nav_core::testing::Dice dice(5);
  WordSets drawn{kWords, {}};
  for (int i = 0; i < 200; ++i) drawn.observations.push_back(drawWordsOfPlace(i % 2 == 0, dice));
  return learnChowLiuTree(drawn);
}

/// Map in which one moment of the first session has more places than a search ranks at first, all of them with a higher
/// likelihood than the places of the second session. Words only.
class LargeMap {
 public:
  LargeMap() {
    urban_nav_core::testing::Dice dice(4);
    for (std::size_t i = 0; i < kSimilarPlaces; ++i)
      matcher.add({0, static_cast<urban_nav_core::StampNs>(i), drawWordsOfPlace(true, dice), ""});
    for (std::size_t i = 0; i < kOtherPlaces; ++i)
      matcher.add({1, static_cast<urban_nav_core::StampNs>(i), drawWordsOfPlace(false, dice), ""});
    query = {2, 0, drawWordsOfPlace(true, dice), ""};
  }

 private:
  static MatcherOptions wordsOnly() {
    MatcherOptions options;
    options.second_looks = 0;
    return options;
  }
  const LikelihoodTable table_{learnTree(), {0.39, 0.05}, Dependence::ChowLiu};

 public:
  PlaceMatcher matcher{table_, {}, wordsOnly()};
  DescribedPlace query;
};

TEST(PlaceMatcher, LargeMapKeepsCandidatesElsewhereHoweverUnlikely) {
  const LargeMap map;
  const std::vector<PlaceMatch> found = map.matcher.matches(map.query, [](std::size_t) { return true; });
  const auto elsewhere = std::count_if(found.begin(), found.end(), [](const PlaceMatch& m) { return m.session == 1; });
  EXPECT_EQ(found.size(), 10u);
  EXPECT_EQ(elsewhere, 4);
  EXPECT_EQ(found.front().session, 0u);
}

TEST(PlaceMatcher, WhatIsFoundDoesNotDependOnTheUnlikelyRestOfTheMap) {
  const LargeMap map;
  for (const bool with_second_session : {true, false}) {
    const auto admits = [&](std::size_t i) { return with_second_session || map.matcher.place(i).session == 0; };
    const std::vector<PlaceMatch> found = map.matcher.matches(map.query, admits);
    std::set<std::size_t> places;
    for (const PlaceMatch& match : found) places.insert(match.place);
    const std::vector<PlaceMatch> again =
        map.matcher.matches(map.query, [&](std::size_t i) { return places.count(i) > 0; });
    ASSERT_EQ(again.size(), found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(again[i].place, found[i].place);
      EXPECT_EQ(again[i].log_likelihood, found[i].log_likelihood);
    }
    for (std::size_t i = 0; i < kSimilarPlaces; ++i) {
      if (places.count(i) > 0) continue;
      EXPECT_LE(map.matcher.compare(map.query, i, admits).match.log_likelihood, found.front().log_likelihood);
      i += 50;
    }
  }
}

DescribedPlace describePlace(std::size_t session, urban_nav_core::StampNs seconds, std::uint32_t place,
                             std::uint32_t noise) {
  return {session,
          seconds * 1'000'000'000,
          {static_cast<Word>(place % kWords)},
          packLook(selectFeatures(testing::syntheticPlace(place, noise), 540))};
}

TEST(PlaceMatcher, MarginsNeedAPlaceElsewhere) {
  const LikelihoodTable table(learnTree(), {0.39, 0.05}, Dependence::ChowLiu);
  PlaceMatcher matcher(table, {}, {});
  const DescribedPlace query = describePlace(5, 0, 1, 1);
  const auto firstMatch = [&] { return matcher.match(query, [](std::size_t) { return true; }).value(); };

  matcher.add(describePlace(0, 0, 1, 0));
  matcher.add(describePlace(0, 5, 2, 0));  // not 10 s away
  PlaceMatch match = firstMatch();
  ASSERT_EQ(match.place, 0u);
  EXPECT_FALSE(match.has_elsewhere);
  EXPECT_GT(match.agreeing, 20);
  EXPECT_EQ(match.evidence.look_margin, 0.0);
  EXPECT_EQ(match.evidence.word_margin, 0.0);

  matcher.add(describePlace(1, 0, 1, 0));  // the same place in another session is not one elsewhere
  match = firstMatch();
  EXPECT_TRUE(match.has_elsewhere);
  EXPECT_EQ(match.evidence.word_margin, 0.0);
  const double to_itself = match.evidence.look_margin;
  EXPECT_NEAR(to_itself, (1.0 - std::sqrt(0.5)) * match.evidence.look, 1e-12);

  matcher.add(describePlace(0, 60, 3, 0));
  match = firstMatch();
  EXPECT_TRUE(match.has_elsewhere);
  EXPECT_GT(match.evidence.look_margin, to_itself);
  EXPECT_GT(match.evidence.word_margin, 0.0);
}

}  // namespace
}  // namespace fabmap_node
