// SPDX-License-Identifier: BSD-3-Clause
#include "live/recent_scans.hpp"

#include <gtest/gtest.h>

namespace urban_nav_localization {
namespace {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;

constexpr StampNs scan_second = 1'000'000'000;

Scan scanAt(StampNs stamp) {
  Scan scan;
  scan.stamp = stamp;
  return scan;
}

std::vector<StampNs> listStamps(const RecentScans& scans, StampNs first, StampNs last) {
  std::vector<StampNs> stamps;
  for (const auto& laser : scans.lasers())
    laser.forEach(first, last, [&](const Scan& scan) { stamps.push_back(scan.stamp); });
  return stamps;
}

TEST(RecentScans, GivesAStretchWithBothEnds) {
  RecentScans scans;
  for (int i = 1; i <= 5; ++i) scans.add("left", scanAt(i * scan_second));
  EXPECT_TRUE(scans.lasers().empty()) << "no pose yet";
  EXPECT_EQ(scans.unplaced(), std::vector<std::string>{"left"});
  scans.setLaser("left", urban_nav_core::Pose());
  EXPECT_TRUE(scans.unplaced().empty());
  EXPECT_EQ(listStamps(scans, 2 * scan_second, 4 * scan_second),
            (std::vector<StampNs>{2 * scan_second, 3 * scan_second, 4 * scan_second}));
  EXPECT_TRUE(listStamps(scans, 6 * scan_second, 9 * scan_second).empty());
}

TEST(RecentScans, IgnoresRepeatedAndLateScans) {
  RecentScans scans;
  scans.setLaser("left", urban_nav_core::Pose());
  for (const StampNs stamp : {10 * scan_second, 10 * scan_second, 10 * scan_second - scan_second / 2, 11 * scan_second})
    scans.add("left", scanAt(stamp));
  EXPECT_EQ(listStamps(scans, 0, 20 * scan_second), (std::vector<StampNs>{10 * scan_second, 11 * scan_second}));
}

TEST(RecentScans, DropsScansFromBeforeAJumpBack) {
  RecentScans scans;
  scans.setLaser("left", urban_nav_core::Pose());
  scans.add("left", scanAt(100 * scan_second));
  scans.add("left", scanAt(5 * scan_second));
  EXPECT_EQ(listStamps(scans, 0, 200 * scan_second), (std::vector<StampNs>{5 * scan_second}));
}

TEST(RecentScans, KeepsTheLastMinute) {
  RecentScans scans;
  scans.setLaser("left", urban_nav_core::Pose());
  for (int i = 1; i <= 100; ++i) scans.add("left", scanAt(i * scan_second));
  const std::vector<StampNs> stamps = listStamps(scans, 0, 200 * scan_second);
  ASSERT_FALSE(stamps.empty());
  EXPECT_EQ(stamps.front(), 40 * scan_second);
  EXPECT_EQ(stamps.back(), 100 * scan_second);
}

}  // namespace
}  // namespace urban_nav_localization
