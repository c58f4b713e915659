// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "join/join_plan.hpp"
#include "joined_days.hpp"
#include "map/store_keys.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::readFile;
using urban_nav_input::testing::writeFile;

TEST_F(JoinedDays, TheStoreOfAMapHoldsItsResults) {
  ASSERT_EQ(runWords({"export", store("both"), "--results", file("results")}), 0);
  EXPECT_EQ(differences("results", "both"), std::vector<std::string>());
}

TEST_F(JoinedDays, StoresInAnyOrderGiveTheBytesOfOneRun) {
  ASSERT_EQ(runWords({"join", store("second"), store("first"), "-o", file("joined.db"), "--json", file("joined.json")}),
            0);
  ASSERT_EQ(runWords({"export", file("joined.db"), "--results", file("joined")}), 0);
  EXPECT_EQ(differences("joined", "both"), std::vector<std::string>());
  const std::string json = readFile(file("joined.json"));
  for (const char* key : {"\"sessions\"", "\"maps\"", "\"apart\"", "\"candidates\"", "\"closures_between\""})
    EXPECT_NE(json.find(key), std::string::npos) << key;
}

TEST_F(JoinedDays, JoinedAndMergedStoresAreSourcesLikeOthers) {
  ASSERT_EQ(runWords({"merge", store("first"), store("second"), "-o", file("merged.db")}), 0);
  EXPECT_EQ(readStoreInfo(file("merged.db")).joined.size(), 2U);
  ASSERT_EQ(runWords({"join", file("merged.db"), store("first"), "-o", file("again.db")}), 0);
  ASSERT_EQ(runWords({"export", file("again.db"), "--results", file("again")}), 0);
  EXPECT_EQ(differences("again", "both"), std::vector<std::string>());
}

TEST_F(JoinedDays, SessionsOfOnePlaceBecomeOneMap) {
  ASSERT_EQ(runWords({"merge", store("again"), store("first"), "-o", file("apart.db")}), 0);
  EXPECT_EQ(readStoreInfo(file("apart.db")).joined.size(), 2U);
  ASSERT_EQ(runWords({"join", file("apart.db"), "-o", file("days.db")}), 0);
  EXPECT_EQ(readStoreInfo(file("days.db")).joined.size(), 1U);
  ASSERT_EQ(runWords({"export", file("days.db"), "--results", file("days_joined")}), 0);
  EXPECT_EQ(differences("days_joined", "days"), std::vector<std::string>());
}

TEST_F(JoinedDays, ARunThatContinuesAStoreGivesTheSameInAnyOrder) {
  ASSERT_EQ(map({file("first.bag")}, "backwards", {"--store", store("again")}), 0);
  EXPECT_EQ(differences("backwards", "days"), std::vector<std::string>());
}

/// Lines of closures.csv that a map has accepted.
std::vector<std::string> acceptedRows(const std::string& folder) {
  std::vector<std::string> rows;
  std::istringstream text(readFile(folder + "/closures.csv"));
  for (std::string line; std::getline(text, line);)
    if (line.find(",accepted,") != std::string::npos) rows.push_back(line);
  return rows;
}

TEST_F(JoinedDays, AMapDoesNotDependOnSessionsElsewhere) {
  ASSERT_EQ(runWords({"join", store("second"), store("again"), store("first"), "-o", file("three.db")}), 0);
  const StoreInfo info = readStoreInfo(file("three.db"));
  ASSERT_EQ(info.joined.size(), 2U) << "the second part of the drive shows other places";
  ASSERT_EQ(runWords({"export", file("three.db"), "--results", file("three")}), 0);
  EXPECT_FALSE(acceptedRows(file("days")).empty());
  EXPECT_EQ(acceptedRows(file("three")), acceptedRows(file("days")));
  ASSERT_EQ(map({file("first.bag"), file("second.bag"), file("again.bag")}, "three_mapped"), 0);
  EXPECT_EQ(differences("three", "three_mapped"), std::vector<std::string>());
  ASSERT_EQ(runWords({"join", store("first"), store("second"), store("again"), "--plan", file("plan_of_three")}), 0);
  for (const std::string& piece : readPlan(file("plan_of_three/plan.json")).pieces)
    ASSERT_EQ(runWords({"join", "--piece", file("plan_of_three/" + piece)}), 0);
  ASSERT_EQ(runWords({"join", "--finish", file("plan_of_three"), "-o", file("three_pieces.db")}), 0);
  ASSERT_EQ(runWords({"export", file("three_pieces.db"), "--results", file("three_pieces")}), 0);
  EXPECT_EQ(differences("three_pieces", "three_mapped"), std::vector<std::string>());
}

TEST_F(JoinedDays, PiecesGiveTheSame) {
  ASSERT_EQ(runWords({"join", store("again"), store("first"), "--plan", file("plan"), "--json", file("plan.json")}), 0);
  EXPECT_EQ(readFile(file("plan.json")), readFile(file("plan/plan.json")));
  ASSERT_EQ(runWords({"join", store("first"), store("again"), "--plan", file("other")}), 0);
  EXPECT_EQ(readFile(file("other/plan.json")), readFile(file("plan/plan.json")));
  EXPECT_EQ(runWords({"join", "--finish", file("plan"), "-o", file("pieces.db")}), 1) << "a piece without result";
  for (const std::string& piece : readPlan(file("plan/plan.json")).pieces) {
    ASSERT_EQ(runWords({"join", "--piece", file("plan/" + piece)}), 0);
    const std::string result = readFile(file("plan/" + piece + ".done"));
    ASSERT_EQ(runWords({"join", "--piece", file("plan/" + piece)}), 0);
    EXPECT_EQ(readFile(file("plan/" + piece + ".done")), result);
  }
  ASSERT_EQ(runWords({"join", "--finish", file("plan"), "-o", file("pieces.db")}), 0);
  ASSERT_EQ(runWords({"export", file("pieces.db"), "--results", file("pieces")}), 0);
  EXPECT_EQ(differences("pieces", "days"), std::vector<std::string>());
  const std::string name = readPlan(file("plan/plan.json")).pieces.front();
  ASSERT_EQ(runWords({"join", store("first"), store("second"), "--plan", file("foreign")}), 0);
  ASSERT_EQ(runWords({"join", "--piece", file("foreign/" + name)}), 0);
  std::filesystem::copy_file(file("foreign/" + name + ".done"), file("plan/" + name + ".done"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(runWords({"join", "--finish", file("plan"), "-o", file("none.db")}), 2) << "of another plan";
  EXPECT_FALSE(std::filesystem::exists(file("none.db")));
}

TEST_F(JoinedDays, OptionsThatContradictEachOtherAreRefused) {
  EXPECT_EQ(runWords({"join", store("first")}), 2);
  EXPECT_EQ(runWords({"join", "-o", file("none.db")}), 2);
  EXPECT_EQ(runWords({"join", store("first"), "--plan", file("p"), "-o", file("none.db")}), 2);
  EXPECT_EQ(runWords({"join", "--piece", file("p"), "--finish", file("p"), "-o", file("none.db")}), 2);
  EXPECT_EQ(runWords({"join", "--piece", file("absent.json")}), 2);
  EXPECT_EQ(runWords({"join", "--finish", file("absent"), "-o", file("none.db")}), 2);
}

TEST_F(JoinedDays, ClosuresThatAreNotProposedAnywhereAreNamed) {
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
  EXPECT_NE(readFile(file("named.json")).find("1 of 1 accepted closures of the stores are not in the joined map"),
            std::string::npos);
}

TEST_F(JoinedDays, StoresWithoutCovariancesGiveNoneAndAreNamed) {
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

TEST_F(JoinedDays, WhatCannotBeJoinedIsRefusedAndNothingIsWritten) {
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
  std::filesystem::copy_file(store("second"), file("killed.db"));
  {
    urban_nav_store::Store killed(file("killed.db"), urban_nav_store::Access::Write);
    const urban_nav_store::SessionId id = killed.sessions().all().front().id;
    EXPECT_FALSE(killed.states().get(id, kRunStage)) << "the run has ended";
    killed.states().put(id, kRunStage, {});  // as before the last commit of a run
    killed.commit();
  }
  for (const char* command : {"join", "merge"})
    EXPECT_EQ(runWords({command, store("first"), file("killed.db"), "-o", file("none.db")}), 1) << command;
  EXPECT_EQ(runWords({"release", file("killed.db"), "-o", file("none.db")}), 1);
  for (const char* left : {"none.db", "none.db.joining", "none.db.joining.files"})
    EXPECT_FALSE(std::filesystem::exists(file(left))) << left;
}

}  // namespace
}  // namespace urban_nav
