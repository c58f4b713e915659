// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/topic_monitor.hpp"

#include <gtest/gtest.h>

namespace urban_nav_live {
namespace {

constexpr urban_nav_core::StampNs kMs = 1'000'000;

/// Monitor with a clock set by the test.
struct Monitored {
  TopicMonitor::Clock::time_point now{};
  TopicMonitor monitor{[this] { return now; }};
  void wait(double seconds) {
    now += std::chrono::duration_cast<TopicMonitor::Clock::duration>(std::chrono::duration<double>(seconds));
  }
};

TEST(TopicMonitor, NamesTopicsThatHaveNotArrived) {
  Monitored m;
  m.monitor.expect("/a", 1.0);
  m.monitor.expect("/b", 1.0);
  m.monitor.expect("/c", 1.0, "scans");
  EXPECT_EQ(m.monitor.fault(), "/a has not been received yet, /b has not been received yet");
  m.monitor.received("/a");
  EXPECT_EQ(m.monitor.fault(), "/b has not been received yet");
  EXPECT_EQ(m.monitor.fault("scans"), "/c has not been received yet");
  m.monitor.received("/b");
  EXPECT_EQ(m.monitor.fault(), "");
  EXPECT_EQ(m.monitor.fault("unknown"), "");
}

TEST(TopicMonitor, NamesTopicsThatFellSilent) {
  Monitored m;
  m.monitor.expect("/a", 1.0);
  m.monitor.expect("/info");
  m.monitor.received("/a");
  m.monitor.received("/info");
  m.wait(1.0);
  EXPECT_EQ(m.monitor.fault(), "");
  m.wait(11.0);
  EXPECT_EQ(m.monitor.fault(), "/a has been silent for 12.0 s");
  m.monitor.received("/a");
  EXPECT_EQ(m.monitor.fault(), "");
}

TEST(TopicMonitor, IgnoresTopicsThatAreNotMonitored) {
  Monitored m;
  m.monitor.received("/a");
  m.monitor.expectPairs("/a", "/b");
  m.monitor.setIncomplete(true);
  EXPECT_EQ(m.monitor.fault(), "");
}

TEST(TopicMonitor, NamesTheLatePartnerOfAnIncompletePair) {
  Monitored m;
  m.monitor.expect("/left", 1.0);
  m.monitor.expect("/right", 1.0);
  m.monitor.expectPairs("/left", "/right");
  m.monitor.received("/left", 140 * kMs);
  m.monitor.received("/right", 100 * kMs);
  EXPECT_EQ(m.monitor.fault(), "");
  m.monitor.setIncomplete(true);
  EXPECT_EQ(m.monitor.fault(), "/right lags /left by 40 ms");
  m.monitor.received("/right", 190 * kMs);
  EXPECT_EQ(m.monitor.fault(), "/left lags /right by 50 ms");
  m.monitor.setIncomplete(false);
  m.wait(2.0);
  EXPECT_EQ(m.monitor.fault(), "/left has been silent for 2.0 s, /right has been silent for 2.0 s");
  m.monitor.received("/left", 2190 * kMs);
  EXPECT_EQ(m.monitor.fault(), "/right lags /left by 2000 ms");
}

}  // namespace
}  // namespace urban_nav_live
