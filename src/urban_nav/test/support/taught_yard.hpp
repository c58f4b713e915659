// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "commands/commands.hpp"
#include "commands/stages.hpp"
#include "scene_labeler/classes.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav::testing {

/// A yard with points of known classes, in a file `x,y,z[,label]`.
struct Yard {
  std::vector<scene_labeler::SceneClass> truth;  ///< one per point
  std::string csv;

  /// Paved ground and a wall of 1200 points each; with `is_furnished` also two cars and a bush of 500 points each.
  Yard(unsigned seed, bool is_furnished, bool has_labels) : random_(seed), has_labels_(has_labels) {
    csv = has_labels ? "x,y,z,label\n" : "x,y,z\n";
    using scene_labeler::SceneClass;
    for (int i = 0; i < 1200; ++i) add(draw(0, 10), draw(0, 8), draw(0, 0.02), SceneClass::Paved);
    for (int i = 0; i < 1200; ++i) add(10 + draw(0, 0.02), draw(0, 8), draw(0, 3), SceneClass::Wall);
    if (!is_furnished) return;
    for (const double x : {1.0, 5.0})
      for (int i = 0; i < 500; ++i) add(x + draw(0, 2.4), 5 + draw(0, 1.6), 1.4 + draw(0, 0.03), SceneClass::Vehicle);
    for (int i = 0; i < 500; ++i) add(3 + draw(0, 1.5), 1 + draw(0, 1.5), draw(0.3, 1.8), SceneClass::Foliage);
  }

 private:
  double draw(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 10000) / 1e4; }
  void add(double x, double y, double z, scene_labeler::SceneClass label) {
    csv += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z);
    csv += has_labels_ ? "," + std::to_string(static_cast<int>(label)) + "\n" : "\n";
    truth.push_back(label);
  }

  std::mt19937 random_;
  bool has_labels_;
};

/// Runs `urban_nav` and returns its exit status.
inline int runProgram(std::vector<std::string> words) {
  words.insert(words.begin(), "urban_nav");
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine(allCommands(), addStageTables, static_cast<int>(argv.size()), argv.data());
}

/// Writes a model of unfurnished yards, which knows only paving and walls, and a furnished yard without labels.
inline void writeTaughtYard(const urban_nav_input::testing::TemporaryFolder& folder, const std::string& model,
                            const std::string& scene) {
  using urban_nav_input::testing::writeFile;
  writeFile(folder.file("a_points.csv"), Yard(1, false, true).csv);
  writeFile(folder.file("b_points.csv"), Yard(2, false, true).csv);
  if (runProgram({"labels", "train", folder.file("a_points.csv"), folder.file("b_points.csv"), "-o", model}) != 0)
    throw std::runtime_error("the model of the yard was not trained");
  writeFile(scene, Yard(3, true, false).csv);
}

}  // namespace urban_nav::testing
