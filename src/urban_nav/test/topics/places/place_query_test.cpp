// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_query.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "support/place_images.hpp"
#include "topics/places/place_evaluation.hpp"
#include "topics/places/place_sessions.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using testing::sceneImage;
using urban_nav_input::testing::TemporaryFolder;

/// Monday shows scenes 0 ... 7, tuesday 4, 5, 6 and a new one.
class PlaceQueryTest : public ::testing::Test {
 protected:
  PlaceQueryTest() {
    for (unsigned i = 0; i < 8; ++i) write("monday", i, sceneImage(i));
    for (unsigned i = 0; i < 3; ++i) write("tuesday", i, sceneImage(4 + i, 2));
    write("tuesday", 3, sceneImage(77));
    write("tuesday", 4, cv::Mat(384, 512, CV_8UC1, cv::Scalar(0)));
  }

  void write(const std::string& session, unsigned i, const cv::Mat& image) {
    std::filesystem::create_directories(folder_.file(session));
    ASSERT_TRUE(cv::imwrite(folder_.file(session + "/" + std::to_string(i) + ".png"), image));
  }
  PlaceTruth truth() const {
    PlaceTruth truth;
    truth.unit = "images";
    truth.radius = 0.5;
    truth.elsewhere = 0.5;
    for (int i = 0; i < 8; ++i) truth.positions.emplace_back(Eigen::Vector3d(i, 0, 0));
    for (int i = 0; i < 3; ++i) truth.positions.emplace_back(Eigen::Vector3d(4 + i, 0, 0));
    for (int i = 0; i < 2; ++i) truth.positions.emplace_back(Eigen::Vector3d(100 + i, 0, 0));
    return truth;
  }

  const TemporaryFolder folder_;
  const std::vector<std::string> inputs_ = {folder_.file("monday"), folder_.file("tuesday")};
  const fabmap_node::PlaceModel model_ = fabmap_node::defaultModel();
  const fabmap_node::RecogniserOptions options_;
  Console console_;
};

TEST_F(PlaceQueryTest, RevisitsOfAnotherSessionAreTheLikeliestEarlierPlaces) {
  const PlaceQuery query = queryPlaces(model_, inputs_, {}, options_, console_);
  ASSERT_EQ(query.rows.size(), 13u);
  EXPECT_EQ(query.sessions, (std::vector<std::string>{"monday", "tuesday"}));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_FALSE(query.rows[i].recognition.match) << "within the mask: " << i;
  for (std::size_t i = 8; i < 11; ++i) {
    ASSERT_TRUE(query.rows[i].recognition.match);
    EXPECT_EQ(query.rows[i].matched_row, i - 4);
    EXPECT_EQ(query.rows[i].session, 1u);
    EXPECT_GT(query.rows[i].recognition.probability, query.rows[11].recognition.probability);
  }
  EXPECT_EQ(query.unused, 1u);
  EXPECT_EQ(query.rows[12].recognition.status, fabmap_node::ObservationStatus::Dark);
}

TEST_F(PlaceQueryTest, ARecordingGivesTheSameOnAnyNumberOfThreads) {
  const PlaceQuery query = queryPlaces(model_, inputs_, {}, options_, console_);
  const urban_nav_core::ThreadLimit one_thread(1);
  const PlaceRecording recording = recordPlaces(model_, inputs_, {}, options_.matcher, console_);
  const PlaceQuery again = recognisePlaces(model_, recording, options_);
  ASSERT_EQ(recording.places.size(), query.rows.size());
  EXPECT_FALSE(recording.places[0].thumbnail.empty());
  ASSERT_EQ(again.rows.size(), query.rows.size());
  EXPECT_EQ(again.unused, query.unused);
  EXPECT_EQ(again.sessions, query.sessions);
  for (std::size_t i = 0; i < query.rows.size(); ++i) {
    EXPECT_EQ(again.rows[i].recognition.probability, query.rows[i].recognition.probability);
    EXPECT_EQ(again.rows[i].matched_row, query.rows[i].matched_row);
  }
}

TEST_F(PlaceQueryTest, EvaluationComparesEvidenceAndFormulas) {
  const PlaceRecording recording = recordPlaces(model_, inputs_, {}, options_.matcher, console_);
  const PlaceEvaluation evaluation =
      evaluatePlaces(model_, recording, options_, [this](const PlaceQuery&) { return truth(); });
  ASSERT_EQ(evaluation.rows.size(), 3u);
  EXPECT_EQ(evaluation.rows.front().name, "words alone");
  EXPECT_EQ(evaluation.score.ranking.revisits, 3u);
  EXPECT_EQ(evaluation.score.ranking.first, 3u);
  ASSERT_EQ(evaluation.words.size(), 3u);
  for (const PlaceEvaluation::Curve& curve : evaluation.words) EXPECT_EQ(curve.score.first, 3u) << curve.name;
  std::map<std::size_t, double> sums;
  for (const WordProbability& entry : evaluation.confusion) {
    EXPECT_GT(entry.probability, 0.0);
    sums[entry.row] += entry.probability;
  }
  for (const auto& [row, sum] : sums) EXPECT_LE(sum, 1.0 + 1e-9) << row;
  EXPECT_EQ(sums.at(0), 1.0) << "nothing is before the first image: it is new";
  const std::string folder = folder_.file("report");
  writeEvaluation(evaluation, recording, "default", folder);
  for (const char* name :
       {"report.html", "precision_recall.svg", "reliability.svg", "confusion.csv", "confusion.png", "matches.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder + "/" + name)) << name;
  EXPECT_EQ(cv::imread(folder + "/confusion.png").rows % 13, 0);
}

TEST_F(PlaceQueryTest, EvidenceThatIsSwitchedOffHasNoRow) {
  const PlaceRecording recording = recordPlaces(model_, inputs_, {}, options_.matcher, console_);
  fabmap_node::RecogniserOptions words = options_;
  words.sequence = false;
  words.matcher.second_looks = 0;
  const auto rows = evaluatePlaces(model_, recording, words, [this](const PlaceQuery&) { return truth(); }).rows;
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].name, "words alone");
}

}  // namespace
}  // namespace urban_nav
