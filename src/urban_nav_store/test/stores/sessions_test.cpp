// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/session_store.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/dump.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {
namespace {

using testing::Drawn;
using testing::expectError;
using testing::fill;
using testing::Folder;

TEST(SessionId, DependsOnEveryPartOfTheOriginAndOnNothingElse) {
  const SessionOrigin origin{"lisa", "run", 1225719873501685123, "digest"};
  EXPECT_EQ(makeSessionId(origin), makeSessionId(origin));
  EXPECT_EQ(makeSessionId(origin).size(), 20U);
  std::set<SessionId> ids = {makeSessionId(origin)};
  for (const SessionOrigin& other : {SessionOrigin{"lisb", "run", origin.start, "digest"},
                                     {"lisa", "ran", origin.start, "digest"},
                                     {"lisa", "run", origin.start + 1, "digest"},
                                     {"lisa", "run", origin.start, "digesu"},
                                     {"lisar", "un", origin.start, "digest"},
                                     {"lisa", "run", origin.start, ""}})
    EXPECT_TRUE(ids.insert(makeSessionId(other)).second);
}

class SessionRows : public ::testing::Test {
 protected:
  const Folder folder;
  const std::string path = folder.file("s.db");
  Store store{path, Access::Write};
  SessionStore& sessions = store.sessions();
};

TEST_F(SessionRows, ComeBackInOrderOfStart) {
  Session late{"b", "late", "lisa", "two", 200, false}, early{"c", "early", "", "", -5, true},
      same{"a", "x", "", "", 200, true};
  for (const Session& session : {late, early, same}) sessions.put(session);
  EXPECT_EQ(sessions.all(), (std::vector<Session>{early, same, late}));
  late.complete = true;
  late.name = "renamed";
  sessions.put(late);
  EXPECT_EQ(sessions.find("b"), late);
  EXPECT_FALSE(sessions.find("d"));
  Session other = late;
  other.start = 201;
  expectError([&] { sessions.put(other); }, path, "session b already exists with another origin");
}

TEST_F(SessionRows, WhatIsKnownOfThemIsReplacedByName) {
  Drawn drawn(1);
  sessions.put("a", StoredParameter{"swf_vo.window", "25", "default"});
  sessions.put("a", StoredParameter{"swf_vo.window", "26", "--set"});
  sessions.put("a", StoredParameter{"memory_mb", "4000", "default"});
  const auto parameters = sessions.parameters("a");
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[1].value, "26");
  EXPECT_EQ(parameters[1].origin, "--set");
  sessions.put("a", Property{"version", "1"});
  EXPECT_EQ(sessions.properties("a").at(0).value, "1");
  const urban_nav_core::Pose pose = drawn.pose();
  sessions.put("a", Extrinsic{"laser_left", pose});
  EXPECT_EQ(sessions.extrinsics("a").at(0).T_base_frame.t(), pose.t());
  sessions.put(Anchor{"a", "b", 4, pose});
  EXPECT_EQ(sessions.anchor("a")->map, "b");
  EXPECT_EQ(sessions.anchor("a")->T_map_odom.t(), pose.t());
  EXPECT_FALSE(sessions.anchor("b"));
  EXPECT_TRUE(sessions.parameters("b").empty());
}

TEST_F(SessionRows, AreRemovedWithAllThatNamesThem) {
  const SessionId stays = fill(store, 1, 10);
  const std::string before = dump(store);
  const SessionId goes = fill(store, 2, 10);
  Drawn drawn(3);
  const Edge edge = drawn.edge({stays, 1}, {goes, 2}, EdgeKind::Icp);
  store.graph().put(edge);
  store.graph().putEvidence(edge, "x");
  sessions.remove(goes);
  EXPECT_TRUE(dump(store) == before);
  store.commit();
  EXPECT_TRUE(dump(store) == before);
  sessions.remove("unknown");
}

}  // namespace
}  // namespace urban_nav_store
