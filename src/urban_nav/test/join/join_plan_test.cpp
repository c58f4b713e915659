// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "map/closure_rows.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

JoinPlan makePlan(std::size_t candidates) {
  JoinPlan plan;
  plan.stores = {{"../a.db", "aa"}, {"../b.db", "bb"}, {"../c.db", "cc"}};
  plan.sessions = {{"id_a", "drive", 0}, {"id_b", "drive_2", 1}, {"id_c", "drive_3", 2}};
  plan.parameters = {"loop_metric.icp=off"};
  plan.camera = "camera";
  const char* names[] = {"drive", "drive_2", "drive_3"};
  for (std::size_t i = 0; i < candidates; ++i) {
    urban_nav_core::TopologicalClosure closure;
    closure.a = {names[i % 2], static_cast<urban_nav_core::StampNs>(1'000'000'000'000'000'001 + i)};
    closure.b = {names[1 + i % 2], 7};
    closure.probability = 1.0 / static_cast<double>(3 + i);
    plan.candidates.push_back(toCandidate(closure, "places"));
  }
  return plan;
}

TEST(JoinPlanTest, PiecesHoldEachCandidateOnce) {
  JoinPlan plan = makePlan(1001);
  const std::vector<JoinPiece> pieces = splitPlan(plan);
  ASSERT_EQ(pieces.size(), plan.pieces.size());
  EXPECT_EQ(std::set<std::string>(plan.pieces.begin(), plan.pieces.end()).size(), plan.pieces.size());
  std::size_t candidates = 0;
  for (const JoinPiece& piece : pieces) {
    EXPECT_EQ(piece.plan, plan.digest);
    EXPECT_LE(piece.stores.size(), 2U);
    for (const auto& candidate : piece.candidates)
      for (const std::string& name : {candidate.a.session, candidate.b.session})
        EXPECT_TRUE(std::any_of(piece.sessions.begin(), piece.sessions.end(),
                                [&](const PlannedSession& session) { return session.name == name; }));
    candidates += piece.candidates.size();
  }
  EXPECT_EQ(candidates, 1001U);
  EXPECT_EQ(plan.candidates.size(), 1001U);
}

TEST(JoinPlanTest, FilesComeBack) {
  const TemporaryFolder folder;
  JoinPlan plan = makePlan(5);
  const std::vector<JoinPiece> pieces = splitPlan(plan);
  plan.warnings = {"words"};
  writeFile(folder.file("plan.json"), toJson(plan).print());
  writeFile(folder.file("piece.json"), toJson(pieces.front()).print());
  EXPECT_EQ(toJson(readPlan(folder.file("plan.json"))).print(), toJson(plan).print());
  EXPECT_EQ(toJson(readPiece(folder.file("piece.json"))).print(), toJson(pieces.front()).print());
  EXPECT_THROW(readPiece(folder.file("plan.json")), urban_nav_core::UserError);
  const std::string text = toJson(plan).print();
  for (std::size_t size = 0; size + 3 < text.size(); size += 7) {
    writeFile(folder.file("cut.json"), text.substr(0, size));
    EXPECT_THROW(readPlan(folder.file("cut.json")), urban_nav_core::UserError) << size;
  }
}

TEST(JoinPlanTest, PlansDifferInTheirDigests) {
  JoinPlan one = makePlan(5), other = makePlan(5), third = makePlan(6);
  other.stores[1].digest = "b2";
  splitPlan(one);
  splitPlan(other);
  splitPlan(third);
  EXPECT_NE(one.digest, other.digest);
  EXPECT_NE(one.digest, third.digest);
}

}  // namespace
}  // namespace urban_nav
