// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "commands/stages.hpp"
#include "scene_labeler/model/label_model.hpp"
#include "topics/labels/labels.hpp"
#include "topics/vo/vo.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

class LabelsTeaching : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  int labels(std::vector<std::string> words) const {
    words.insert(words.begin(), {"urban_nav", "labels"});
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    return runCommandLine({labelsCommand(runOdometry)}, addStageTables, static_cast<int>(argv.size()), argv.data());
  }
  /// Paved ground, a wall, and a level roof of `roof` points, which are vehicles; as a PLY with this name of the label.
  void writePly(const std::string& name, const std::string& property, unsigned seed, int roof) const {
    std::mt19937 random(seed);
    const auto draw = [&random](double high) {
      return std::to_string(high * static_cast<double>(random() % 1000) / 1e3) + " ";
    };
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(3000 + roof) +
                       "\nproperty float x\nproperty float y\nproperty float z\nproperty float " + property +
                       "\nend_header\n";
    for (int i = 0; i < 1500; ++i) text += draw(6) + draw(6) + draw(0.02) + "2\n";
    for (int i = 0; i < 1500; ++i) text += "6 " + draw(6) + draw(3) + "8\n";
    for (int i = 0; i < roof; ++i) text += "-" + draw(4) + draw(4) + "1." + std::to_string(40 + i % 3) + " 7\n";
    urban_nav_input::testing::writeFile(path(name), text);
  }
  void trainModel() const {
    writePly("a.ply", "label", 1, 0);
    writePly("b.ply", "label", 2, 0);
    ASSERT_EQ(labels({"train", path("a.ply"), path("b.ply"), "-o", path("m")}), 0);
  }

 private:
  const urban_nav_input::testing::TemporaryFolder folder_;
};

TEST_F(LabelsTeaching, AppliesACorrectedClassElsewhere) {
  trainModel();
  writePly("edited.ply", "scalar_label", 3, 1000);
  writePly("other.ply", "label", 4, 1000);
  ASSERT_EQ(labels({"train", "--add", path("m"), "--corrections", path("edited.ply"), "-o", path("taught"), "--threads",
                    "1"}),
            0);
  ASSERT_EQ(
      labels({"train", "--add", path("m"), "--corrections", path("edited.ply"), "-o", path("again"), "--threads", "2"}),
      0);
  EXPECT_EQ(urban_nav_input::testing::readFile(path("taught")), urban_nav_input::testing::readFile(path("again")));
  ASSERT_EQ(labels({"apply", path("taught"), path("other.ply"), "-o", path("out")}), 0);
  const auto table = urban_nav_core::CsvTable::read(path("out/other_labels.csv"));
  ASSERT_EQ(table.rows(), 4000U);
  int right = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const int expected = i < 1500 ? 2 : i < 3000 ? 8 : 7;
    right += table.integer(i, 1) == expected ? 1 : 0;
  }
  EXPECT_GT(right, 3800);
  EXPECT_EQ(labels({"train", path("a.ply"), "--add", path("taught"), "-o", path("more")}), 0)
      << "scenes, no corrections";
}

TEST_F(LabelsTeaching, RejectsUnusableTrainingData) {
  trainModel();
  writePly("edited.ply", "scalar_label", 3, 100);
  writePly("unlabelled.ply", "height", 3, 100);
  const std::string good = urban_nav_input::testing::readFile(path("edited.ply"));
  urban_nav_input::testing::writeFile(path("short.ply"), good.substr(0, good.size() / 2));
  urban_nav_input::testing::writeFile(path("unknown.ply"), good.substr(0, good.size() - 2) + "77\n");
  urban_nav_input::testing::writeFile(path("half.ply"), good.substr(0, good.size() - 2) + "7.5\n");
  urban_nav_input::testing::writeFile(path("foreign"), "ply\n");
  const scene_labeler::LabelModel model = scene_labeler::parseModel(urban_nav_input::testing::readFile(path("m")), "m");
  scene_labeler::LabelModel without = model;
  without.samples = {};
  urban_nav_input::testing::writeFile(path("without"), scene_labeler::printModel(without));
  const auto teach = [&](const std::string& name, const std::string& edited) {
    return labels({"train", "--add", path(name), "--corrections", path(edited), "-o", path("taught")});
  };
  for (const char* edited : {"unlabelled.ply", "short.ply", "unknown.ply", "half.ply", "absent.ply"})
    EXPECT_EQ(teach("m", edited), 2) << edited;
  for (const char* name : {"foreign", "without", "absent"}) EXPECT_EQ(teach(name, "edited.ply"), 2) << name;
  EXPECT_EQ(labels({"train", "--corrections", path("edited.ply"), "-o", path("taught")}), 2) << "no model";
  EXPECT_EQ(labels({"train", "--add", path("m"), "-o", path("again")}), 0) << "its thresholds are determined again";
  EXPECT_EQ(labels({"train", "-o", path("taught")}), 2) << "nothing to learn";
  EXPECT_EQ(labels({"train", "--add", path("m"), "--corrections", path("edited.ply"), "--features", "paper", "-o",
                    path("taught")}),
            2);
  EXPECT_FALSE(std::filesystem::exists(path("taught")));
}

}  // namespace
}  // namespace urban_nav
