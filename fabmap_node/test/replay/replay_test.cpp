// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/replay/replay.hpp"

#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdlib>

#include <filesystem>
#include <fstream>
#include <map>

#include "fabmap_node/replay/openfabmap_file.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

namespace fs = std::filesystem;

const char* const kBags =
    "%YAML:1.0\n---\nBOW: !!opencv-matrix\n   rows: 4\n   cols: 3\n   dt: f\n"
    "   data: [ 0.5, 0., 0.5, 1., 0., 0., 0., 0.5, 0.5, 0.25, 0.25, 0.5 ]\n";

class Replay : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const std::string path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::temp_directory_path() / ("replay_test_" + std::to_string(::getpid()));
};

TEST_F(Replay, ReadsBagsAndGivesADistributionForEachQuery) {
  const WordSets bags = readBagsOfWords(write("bow.yml", kBags));
  ASSERT_EQ(bags.vocabulary_size, 3u);
  EXPECT_EQ(bags.observations, (std::vector<WordSet>{{0, 2}, {0}, {1, 2}, {0, 1, 2}}));
  for (const std::string& model : replayModelNames()) {
    std::map<std::size_t, std::pair<int, double>> per_query;
    replay(bags, learnChowLiuTree(bags), replayModelFromName(model), [&per_query](const ReplayRow& row) {
      ++per_query[row.query].first;
      per_query[row.query].second += row.probability;
    });
    ASSERT_EQ(per_query.size(), 4u) << model;
    for (const auto& [query, rows] : per_query) {
      EXPECT_EQ(rows.first, static_cast<int>(query) + 1);
      EXPECT_NEAR(rows.second, 1.0, 1e-12);
    }
  }
}

TEST_F(Replay, RefusesAVocabularyInPlaceOfCounts) {
  const std::string head = "%YAML:1.0\n---\n",
                    matrix = ": !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: f\n   data: ";
  for (const std::string& text :
       {head + "Vocabulary" + matrix + "[ 1., 2. ]\n", head + "words" + matrix + "[ 0.1, -0.2 ]\n",
        head + "words" + matrix + "[ 0., 17.5 ]\n"}) {
    try {
      readBagsOfWords(write("bow.yml", text));
      FAIL() << text;
    } catch (const urban_nav_core::UserError& error) {
      EXPECT_NE(std::string(error.what()).find("not counts of words"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(readBagsOfWords(write("bow.yml", head + "counts" + matrix + "[ 0., 17. ]\n")).observations.front(),
            WordSet{1});
}

TEST_F(Replay, TreesSurviveTheFile) {
  const ChowLiuTree tree = learnChowLiuTree(readBagsOfWords(write("bow.yml", kBags)));
  for (const char* const name : {"tree.yml", "tree.yml.gz"}) {
    writeTree(folder_ / name, tree);
    const ChowLiuTree read = readTree(folder_ / name);
    EXPECT_EQ(read.parent, tree.parent);
    EXPECT_EQ(read.p, tree.p);
    EXPECT_EQ(read.p_parent_present, tree.p_parent_present);
    EXPECT_EQ(read.p_parent_absent, tree.p_parent_absent);
  }
}

TEST_F(Replay, RefusesWhatDoesNotFit) {
  const std::string bags = write("bow.yml", kBags);
  EXPECT_THROW(readTree(bags + ".absent"), urban_nav_core::UserError);
  EXPECT_THROW(readTree(write("text.yml", "no matrix: 1\n")), urban_nav_core::UserError);
  EXPECT_THROW(replayModelFromName("fabmap3"), urban_nav_core::UserError);
  const WordSets other{4, {{0}, {1, 3}}};
  EXPECT_THROW(replay(readBagsOfWords(bags), learnChowLiuTree(other), ReplayModel::ChowLiu, [](const ReplayRow&) {}),
               urban_nav_core::UserError);
}

TEST_F(Replay, DamagedFilesAreRefusedOrRead) {
  const auto bags =
      urban_nav_core::testing::fuzzFile({kBags}, "bow.yml", [](const std::string& path) { readBagsOfWords(path); });
  EXPECT_EQ(bags.failure, "");
  writeTree(folder_ / "tree.yml", learnChowLiuTree(readBagsOfWords(write("bow.yml", kBags))));
  std::ifstream file(folder_ / "tree.yml");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto trees =
      urban_nav_core::testing::fuzzFile({text}, "tree.yml", [](const std::string& path) { readTree(path); });
  EXPECT_EQ(trees.failure, "");
}

}  // namespace
}  // namespace fabmap_node
