// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/documents.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "parameters/example_table.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

const std::string kEmptyReadme =
    "# Title\n<!-- parameters: stage -->\nold\n<!-- end -->\nbetween\n<!-- parameters:  -->\n<!-- end -->\nrest\n";

class Documents : public ::testing::Test {
 protected:
  Documents() : package_(::testing::TempDir() + "documents_test") {
    std::filesystem::remove_all(package_);
    std::filesystem::create_directories(package_ + "/config");
  }
  ~Documents() override { std::filesystem::remove_all(package_); }

  const std::vector<RowInfo>& rows_ = exampleTable().rows();
  std::string package_;
};

TEST_F(Documents, GetEachTableWhereItBelongs) {
  writeAtomically(package_ + "/README.md", kEmptyReadme);
  writeAtomically(package_ + "/config/stage.yaml", "old");
  writeDocuments(package_, {{"stage", rows_}, {"", {rows_[0]}}});
  EXPECT_EQ(readTextFile(package_ + "/config/stage.yaml"), printYaml("stage", rows_));
  EXPECT_FALSE(std::filesystem::exists(package_ + "/config/.yaml")) << "only existing files are rewritten";
  const std::string readme = readTextFile(package_ + "/README.md");
  EXPECT_EQ(readme.find("\nold\n"), std::string::npos);
  EXPECT_NE(readme.find("| `stage.window` |"), std::string::npos);
  EXPECT_NE(readme.find("between\n<!-- parameters:  -->\n| parameter |"), std::string::npos) << readme;
}

TEST_F(Documents, AreInAFileOfTheirOwnWhereThePackageHasOne) {
  writeAtomically(package_ + "/README.md", "no markers\n");
  EXPECT_EQ(findParameterDocument(package_), "README.md");
  writeAtomically(package_ + "/PARAMETERS.md", kEmptyReadme);
  EXPECT_EQ(findParameterDocument(package_), "PARAMETERS.md");
  writeDocuments(package_, {{"stage", rows_}, {"", {rows_[0]}}});
  EXPECT_NE(readTextFile(package_ + "/PARAMETERS.md").find("| `stage.window` |"), std::string::npos);
  EXPECT_EQ(readTextFile(package_ + "/README.md"), "no markers\n");
}

TEST_F(Documents, AreLeftAsTheyAreWhereOneIsMissing) {
  writeAtomically(package_ + "/README.md", "no marks\n");
  writeAtomically(package_ + "/config/stage.yaml", "old");
  EXPECT_THROW(writeDocuments(package_, {{"stage", rows_}}), UserError);
  EXPECT_EQ(readTextFile(package_ + "/config/stage.yaml"), "old");
  EXPECT_EQ(readTextFile(package_ + "/README.md"), "no marks\n");
}

}  // namespace
}  // namespace urban_nav_core
