// SPDX-License-Identifier: BSD-3-Clause
// The picture and the table of stages in the documents, compared with the list of stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "commands/stages.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav {
namespace {

using Names = std::vector<std::string>;

// Relative to the folder of the package, in which tests run. A package alone, as in a release, has no documents.
const std::filesystem::path kDocuments = "../../docs";

class StageDocumentsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(kDocuments)) GTEST_SKIP() << "the package stands alone, without " << kDocuments;
    for (const std::unique_ptr<Stage>& stage : makeStages()) stages.push_back(stage->describe().name);
  }

  static std::string read(const char* file) { return urban_nav_core::readTextFile((kDocuments / file).string()); }

  /// Returns the first group of each match.
  static Names findAll(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    Names found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), regex); it != std::sregex_iterator(); ++it)
      found.push_back((*it)[1]);
    return found;
  }

  static Names sorted(Names names) {
    std::sort(names.begin(), names.end());
    return names;
  }

  Names stages;
};

TEST_F(StageDocumentsTest, PictureOfTheDataFlowShowsEachStageOnce) {
  const std::string picture = read("data_flow.svg");
  EXPECT_EQ(sorted(findAll(picture, "<g id=\"stage-(\\w+)\">")), sorted(stages));
  for (const std::string& stage : stages) {
    const Names titles = findAll(picture, "<g id=\"stage-" + stage + "\">\\s*<rect[^>]*>\\s*<text[^>]*>(\\w+)<");
    EXPECT_EQ(titles, Names{stage}) << "the title of its box";
  }
}

TEST_F(StageDocumentsTest, ArchitectureListsTheStagesInTheirOrder) {
  const std::string text = read("architecture.md");
  const std::size_t begin = text.find("\n## The stages of `map`\n");
  ASSERT_NE(begin, std::string::npos);
  const std::string section = text.substr(begin, text.find("\n## ", begin + 1) - begin);
  EXPECT_EQ(findAll(section, "\n\\| `(\\w+)` \\|"), stages);
}

TEST_F(StageDocumentsTest, NothingIsCalledPlanned) {
  for (const char* file : {"data_flow.svg", "architecture.md"})
    EXPECT_EQ(findAll(read(file), "([Pp]lanned)"), Names()) << file;
}

}  // namespace
}  // namespace urban_nav
