// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/session_namer.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace urban_nav_live {
namespace {

using urban_nav_core::StampNs;
using urban_nav_store::makeSessionId;
using urban_nav_store::Session;

constexpr StampNs kStart = 1'225'719'873'501'685'000, kEnd = kStart + 60'000'000'000;

SessionNamer::EndsAt endsAt(StampNs newest) {
  return [newest](const Session&, StampNs stamp) { return stamp == newest; };
}

TEST(SessionNamer, IdDependsOnRobotRecordingAndStartAlone) {
  SessionNamer one("lisa"), other("lisa");
  const auto named = one.begin("monday", kStart);
  EXPECT_FALSE(named.resumed);
  EXPECT_EQ(named.session.id, makeSessionId({"lisa", "monday", kStart, ""}));
  EXPECT_EQ(named.session.name, "monday");
  EXPECT_EQ(named.session.recording, "monday");
  EXPECT_EQ(named.session.robot, "lisa");
  EXPECT_EQ(named.session.start, kStart);
  EXPECT_FALSE(named.session.complete);
  EXPECT_EQ(other.begin("monday", kStart).session.id, named.session.id);
}

TEST(SessionNamer, WithoutARecordingTheStartIsTheName) {
  SessionNamer namer("");
  const auto named = namer.begin("", kStart);
  EXPECT_EQ(named.session.name, "1225719873.501685000");
  EXPECT_EQ(named.session.recording, "");
}

TEST(SessionNamer, ARecordingPlayedAgainGetsANumber) {
  SessionNamer namer("lisa");
  const auto first = namer.begin("monday", kStart), second = namer.begin("monday", kStart),
             third = namer.begin("monday", kStart);
  EXPECT_EQ(second.session.recording, "monday (2)");
  EXPECT_EQ(third.session.recording, "monday (3)");
  EXPECT_NE(first.session.id, second.session.id);
  EXPECT_NE(second.session.id, third.session.id);
  EXPECT_EQ(second.session.name, "monday");
}

TEST(SessionNamer, ResumesAStoredRecordingThatIsPlayedAgain) {
  SessionNamer before("lisa");
  Session stored = before.begin("monday", kStart).session;
  stored.complete = true;
  SessionNamer namer("lisa");
  const auto named = namer.begin("monday", kStart, {stored}, endsAt(kEnd));
  EXPECT_TRUE(named.resumed);
  EXPECT_FALSE(named.continues);
  EXPECT_EQ(named.session.id, stored.id);
  EXPECT_FALSE(named.session.complete);
}

TEST(SessionNamer, ResumesEachRoundOfAStoredRecording) {
  SessionNamer before("lisa");
  const Session first = before.begin("monday", kStart).session, second = before.begin("monday", kStart).session;
  SessionNamer namer("lisa");
  EXPECT_EQ(namer.begin("monday", kStart, {second, first}).session.id, first.id);
  const auto again = namer.begin("monday", kStart, {second, first});
  EXPECT_EQ(again.session.id, second.id);
  EXPECT_TRUE(again.resumed);
  const auto third = namer.begin("monday", kStart, {second, first});
  EXPECT_FALSE(third.resumed);
  EXPECT_EQ(third.session.recording, "monday (3)");
}

TEST(SessionNamer, ContinuesAStoredSessionAtItsNewestPose) {
  SessionNamer before("lisa");
  const Session stored = before.begin("monday", kStart).session;
  SessionNamer namer("lisa");
  const auto named = namer.begin("monday", kEnd, {stored}, endsAt(kEnd));
  EXPECT_TRUE(named.resumed);
  EXPECT_TRUE(named.continues);
  EXPECT_EQ(named.session.id, stored.id);
  EXPECT_EQ(named.session.start, kStart);
}

TEST(SessionNamer, ResumesNoOtherRobotRecordingOrTime) {
  SessionNamer before("lisa"), other_robot("marge");
  const Session stored = before.begin("monday", kStart).session;
  EXPECT_FALSE(other_robot.begin("monday", kStart, {stored}, endsAt(kStart)).resumed);
  SessionNamer namer("lisa");
  EXPECT_FALSE(namer.begin("tuesday", kStart, {stored}, endsAt(kStart)).resumed);
  EXPECT_FALSE(namer.begin("monday", kStart + 1, {stored}, endsAt(kEnd)).resumed);
}

TEST(SessionNamer, ResumesASessionOnce) {
  SessionNamer before("lisa");
  const Session stored = before.begin("monday", kStart).session;
  SessionNamer namer("lisa");
  EXPECT_TRUE(namer.begin("monday", kEnd, {stored}, endsAt(kEnd)).resumed);
  EXPECT_FALSE(namer.begin("monday", kEnd, {stored}, endsAt(kEnd)).resumed);
}

TEST(SessionNamer, ReservedIdsAreNotUsed) {
  SessionNamer namer("lisa");
  const auto id = makeSessionId({"lisa", "monday", kStart, ""});
  namer.reserve(id);
  EXPECT_TRUE(namer.isReserved(id));
  EXPECT_EQ(namer.begin("monday", kStart).session.recording, "monday (2)");
  namer.clear();
  EXPECT_EQ(namer.begin("monday", kStart).session.id, id);
}

TEST(SessionNamer, FollowsTheOdometryWhateverItsOwnNamesAre) {
  SessionNamer odometry("lisa"), stage("other");
  const auto named = odometry.begin("monday", kStart);
  const auto announced = toOdometrySession(named.session);
  const auto followed = stage.follow(*announced);
  EXPECT_EQ(followed.session, named.session);
  EXPECT_FALSE(followed.resumed);
  EXPECT_TRUE(stage.follow(*announced, {named.session}).resumed);
  EXPECT_TRUE(stage.isReserved(announced->id));
  EXPECT_NE(toOdometrySession(odometry.begin("monday", kStart).session)->id, announced->id) << "a second round";
}

}  // namespace
}  // namespace urban_nav_live
