// SPDX-License-Identifier: BSD-3-Clause
#include "map/learnt_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;
using urban_nav_store::PlaceLink;

/// Closure that loop_metric has measured, 1 m along the path.
MetricClosure closureOfOnePlace(const PoseRef& a, const PoseRef& b) {
  MetricClosure closure;
  closure.a = a;
  closure.b = b;
  closure.method = ClosureMethod::Stereo;
  closure.verdict = ClosureVerdict::Accepted;
  closure.measured.T_a_b =
      urban_nav_core::Pose(Eigen::Quaterniond::Identity(), urban_nav_core::Vector3d(1.0, 0.0, 0.0));
  closure.measured.information.setIdentity();
  closure.evidence = "of loop_metric";
  return closure;
}

/// Three days at one site; names as closures.csv has them, and ids.
class LearntLinks : public ::testing::Test {
 protected:
  LearntLinks() {
    context.names = {"day", "dusk", "night"};
    context.previous.ids = {"id_day", "id_dusk", "id_night"};
    context.previous.runs.resize(3);
    context.joins = context.divides = true;
  }
  /// Adds a closure with the verdict of the pose graph on it.
  void add(const MetricClosure& closure, ClosureVerdict verdict) {
    closures.push_back(closure);
    assessments.push_back({static_cast<std::int64_t>(closures.size()), verdict, "", 1.0});
  }
  std::vector<PlaceLink> links() const { return linksOfGraph(context, closures, assessments); }

  const MapOptions options;
  Console console;
  MapContext context{options, console};
  std::vector<MetricClosure> closures;
  std::vector<ClosureAssessment> assessments;
};

TEST_F(LearntLinks, OnlyWhatGeometryAndTheGraphAcceptTeaches) {
  add(closureOfOnePlace({"day", 1}, {"dusk", 101}), ClosureVerdict::Accepted);
  MetricClosure rejected = closureOfOnePlace({"day", 2}, {"dusk", 102});
  rejected.verdict = ClosureVerdict::Rejected;
  add(rejected, ClosureVerdict::Rejected);
  MetricClosure of_file = closureOfOnePlace({"day", 3}, {"dusk", 103});
  of_file.evidence.clear();
  add(of_file, ClosureVerdict::Accepted);
  add(closureOfOnePlace({"day", 4}, {"dusk", 104}), ClosureVerdict::Waiting);
  add(closureOfOnePlace({"day", 5}, {"elsewhere", 105}), ClosureVerdict::Accepted);
  add(closureOfOnePlace({"day", 6}, {"dusk", 106}), ClosureVerdict::Rejected);
  const std::vector<PlaceLink> found = links();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].session, "id_dusk");
  EXPECT_EQ(found[0].stamp, 101);
  EXPECT_EQ(found[0].earlier, "id_day");
  EXPECT_EQ(found[0].earlier_stamp, 1);
  EXPECT_EQ(found[0].metres, 1.0);
  EXPECT_EQ(found[0].accepted, 1);
  EXPECT_EQ(found[1].stamp, 106);
  EXPECT_EQ(found[1].accepted, 0) << "withdrawn";
  const auto learnt = linksToLearn(context, found);
  ASSERT_TRUE(learnt);
  ASSERT_EQ(learnt->size(), 1U);
  EXPECT_EQ(learnt->front().stamp, 101);
}

TEST_F(LearntLinks, DoNotDependOnTheOrderOfClosures) {
  for (const urban_nav_core::StampNs t : {7, 3, 5}) {
    add(closureOfOnePlace({"dusk", 100 + t}, {"night", 200 + t}), ClosureVerdict::Accepted);
    add(closureOfOnePlace({"day", t}, {"night", 200 + t}), ClosureVerdict::Accepted);
    add(closureOfOnePlace({"day", t}, {"dusk", 100 + t}), ClosureVerdict::Accepted);
  }
  MetricClosure by_laser = closures.front();  // the same poses: one link, as accepted as the better of both
  by_laser.method = ClosureMethod::Icp;
  add(by_laser, ClosureVerdict::Rejected);
  const std::vector<PlaceLink> once = links();
  std::reverse(closures.begin(), closures.end());
  std::reverse(assessments.begin(), assessments.end());
  const std::vector<PlaceLink> again = links();
  ASSERT_EQ(once.size(), 9U);
  ASSERT_EQ(again.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(again[i].session, once[i].session) << i;
    EXPECT_EQ(again[i].stamp, once[i].stamp) << i;
    EXPECT_EQ(again[i].earlier, once[i].earlier) << i;
    EXPECT_EQ(again[i].earlier_stamp, once[i].earlier_stamp) << i;
    EXPECT_EQ(again[i].accepted, 1) << i;
  }
}

TEST_F(LearntLinks, PlacesAreRecognisedAgainOnlyIfASessionFollows) {
  add(closureOfOnePlace({"day", 1}, {"night", 201}), ClosureVerdict::Accepted);
  EXPECT_FALSE(linksToLearn(context, links())) << "night is the last session";
  add(closureOfOnePlace({"day", 1}, {"day", 9}), ClosureVerdict::Accepted);
  ASSERT_TRUE(linksToLearn(context, links())) << "a place of one session, for the next";
  context.groups = {0, 1, 1};
  EXPECT_FALSE(linksToLearn(context, links())) << "day is a map of its own";
  context.groups.clear();
  context.divides = false;
  EXPECT_FALSE(linksToLearn(context, links())) << "a run that does not find all closures of its sessions";
}

// Each repetition has fewer links, so it ends.
TEST_F(LearntLinks, WhatTheGraphWithdrawsLaterIsLeftOut) {
  add(closureOfOnePlace({"day", 1}, {"dusk", 101}), ClosureVerdict::Accepted);
  add(closureOfOnePlace({"day", 2}, {"dusk", 102}), ClosureVerdict::Accepted);
  context.learnt = linksToLearn(context, links());
  ASSERT_TRUE(context.learnt);
  EXPECT_FALSE(linksToLearn(context, links())) << "all are still accepted: final";
  assessments[0].verdict = ClosureVerdict::Rejected;
  context.learnt = linksToLearn(context, links());
  ASSERT_TRUE(context.learnt);
  ASSERT_EQ(context.learnt->size(), 1U);
  EXPECT_EQ(context.learnt->front().stamp, 102);
  assessments[0].verdict = ClosureVerdict::Accepted;
  EXPECT_FALSE(linksToLearn(context, links())) << "links do not come back";
}

TEST_F(LearntLinks, TheStoreKeepsAcceptedOnesAndWithdrawsThem) {
  const urban_nav_input::testing::TemporaryFolder folder;
  urban_nav_store::Store store(folder.file("links.db"), urban_nav_store::Access::Write);
  for (const std::string& id : context.previous.ids)
    store.sessions().put(urban_nav_store::Session{id, id, "", "", 0, true});
  add(closureOfOnePlace({"day", 1}, {"dusk", 101}), ClosureVerdict::Accepted);
  add(closureOfOnePlace({"day", 2}, {"dusk", 102}), ClosureVerdict::Rejected);
  storeLinks(store, links());
  const urban_nav_store::TableStore<PlaceLink> table(store);
  std::vector<std::int64_t> accepted;
  const auto read = [&] {
    accepted.clear();
    table.forEach("id_dusk", [&](const PlaceLink& link) { accepted.push_back(link.accepted); });
  };
  read();
  EXPECT_EQ(accepted, std::vector<std::int64_t>{1}) << "one that was never accepted is not stored";
  assessments[0].verdict = ClosureVerdict::Rejected;
  storeLinks(store, links());
  read();
  EXPECT_EQ(accepted, std::vector<std::int64_t>{0});
  context.store = &store;
  context.joins = false;  // all three are previous sessions, whose places are known
  EXPECT_TRUE(knownLinks(context).empty());
  assessments[0].verdict = ClosureVerdict::Accepted;
  storeLinks(store, links());
  EXPECT_EQ(knownLinks(context).size(), 1U);
  context.joins = true;
  EXPECT_TRUE(knownLinks(context).empty()) << "places of all sessions are recognised again";
}

}  // namespace
}  // namespace urban_nav
