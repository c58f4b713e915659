// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "circle_store.hpp"
#include "commands/stages.hpp"
#include "edits/edits.hpp"
#include "inspect/inspect.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/edit_journal.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::printStamp;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::Access;
using urban_nav_store::Store;

int runEditWords(std::vector<std::string> words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({edgeCommand(), verifyCommand(makeStages), exportCommand(), mergeCommand(), whyCommand()},
                        addStageTables, static_cast<int>(argv.size()), argv.data());
}

class EdgeCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    testing::writeCircleStore(shared_->file("first.db"));
  }
  static void TearDownTestSuite() { shared_.reset(); }

  EdgeCommand() { std::filesystem::copy_file(shared_->file("first.db"), store_); }

  int edge(std::vector<std::string> words, const std::string& store = "") const {
    words.insert(words.begin(), {"edge", store.empty() ? store_ : store});
    words.insert(words.end(), {"--json", folder_.file("edge.json")});
    return runEditWords(words);
  }
  std::string json() const { return readFile(folder_.file("edge.json")); }
  bool changed() const { return json().find("\"changed\": true") != std::string::npos; }
  /// Returns all bytes that the map is exported with.
  std::string exported(const std::string& store = "") const {
    EXPECT_EQ(runEditWords({"export", store.empty() ? store_ : store, "--g2o", folder_.file("graph.g2o"), "--results",
                            folder_.file("results")}),
              0);
    std::string bytes = readFile(folder_.file("graph.g2o"));
    for (const char* name : {"trajectory.tum", "covariance.csv", "closures.csv", "graph.g2o"})
      bytes += readFile(folder_.file(std::string("results/") + name));
    return bytes;
  }
  std::vector<urban_nav_core::StampedPose> poses(const std::string& id) const {
    Store store(store_, Access::Read);
    return readTrajectory(store, *store.sessions().find(id)).T_map_base;
  }

  static inline std::unique_ptr<TemporaryFolder> shared_;
  const TemporaryFolder folder_;
  const std::string store_ = folder_.file("s.db");
};

TEST_F(EdgeCommand, TheMapOfTheStoreIsAFunctionOfItsMeasurements) {
  EXPECT_EQ(runEditWords({"verify", store_, "--json", folder_.file("verify.json")}), 0);
  EXPECT_NE(readFile(folder_.file("verify.json")).find("\"same\": true"), std::string::npos);
}

TEST_F(EdgeCommand, UndoGivesBackTheBytesAndRedoTakesThemAgain) {
  const std::string before = exported();
  ASSERT_EQ(edge({"reject", "3"}), 0);
  EXPECT_TRUE(changed()) << json();
  const std::string after = exported();
  EXPECT_TRUE(before != after);
  ASSERT_EQ(edge({"undo"}), 0);
  EXPECT_TRUE(before == exported());
  ASSERT_EQ(edge({"redo"}), 0);
  EXPECT_TRUE(after == exported());
  EXPECT_EQ(runEditWords({"verify", store_}), 0);
  ASSERT_EQ(edge({"accept", "3"}), 0);
  EXPECT_TRUE(before == exported()) << "rejected and accepted again";
  ASSERT_EQ(edge({"undo", "100"}), 0);
  EXPECT_TRUE(before == exported());
  ASSERT_EQ(edge({"undo"}), 0);
  EXPECT_FALSE(changed());
}

TEST_F(EdgeCommand, AnEditThatChangesNothingIsNotEntered) {
  ASSERT_EQ(edge({"reject", "3"}), 0);
  ASSERT_EQ(edge({"reject", "3"}), 0);
  EXPECT_FALSE(changed());
  EXPECT_NE(json().find("already"), std::string::npos) << json();
  ASSERT_EQ(edge({"accept", "4"}), 0);
  EXPECT_FALSE(changed());
  Store store(store_, Access::Read);
  EXPECT_EQ(urban_nav_store::EditJournal(store).all().size(), 1U);
}

TEST_F(EdgeCommand, TheOrderOfEditsOnDifferentClosuresDoesNotMatter) {
  const std::string other = folder_.file("other.db");
  std::filesystem::copy_file(store_, other);
  for (const char* id : {"2", "5", "9"}) ASSERT_EQ(edge({"reject", id}), 0);
  for (const char* id : {"9", "5", "2"}) ASSERT_EQ(edge({"reject", id}, other), 0);
  EXPECT_TRUE(exported() == exported(other));
}

TEST_F(EdgeCommand, AnAssertionAddsAnEdgeThatCanBeRemoved) {
  const std::string before = exported();
  const std::string a = printStamp(poses(testing::kMondayId)[40].stamp),
                    b = printStamp(poses(testing::kMondayId)[640].stamp);
  ASSERT_EQ(edge({"assert", a, b, "--pose", "3,-2,0,0,0,0.38268343,0.92387953", "--sigma", "0.01,0.1"}), 0);
  EXPECT_TRUE(changed());
  EXPECT_NE(json().find("\"edge\": 13"), std::string::npos) << json();
  EXPECT_EQ(json().find("\"contradicted_by\": []"), std::string::npos) << json();
  ASSERT_EQ(edge({"list"}), 0);
  EXPECT_NE(json().find("\"asserted\""), std::string::npos);
  ASSERT_EQ(edge({"remove", "13"}), 0);
  EXPECT_TRUE(before == exported());
  EXPECT_EQ(edge({"remove", "3"}), 2) << "no edit has added it";
}

TEST_F(EdgeCommand, APinMovesTheMapOntoItsPlace) {
  const std::string before = exported();
  const urban_nav_core::StampedPose pose = poses(testing::kMondayId)[450];
  const Eigen::Vector3d goal = pose.pose.t() + Eigen::Vector3d(0.3, 0.2, 0.0);
  const std::string at = std::to_string(goal.x()) + "," + std::to_string(goal.y()) + "," + std::to_string(goal.z());
  ASSERT_EQ(edge({"pin", printStamp(pose.stamp), "--at", at, "--sigma", "0.001"}), 0);
  EXPECT_LT((poses(testing::kMondayId)[450].pose.t() - goal).norm(), 0.005);
  EXPECT_EQ(runEditWords({"verify", store_}), 0);
  ASSERT_EQ(edge({"undo"}), 0);
  EXPECT_TRUE(before == exported());
}

TEST_F(EdgeCommand, AnOriginMovesTheMapAsAWhole) {
  const std::string before = exported();
  const urban_nav_core::StampedPose pose = poses(testing::kTuesdayId)[100];
  const double apart = (poses(testing::kMondayId)[7].pose.t() - pose.pose.t()).norm();
  ASSERT_EQ(edge({"origin", "tuesday+" + std::to_string(urban_nav_core::secondsBetween(
                                             poses(testing::kTuesdayId)[0].stamp, pose.stamp))}),
            0);
  EXPECT_LT(poses(testing::kTuesdayId)[100].pose.t().norm(), 1e-9);
  EXPECT_NEAR(poses(testing::kMondayId)[7].pose.t().norm(), apart, 1e-9);
  ASSERT_EQ(edge({"undo"}), 0);
  EXPECT_TRUE(before == exported());
}

TEST_F(EdgeCommand, ACutTakesOutOneStep) {
  const std::string before = exported();
  ASSERT_EQ(edge({"cut", "monday", printStamp(poses(testing::kMondayId)[500].stamp)}), 0);
  EXPECT_TRUE(changed());
  EXPECT_EQ(poses(testing::kMondayId).size(), 901U);
  ASSERT_EQ(edge({"undo"}), 0);
  EXPECT_TRUE(before == exported());
}

TEST_F(EdgeCommand, CommandsOfTheJournalMakeTheSameMapOfACopy) {
  const std::string other = folder_.file("other.db");
  std::filesystem::copy_file(store_, other);
  const std::string a = printStamp(poses(testing::kMondayId)[100].stamp),
                    b = printStamp(poses(testing::kTuesdayId)[80].stamp);
  for (const std::string& store : {store_, other}) {
    ASSERT_EQ(edge({"reject", "4"}, store), 0);
    if (store == store_) {
      ASSERT_EQ(edge({"reject", "6"}, store), 0);
      ASSERT_EQ(edge({"undo"}, store), 0);
    }
    ASSERT_EQ(edge({"assert", a, b, "--pose", "1,2,0,0,0,0,1"}, store), 0);
  }
  EXPECT_TRUE(exported() == exported(other));
  const std::string merged = folder_.file("merged.db");
  ASSERT_EQ(runEditWords({"merge", store_, "-o", merged}), 0);
  EXPECT_TRUE(exported() == exported(merged));
  ASSERT_EQ(edge({"list"}), 0);
  const std::string listed = json();
  ASSERT_EQ(edge({"list"}, merged), 0);
  EXPECT_EQ(listed, json());
}

TEST_F(EdgeCommand, RefusesWhatItCannotDoAndLeavesTheStore) {
  const std::string bytes = readFile(store_), a = printStamp(poses(testing::kMondayId)[100].stamp),
                    b = printStamp(poses(testing::kMondayId)[200].stamp);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"reject", "99999"},
                                             {"reject", "first"},
                                             {"reject"},
                                             {"measure", "99999999.5", b},
                                             {"assert", a, a, "--pose", "1,0,0,0,0,0,1"},
                                             {"assert", a, b},
                                             {"assert", a, b, "--pose", "1,0,0,0,0,0"},
                                             {"assert", a, b, "--pose", "1,0,0,0,0,0,0"},
                                             {"assert", a, b, "--pose", "nan,0,0,0,0,0,1"},
                                             {"assert", a, b, "--pose", "1,0,0,0,0,0,1", "--sigma", "-1,1"},
                                             {"cut", "nowhere", a},
                                             {"pin", a},
                                             {"pin", a, "--at", "1,2"},
                                             {"pin", a, "--at", "1,2,3", "--sigma", "0"},
                                             {"undo", "0"},
                                             {"forget", "1"}})
    EXPECT_EQ(edge(words), 2) << words.front();
  EXPECT_EQ(edge({"list"}, folder_.file("absent.db")), 2);
  EXPECT_TRUE(bytes == readFile(store_));
}

TEST_F(EdgeCommand, AStoreThatIsWrittenIsLeftAlone) {
  const Store writer(store_, Access::Write);
  EXPECT_EQ(edge({"reject", "3"}), 1);
}

TEST_F(EdgeCommand, AMapThatAnotherProgramHasRelaxedComesBackToo) {
  {
    Store store(store_, Access::Write);
    const urban_nav_core::StampedPose pose = poses(testing::kMondayId)[10];
    store.graph().put(
        testing::kMondayId,
        urban_nav_store::RelaxedPose{
            pose.stamp, urban_nav_core::Pose(pose.pose.q(), pose.pose.t() + Eigen::Vector3d(0.1, 0, 0)), 7});
    store.commit();
  }
  EXPECT_EQ(runEditWords({"verify", store_}), 1);
  const std::string before = exported();
  ASSERT_EQ(edge({"reject", "3"}), 0);
  ASSERT_EQ(edge({"undo"}), 0);
  EXPECT_TRUE(before == exported());
}

TEST_F(EdgeCommand, AJumpIsExplainedByTheClosuresThatMoveIt) {
  ASSERT_EQ(runEditWords({"why", store_, "--jump", "monday+40", "--json", folder_.file("jump.json"), "-o",
                          folder_.file("jump.html")}),
            0);
  EXPECT_NE(readFile(folder_.file("jump.json")).find("\"id\": 3"), std::string::npos);
  EXPECT_NE(readFile(folder_.file("jump.html")).find("closure 3"), std::string::npos);
  EXPECT_EQ(runEditWords({"why", store_, "--jump", "monday+4000"}), 2);
}

}  // namespace
}  // namespace urban_nav
