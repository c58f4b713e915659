// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_truth.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr urban_nav_core::StampNs kTruthSecond = 1'000'000'000;

/// Rows 30 s apart; row i has the match and probability given.
PlaceQuery queryOfMatches(const std::vector<std::pair<int, double>>& matches) {
  PlaceQuery query;
  query.sessions = {"drive"};
  for (std::size_t i = 0; i < matches.size(); ++i) {
    PlaceQueryRow row;
    row.stamp = 30 * kTruthSecond * static_cast<urban_nav_core::StampNs>(i);
    if (matches[i].first >= 0) {
      row.recognition.match = fabmap_node::PlaceMatch();
      row.recognition.probability = matches[i].second;
      row.matched_row = static_cast<std::size_t>(matches[i].first);
    }
    query.rows.push_back(row);
  }
  return query;
}

PlaceTruth truthAlongX(const std::vector<double>& metres) {
  PlaceTruth truth;
  for (const double x : metres) truth.positions.emplace_back(Eigen::Vector3d(x, 0.0, 0.0));
  return truth;
}

std::string writeTruthFile(const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::temp_directory_path() / ("place_truth_" + name)).string();
  std::ofstream(path) << text;
  return path;
}

TEST(ScorePlaces, CountsRevisitsAndWhatIsAnnounced) {
  // Rows 2 and 3 revisit rows 0 and 1; row 4 is new, and matched wrongly with less certainty than row 2.
  const PlaceQuery query = queryOfMatches({{-1, 0.0}, {0, 0.1}, {0, 0.995}, {1, 0.3}, {0, 0.95}});
  const PlaceScore score = scorePlaces(query, truthAlongX({0.0, 100.0, 2.0, 101.0, 300.0}), 20 * kTruthSecond);
  EXPECT_EQ(score.ranking.revisits, 2u);
  EXPECT_EQ(score.ranking.first, 2u);
  EXPECT_EQ(score.ranking.found, 1u);
  EXPECT_EQ(score.sure, 1u);
  EXPECT_EQ(score.sure_right, 1u);
  EXPECT_EQ(score.nearly, 1u);
  EXPECT_EQ(score.nearly_right, 0u);
  ASSERT_FALSE(score.ranking.curve.empty());
  EXPECT_EQ(score.ranking.curve.front().precision, 1.0);
  EXPECT_EQ(score.ranking.curve.front().recall, 0.5);
}

TEST(ScorePlaces, StatesHowOftenClaimsAreRight) {
  // Rows 2 and 3 are right, row 4 is wrong; all claim the same.
  const PlaceQuery query = queryOfMatches({{-1, 0.0}, {0, 0.0}, {0, 0.75}, {1, 0.75}, {0, 0.75}});
  const PlaceScore score = scorePlaces(query, truthAlongX({0.0, 100.0, 2.0, 101.0, 300.0}), 20 * kTruthSecond);
  ASSERT_EQ(score.reliability.size(), 2u);
  EXPECT_EQ(score.reliability[0].claims, 1u) << "of probability zero";
  EXPECT_EQ(score.reliability[1].claims, 3u);
  EXPECT_EQ(score.reliability[1].right, 2u);
  EXPECT_DOUBLE_EQ(score.reliability[1].stated, 0.75);
  EXPECT_NEAR(score.calibration_error, 0.75 - 2.0 / 3.0, 1e-12);
}

TEST(ScorePlaces, RevisitsNearAnAnnouncedOneCount) {
  const PlaceQuery query = queryOfMatches({{-1, 0.0}, {0, 0.999}, {0, 0.2}, {0, 0.2}});
  EXPECT_EQ(scorePlaces(query, truthAlongX({0.0, 2.0, 3.5, 6.0}), 20 * kTruthSecond).near_sure, 2u);
}

TEST(ScoreRanking, WrongMatchesOfTheSameScoreComeFirst) {
  const PlaceTruth truth = truthAlongX({0.0, 50.0, 1.0, 90.0});
  const RankingScore score = scoreRanking({{2, 0, 5.0}, {3, 0, 5.0}}, truth, {false, false, true, false});
  EXPECT_EQ(score.revisits, 1u);
  EXPECT_EQ(score.first, 1u);
  EXPECT_EQ(score.found, 0u);
  ASSERT_EQ(score.curve.size(), 2u);
  EXPECT_EQ(score.curve[0].precision, 0.0);
  EXPECT_EQ(score.curve[1].recall, 1.0);
}

TEST(ScorePlaces, MatchesBetweenTheTwoRadiiDoNotCount) {
  const PlaceScore score =
      scorePlaces(queryOfMatches({{-1, 0.0}, {0, 0.999}}), truthAlongX({0.0, 9.0}), 20 * kTruthSecond);
  EXPECT_EQ(score.ranking.revisits, 0u);
  EXPECT_EQ(score.sure, 0u);
}

TEST(ScorePlaces, PlacesWithinTheMaskAreNoRevisits) {
  const PlaceQuery query = queryOfMatches({{-1, 0.0}, {-1, 0.0}});
  EXPECT_EQ(scorePlaces(query, truthAlongX({0.0, 0.0}), 20 * kTruthSecond).ranking.revisits, 1u);
  EXPECT_EQ(scorePlaces(query, truthAlongX({0.0, 0.0}), 40 * kTruthSecond).ranking.revisits, 0u);
}

TEST(ReadPlaceTruth, TablesOfPositionsNeedOneRowForEachImage) {
  const std::string path = writeTruthFile("positions.csv", "image,position\na.png,0\nb.png,5.5\n");
  const PlaceTruth truth = readPlaceTruth(path, queryOfMatches({{-1, 0.0}, {-1, 0.0}}), std::nullopt);
  EXPECT_EQ(truth.unit, "images");
  EXPECT_EQ(truth.radius, 3.0);
  ASSERT_TRUE(truth.positions.at(1));
  EXPECT_EQ(truth.positions[1]->x(), 5.5);
  EXPECT_THROW(readPlaceTruth(path, queryOfMatches({{-1, 0.0}}), std::nullopt), urban_nav_core::UserError);
}

TEST(ReadPlaceTruth, TrajectoriesReachTheImagesOfTheirTimes) {
  const std::string path = writeTruthFile("path.tum", "0.0 1 0 0 0 0 0 1\n0.5 2 0 0 0 0 0 1\n");
  const PlaceTruth truth = readPlaceTruth(path, queryOfMatches({{-1, 0.0}, {-1, 0.0}}), 6.0);
  EXPECT_EQ(truth.radius, 6.0);
  EXPECT_EQ(truth.elsewhere, 8.0);
  ASSERT_TRUE(truth.positions.at(0));
  EXPECT_EQ(truth.positions[0]->x(), 1.0);
  EXPECT_FALSE(truth.positions.at(1));
}

}  // namespace
}  // namespace urban_nav
