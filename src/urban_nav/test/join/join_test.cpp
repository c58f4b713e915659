// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "commands/stages.hpp"
#include "inspect/inspect.hpp"
#include "inspect/store_info.hpp"
#include "join/join_command.hpp"
#include "map/map_command.hpp"
#include "support/shared_drive.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

int runWords(std::vector<std::string> words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({mapCommand(makeStages), exportCommand(), mergeCommand(), joinCommand(makeStages)},
                        addStageTables, static_cast<int>(argv.size()), argv.data());
}

/// Two parts of one drive, each mapped alone, and both in one run.
class Join : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const std::vector<std::string> topics = {"/stereo/", "/ladybug/", "/laser_", "/imu/"};
    testing::cutSharedDrive(file("first.bag"), {0.0, 8.0, topics});
    testing::cutSharedDrive(file("second.bag"), {14.0, 22.0, topics});
    for (const char* name : {"first", "second"}) ASSERT_EQ(map({file(std::string(name) + ".bag")}, name), 0);
    ASSERT_EQ(map({file("first.bag"), file("second.bag")}, "both"), 0);
  }
  static void TearDownTestSuite() { shared_.reset(); }
  static std::string file(const std::string& name) { return shared_->file(name); }
  static std::string store(const std::string& name) { return file(name + "/session.db"); }
  static int map(std::vector<std::string> inputs, const std::string& out) {
    inputs.insert(inputs.begin(), "map");
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
      if (is_result && readFile(entry.path().string()) != readFile(file(written) + "/" + name)) names.push_back(name);
    }
    return names;
  }

 private:
  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> Join::shared_;

TEST_F(Join, TheStoreOfAMapHoldsItsResults) {
  ASSERT_EQ(runWords({"export", store("both"), "--results", file("results")}), 0);
  EXPECT_EQ(differences("results", "both"), std::vector<std::string>());
}

TEST_F(Join, StoresInAnyOrderGiveTheBytesOfOneRun) {
  ASSERT_EQ(runWords({"join", store("second"), store("first"), "-o", file("joined.db"), "--json", file("joined.json")}),
            0);
  ASSERT_EQ(runWords({"export", file("joined.db"), "--results", file("joined")}), 0);
  EXPECT_EQ(differences("joined", "both"), std::vector<std::string>());
  const std::string json = readFile(file("joined.json"));
  for (const char* key : {"\"sessions\"", "\"maps\"", "\"apart\"", "\"candidates\"", "\"closures_between\""})
    EXPECT_NE(json.find(key), std::string::npos) << key;
}

TEST_F(Join, JoinedAndMergedStoresAreSourcesLikeOthers) {
  ASSERT_EQ(runWords({"merge", store("first"), store("second"), "-o", file("merged.db")}), 0);
  EXPECT_EQ(readStoreInfo(file("merged.db")).joined.size(), 2U);
  ASSERT_EQ(runWords({"join", file("merged.db"), store("first"), "-o", file("again.db")}), 0);
  ASSERT_EQ(runWords({"export", file("again.db"), "--results", file("again")}), 0);
  EXPECT_EQ(differences("again", "both"), std::vector<std::string>());
}

TEST_F(Join, ClosuresThatAreNotProposedAnywhereAreNamed) {
  std::filesystem::copy_file(store("first"), file("given.db"));
  {
    urban_nav_store::Store given(file("given.db"), urban_nav_store::Access::Write);
    const urban_nav_store::SessionId id = given.sessions().all().front().id;
    std::vector<urban_nav_core::StampNs> stamps;
    given.graph().forEachNode(id, [&](const urban_nav_store::Node& node) { stamps.push_back(node.stamp); });
    urban_nav_store::Edge edge;
    edge.a = {id, stamps.front()};
    edge.b = {id, stamps.back()};
    edge.kind = urban_nav_store::EdgeKind::Stereo;
    edge.source = "loop_metric";
    given.graph().put(edge);
    given.commit();
  }
  ASSERT_EQ(runWords({"join", file("given.db"), store("second"), "-o", file("named.db"), "--json", file("named.json")}),
            0);
  EXPECT_NE(readFile(file("named.json")).find("1 of 1 closures that the stores had accepted are not in the joined map"),
            std::string::npos);
}

TEST_F(Join, StoresWithoutCovariancesGiveNoneAndAreNamed) {
  std::filesystem::copy_file(store("first"), file("live.db"));
  {
    urban_nav_store::Store live(file("live.db"), urban_nav_store::Access::Write);
    const urban_nav_store::SessionId id = live.sessions().all().front().id;
    std::vector<urban_nav_store::RelaxedPose> poses;
    live.graph().forEachRelaxed(id, [&](const urban_nav_store::RelaxedPose& pose) { poses.push_back(pose); });
    for (urban_nav_store::RelaxedPose& pose : poses) {
      pose.covariance.setZero();
      live.graph().put(id, pose);
    }
    live.commit();
  }
  ::testing::internal::CaptureStderr();
  ASSERT_EQ(runWords({"export", file("live.db"), "--results", file("live")}), 0);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("left out: rows of session first in covariance.csv"),
            std::string::npos);
  const std::string rows = readFile(file("live/covariance.csv"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1) << "the header alone";
}

TEST_F(Join, WhatCannotBeJoinedIsRefusedAndNothingIsWritten) {
  writeFile(file("text.db"), "not a store\n");
  EXPECT_EQ(runWords({"join", store("first"), file("text.db"), "-o", file("none.db")}), 2);
  EXPECT_EQ(runWords({"join", store("first"), file("absent.db"), "-o", file("none.db")}), 2);
  std::filesystem::copy_file(store("second"), file("cut.db"));
  {
    urban_nav_store::Store cut(file("cut.db"), urban_nav_store::Access::Write);
    urban_nav_store::Session session = cut.sessions().all().front();
    session.complete = false;
    cut.sessions().put(session);
    cut.commit();
  }
  EXPECT_EQ(runWords({"join", store("first"), file("cut.db"), "-o", file("none.db")}), 1);
  for (const char* left : {"none.db", "none.db.joining", "none.db.joining.files"})
    EXPECT_FALSE(std::filesystem::exists(file(left))) << left;
}

}  // namespace
}  // namespace urban_nav
