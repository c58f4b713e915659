// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/tests_not_run.hpp"

#include <gtest/gtest.h>

#include "pose_graph/parameters.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_trust/unavailable_tests.hpp"

namespace urban_nav {
namespace {

constexpr const char* kTrustSession = "aaaaaaaaaaaaaaaa";

class TestsNotRun : public ::testing::Test {
 protected:
  TestsNotRun() {
    options_.parameters.add(pose_graph::table());
    context_.sessions.emplace_back();
    context_.sessions.back().id = kTrustSession;
    context_.store = &store_;
    context_.relaxed = true;
    store_.sessions().put({kTrustSession, "monday", "", "", 0, true});
  }
  void record(const std::string& role) {
    context_.sessions.back().info.inputs.emplace_back();
    context_.sessions.back().info.inputs.back().role = role;
  }
  std::string reason(const std::string& test) const {
    for (const urban_nav_trust::AbsentMeasurement& absent : testsNotRun(context_))
      if (absent.name == test) return absent.reason;
    return "not listed";
  }
  void putPlane(urban_nav_core::StampNs at, urban_nav_core::ClosureVerdict verdict) {
    urban_nav_store::Edge edge;
    edge.a = {kTrustSession, 1};
    edge.b = {kTrustSession, at};
    edge.kind = urban_nav_store::EdgeKind::Plane;
    edge.source = "laser_mapper";
    edge.verdict = verdict;
    store_.graph().put(edge);
  }

  const urban_nav_input::testing::TemporaryFolder folder_;
  urban_nav_store::Store store_{folder_.file("s.db"), urban_nav_store::Access::Write};
  MapOptions options_;
  Console console_;
  MapContext context_{options_, console_};
};

TEST_F(TestsNotRun, AreAllListedWithAReasonWhateverWasRecorded) {
  for (const char* test : urban_nav_trust::kUnavailableTests) EXPECT_EQ(reason(test).rfind("no ", 0), 0U) << test;
  for (const char* role : {"left", "panorama0", "gps", "laser_left"}) record(role);
  for (const char* test : urban_nav_trust::kUnavailableTests) EXPECT_NE(reason(test), "not listed") << test;
}

TEST_F(TestsNotRun, AMissingSensorIsNotTheReasonWhereItWasRecorded) {
  EXPECT_EQ(reason("panorama_colour"), "no panoramas");
  EXPECT_EQ(reason("gps_position"), "no GPS fixes");
  EXPECT_EQ(reason("free_space"), "no lasers");
  for (const char* role : {"panorama0", "gps", "laser_left"}) record(role);
  EXPECT_NE(reason("panorama_colour").find("no test"), std::string::npos) << reason("panorama_colour");
  EXPECT_NE(reason("gps_position").find("no test"), std::string::npos) << reason("gps_position");
  EXPECT_NE(reason("free_space").find("no test"), std::string::npos) << reason("free_space");
}

TEST_F(TestsNotRun, WhatTookPartInTheResultIsNoTestOfIt) {
  record("gps");
  record("laser_left");
  options_.parameters.set("pose_graph.gps=true");
  EXPECT_NE(reason("gps_position").find("took part"), std::string::npos) << reason("gps_position");
  context_.relaxed = false;
  EXPECT_EQ(reason("gps_position").find("took part"), std::string::npos) << reason("gps_position");
  EXPECT_NE(reason("plane_passes").find("no plane"), std::string::npos) << reason("plane_passes");
  putPlane(2, urban_nav_core::ClosureVerdict::Accepted);
  putPlane(3, urban_nav_core::ClosureVerdict::Rejected);
  EXPECT_NE(reason("plane_passes").find("1 of 2 constraints"), std::string::npos) << reason("plane_passes");
}

}  // namespace
}  // namespace urban_nav
