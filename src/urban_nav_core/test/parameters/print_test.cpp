// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/print.hpp"

#include "io/reader_check.hpp"
#include "parameters/example_table.hpp"

namespace urban_nav_core {
namespace {

const std::vector<RowInfo>& rows() { return exampleTable().rows(); }

TEST(Print, YamlReadsBackAsWhatWasPrinted) {
  const std::string text = printYaml("stage", rows());
  const auto settings = resolve("stage", rows(), parseParameters(text, "stage.yaml"));
  for (std::size_t i = 0; i < settings.size(); ++i) {
    EXPECT_EQ(printValue(settings[i].value), printValue(rows()[i].standard)) << settings[i].name;
    EXPECT_EQ(settings[i].origin.rfind("stage.yaml:", 0), 0U) << "every row is in the file";
  }
}

TEST(Print, YamlWithSettingsReadsBackToo) {
  const std::vector<Assignment> given = {parseSetting("stage.window=25"),
                                         parseSetting("stage.name=odd: #\"text\" \\ here"),
                                         parseSetting("stage.noise=0.1")};
  const auto settings = resolve("stage", rows(), given);
  const auto back = resolve("stage", rows(), parseParameters(printYaml("stage", rows(), settings), "stage.yaml"));
  for (std::size_t i = 0; i < settings.size(); ++i) EXPECT_EQ(printValue(back[i].value), printValue(settings[i].value));
}

TEST(Print, YamlStatesTheAllowedValues) {
  const std::string text = printYaml("stage", rows());
  EXPECT_EQ(text.rfind("stage:\n  # Poses kept. Allowed: 1...100000 (frames). [section 2.2]\n  window: 10\n", 0), 0U)
      << text;
  EXPECT_EQ(printYaml("", {rows()[0]}).rfind("# Poses kept.", 0), 0U);
}

TEST(Print, YamlHasNumbersThatRoslaunchReadsAsNumbers) {
  RowInfo row = rows()[0];
  row.name = "share";
  row.standard = 1e-5;
  EXPECT_NE(printYaml("stage", {row}).find("  share: 1.0e-05\n"), std::string::npos) << "1e-05 is a text in YAML 1.1";
}

TEST(Print, LongSentencesAreWrapped) {
  RowInfo row = rows()[0];
  row.sentence.clear();
  for (int i = 0; i < 60; ++i) row.sentence += "word ";
  const std::string text = printYaml("stage", {row});
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_LE(end - begin, 110U);
    begin = end + 1;
  }
}

TEST(Print, MarkdownHasARowAParameter) {
  const std::string text = printMarkdown("stage", rows());
  EXPECT_NE(text.find("| `stage.window` | `10` | frames | 1...100000 | Poses kept. | section 2.2 |\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("pixel \\| of any"), std::string::npos);
}

TEST(Print, MarkdownGoesBetweenItsMarkers) {
  const std::string readme = "# Title\n<!-- parameters: stage -->\nold\n<!-- end -->\nrest\n";
  const std::string text = insertMarkdown(readme, "README.md", "stage", rows());
  EXPECT_EQ(text, "# Title\n<!-- parameters: stage -->\n" + printMarkdown("stage", rows()) + "<!-- end -->\nrest\n");
  EXPECT_EQ(insertMarkdown(text, "README.md", "stage", rows()), text);
  EXPECT_EQ(
      catchError([] { insertMarkdown("# Title\n", "README.md", "stage", rows()); }),
      "README.md: no markers for the table of parameters: expected `<!-- parameters: stage -->` ... `<!-- end -->`");
}

TEST(Print, HelpShowsValuesOriginsAndWhatIsForUsers) {
  std::vector<RowInfo> some = rows();
  some[1].audience = Audience::Experts;
  const auto settings = resolve("stage", some, {parseSetting("stage.window=25")});
  const std::string text = printHelp("stage", some, settings);
  EXPECT_EQ(text.rfind("  stage.window = 25  (--set stage.window=25): Poses kept.\n", 0), 0U) << text;
  EXPECT_NE(text.find("  stage.forget = schur  (default): What becomes of old poses.\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("stage.noise"), std::string::npos);
}

TEST(Print, HelpForExpertsShowsEachParameterWithWhatIsAllowed) {
  std::vector<RowInfo> some = rows();
  some[1].audience = Audience::Experts;
  const auto settings = resolve("stage", some, {parseSetting("stage.window=25")});
  const std::string text = printHelpForExperts("stage", some, settings);
  EXPECT_EQ(text.rfind("  stage.window = 25  (--set stage.window=25)\n      Poses kept. Allowed: 1...100000 (frames). "
                       "[section 2.2]\n",
                       0),
            0U)
      << text;
  EXPECT_NE(text.find("  stage.noise = 0.3  (default)\n"), std::string::npos) << text;
}

TEST(Print, MarkdownFoldsWhatIsForExperts) {
  std::vector<RowInfo> some = rows();
  some[1].audience = Audience::Experts;
  const std::string text = printMarkdown("stage", some);
  const std::size_t fold = text.find("\n\n<details><summary>Parameters for experts</summary>\n\n|parameter|");
  ASSERT_NE(fold, std::string::npos) << text;
  EXPECT_LT(text.find("`stage.name`"), fold);
  EXPECT_GT(text.find("`stage.noise`"), fold);
  EXPECT_EQ(text.substr(text.size() - 13), "\n\n</details>\n") << "a blank line ends the table";
}

}  // namespace
}  // namespace urban_nav_core
