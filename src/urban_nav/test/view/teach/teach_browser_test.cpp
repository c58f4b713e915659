// SPDX-License-Identifier: BSD-3-Clause
// The page of `labels teach` in a headless Chromium. Skipped where there is no chromium-driver or no python3-selenium.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "support/taught_yard.hpp"
#include "topics/labels/label_score.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "view/teach/served_scene.hpp"

namespace urban_nav {
namespace {

using scene_labeler::SceneClass;
using testing::ServedScene;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

constexpr int kNoBrowser = 77;  // exit status of the script

class TeachPageInABrowser : public ::testing::Test {
 protected:
  TeachPageInABrowser() {
    testing::writeTaughtYard(folder_, file("m"), file("yard_points.csv"));
    std::string text;
    for (const SceneClass label : truth()) text += std::to_string(static_cast<int>(label)) + "\n";
    writeFile(file("truth"), text);
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  static const std::vector<SceneClass>& truth() {
    static const testing::Yard yard(3, true, false);
    return yard.truth;
  }
  /// Runs a part of the script on the page; returns its exit status and what it printed.
  std::pair<int, std::string> clickThrough(const std::string& part, const ServedScene& served) const {
    const std::string script = (std::filesystem::path(__FILE__).parent_path() / "teach_clicks.py").string();
    const int status = std::system(("python3 '" + script + "' " + part + " '" + served.address() + "' '" +
                                    file("truth") + "' >'" + file("clicks.log") + "' 2>&1")
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(file("clicks.log"))};
  }
  /// Returns the mean F1 of `labels apply` with further arguments.
  double meanF1(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"labels", "apply", file("m"), file("yard_points.csv"), "-o", file("out")};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(testing::runProgram(words), 0);
    const auto table = urban_nav_core::CsvTable::read(file("out/yard_labels.csv"));
    scene_labeler::SceneLabels labels;
    labels.classes = {SceneClass::Other};
    labels.unsure.assign(table.rows(), 0);
    labels.probabilities.assign(table.rows(), 1.0F);
    labels.patches.assign(table.rows(), 0);
    for (std::size_t i = 0; i < table.rows(); ++i)
      labels.labels.push_back(static_cast<SceneClass>(table.integer(i, table.column("label"))));
    LabelScore score(true);
    score.add(labels, truth());
    return score.meanF1();
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(TeachPageInABrowser, TwentyCorrectionsRaiseTheF1) {
  {
    const ServedScene served(file("yard_points.csv"), file("m"), file("c.ply"));
    const auto [status, text] = clickThrough("teach", served);
    if (status == kNoBrowser) GTEST_SKIP() << text;
    ASSERT_EQ(status, 0) << text;
  }
  EXPECT_GT(meanF1({"--corrections", file("c.ply")}), meanF1({}) + 0.2);
}

TEST_F(TeachPageInABrowser, WorksWithoutWebGl) {
  const ServedScene served(file("yard_points.csv"), file("m"), file("c.ply"));
  const auto [status, text] = clickThrough("flat", served);
  if (status == kNoBrowser) GTEST_SKIP() << text;
  EXPECT_EQ(status, 0) << text;
}

}  // namespace
}  // namespace urban_nav
