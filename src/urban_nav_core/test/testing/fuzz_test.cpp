// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/fuzz.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

const std::vector<std::string> kSeeds = {"1.5 2.5 3.5\n4 5 6\n", "stage:\n  window: 25\n"};

TEST(Fuzz, SameSeedSameTexts) {
  Mutator a(kSeeds, 7), b(kSeeds, 7), c(kSeeds, 8);
  bool differs = false;
  for (int i = 0; i < 1000; ++i) {
    const std::string text = a.next();
    ASSERT_EQ(text, b.next());
    differs = differs || text != c.next();
  }
  EXPECT_TRUE(differs);
}

TEST(Fuzz, TakesEmptySeeds) {
  Mutator mutator({""}, 1);
  for (int i = 0; i < 1000; ++i) mutator.next();
}

TEST(Fuzz, CountsWhatIsTakenAndRefused) {
  const FuzzResult result = fuzzText(kSeeds, [](const std::string& text) {
    if (text.find("nan") != std::string::npos) throw UserError("file", "nan", "numbers");
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 100);
  EXPECT_GT(result.refused, 10);
}

TEST(Fuzz, FindsAReaderThatThrowsSomethingElse) {
  const FuzzResult result = fuzzText(kSeeds, [](const std::string& text) { (void)std::stod(text); });
  EXPECT_NE(result.failure, "");
}

TEST(Fuzz, GivesFilesAndRemovesThem) {
  std::string last;
  bool first_was_the_seed = false;
  const FuzzResult result = fuzzFile(kSeeds, "poses.txt", [&](const std::string& path) {
    std::stringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    if (last.empty()) first_was_the_seed = text.str() == kSeeds[0];
    last = path;
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_TRUE(first_was_the_seed);
  EXPECT_EQ(std::filesystem::path(last).filename(), "poses.txt");
  EXPECT_FALSE(std::filesystem::exists(last));
}

}  // namespace
}  // namespace urban_nav_core::testing
