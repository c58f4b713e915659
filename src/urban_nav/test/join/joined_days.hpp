// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands/stages.hpp"
#include "inspect/inspect.hpp"
#include "inspect/store_info.hpp"
#include "join/join_command.hpp"
#include "join/release_command.hpp"
#include "map/map_command.hpp"
#include "support/shared_drive.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {

inline int runWords(std::vector<std::string> words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({mapCommand(makeStages), exportCommand(), infoCommand(), mergeCommand(),
                         joinCommand(makeStages), releaseCommand()},
                        addStageTables, static_cast<int>(argv.size()), argv.data());
}

/// Two parts of one drive that show different places and one of them on another day, each mapped alone; both parts,
/// and both days, in one run.
class JoinedDays : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<urban_nav_input::testing::TemporaryFolder>();
    testing::cutSharedDrive(file("first.bag"), {0.0, 8.0, topics()});
    testing::cutSharedDrive(file("second.bag"), {14.0, 22.0, topics()});
    testing::cutSharedDrive(file("again.bag"), {0.0, 6.0, topics(), "", 1});
    for (const char* name : {"first", "second", "again"}) ASSERT_EQ(map({file(std::string(name) + ".bag")}, name), 0);
    ASSERT_EQ(map({file("first.bag"), file("second.bag")}, "both"), 0);
    ASSERT_EQ(map({file("first.bag"), file("again.bag")}, "days"), 0);
  }
  static void TearDownTestSuite() {
    shared_.reset();
    has_third_ = false;
  }
  static std::vector<std::string> topics() { return {"/stereo/", "/ladybug/", "/laser_", "/imu/"}; }
  /// Makes the first day once more on a third one, and maps all three in one run to "three_days".
  static void makeThirdDay() {
    if (std::exchange(has_third_, true)) return;
    testing::cutSharedDrive(file("third.bag"), {0.0, 6.0, topics(), "", 2});
    ASSERT_EQ(mapThreeDays("three_days", {"--threads", "2"}), 0);
  }
  static int mapThreeDays(const std::string& out, const std::vector<std::string>& options) {
    return map({file("first.bag"), file("again.bag"), file("third.bag")}, out, options);
  }
  static std::string file(const std::string& name) { return shared_->file(name); }
  static std::string store(const std::string& name) { return file(name + "/session.db"); }
  static int map(std::vector<std::string> inputs, const std::string& out,
                 const std::vector<std::string>& options = {}) {
    inputs.insert(inputs.begin(), "map");
    inputs.insert(inputs.end(), options.begin(), options.end());
    for (const std::string& word :
         {std::string("--out"), file(out), std::string("--stages"), std::string("vo,places,loops,graph,lasers")})
      inputs.push_back(word);
    return runWords(inputs);
  }
  /// Names of the result files that differ from those of a folder that `map` wrote.
  static std::vector<std::string> differences(const std::string& written, const std::string& mapped) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(file(mapped))) {
      const std::string name = entry.path().filename().string();
      const bool is_result = name.rfind("trajectory", 0) == 0 || name.rfind("covariance", 0) == 0 ||
                             name.rfind("relative_covariance", 0) == 0 || name.rfind("closures", 0) == 0 ||
                             name.rfind("graph", 0) == 0 || name == "map.ply";
      if (is_result && urban_nav_input::testing::readFile(entry.path().string()) !=
                           urban_nav_input::testing::readFile(file(written) + "/" + name))
        names.push_back(name);
    }
    return names;
  }

 private:
  static inline std::unique_ptr<urban_nav_input::testing::TemporaryFolder> shared_;
  static inline bool has_third_ = false;
};

}  // namespace urban_nav
