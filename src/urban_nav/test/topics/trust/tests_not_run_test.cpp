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

  const urban_nav_input::testing::TemporaryFolder folder_;
  urban_nav_store::Store store_{folder_.file("s.db"), urban_nav_store::Access::Write};
  MapOptions options_;
  Console console_;
  MapContext context_{options_, console_};
};

TEST_F(TestsNotRun, AreAllListedWithAReasonWhateverWasRecorded) {
  for (const char* test : urban_nav_trust::kUnavailableTests) EXPECT_EQ(reason(test).rfind("no ", 0), 0U) << test;
  record("panorama0");
  for (const char* test : urban_nav_trust::kUnavailableTests) EXPECT_NE(reason(test), "not listed") << test;
}

TEST_F(TestsNotRun, AMissingSensorIsNotTheReasonWhereItWasRecorded) {
  EXPECT_EQ(reason("panorama_colour"), "no panoramas");
  record("panorama0");
  EXPECT_NE(reason("panorama_colour").find("no test"), std::string::npos) << reason("panorama_colour");
}

}  // namespace
}  // namespace urban_nav
