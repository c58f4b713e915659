// SPDX-License-Identifier: BSD-3-Clause
#include "live/recent_scans.hpp"

#include <gtest/gtest.h>

namespace urban_nav_localization {
namespace {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;

constexpr StampNs kScanSecond = 1'000'000'000;

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
  for (int i = 1; i <= 5; ++i) scans.add("left", scanAt(i * kScanSecond));
  EXPECT_TRUE(scans.lasers().empty()) << "no pose yet";
  EXPECT_EQ(scans.unplaced(), std::vector<std::string>{"left"});
  scans.setLaser("left", urban_nav_core::Pose());
  EXPECT_TRUE(scans.unplaced().empty());
  EXPECT_EQ(listStamps(scans, 2 * kScanSecond, 4 * kScanSecond),
            (std::vector<StampNs>{2 * kScanSecond, 3 * kScanSecond, 4 * kScanSecond}));
  EXPECT_TRUE(listStamps(scans, 6 * kScanSecond, 9 * kScanSecond).empty());
}

TEST(RecentScans, IgnoresRepeatedAndLateScans) {
  RecentScans scans;
  scans.setLaser("left", urban_nav_core::Pose());
  for (const StampNs stamp : {10 * kScanSecond, 10 * kScanSecond, 10 * kScanSecond - kScanSecond / 2, 11 * kScanSecond})
    scans.add("left", scanAt(stamp));
  EXPECT_EQ(listStamps(scans, 0, 20 * kScanSecond), (std::vector<StampNs>{10 * kScanSecond, 11 * kScanSecond}));
}

TEST(RecentScans, DropsScansFromBeforeAJumpBack) {
  RecentScans scans;
  scans.setLaser("left", urban_nav_core::Pose());
  scans.add("left", scanAt(100 * kScanSecond));
  scans.add("left", scanAt(5 * kScanSecond));
  EXPECT_EQ(listStamps(scans, 0, 200 * kScanSecond), (std::vector<StampNs>{5 * kScanSecond}));
}

TEST(RecentScans, KeepsTheLastMinute) {
  RecentScans scans;
  scans.setLaser("left", urban_nav_core::Pose());
  for (int i = 1; i <= 100; ++i) scans.add("left", scanAt(i * kScanSecond));
  const std::vector<StampNs> stamps = listStamps(scans, 0, 200 * kScanSecond);
  ASSERT_FALSE(stamps.empty());
  EXPECT_EQ(stamps.front(), 40 * kScanSecond);
  EXPECT_EQ(stamps.back(), 100 * kScanSecond);
}

}  // namespace
}  // namespace urban_nav_localization
