// SPDX-License-Identifier: BSD-3-Clause
#include "map/bag_checkpoint.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr urban_nav_core::StampNs kEnd = 100'000'000'000;

TEST(BagCheckpointTest, ComesBack) {
  const BagCheckpoint state{{"a", "b"}, kEnd, "reader", {{"swf_vo", "vo"}, {"places", ""}}};
  const std::string bytes = packBagCheckpoint(state);
  const BagCheckpoint back = unpackBagCheckpoint(bytes);
  EXPECT_EQ(back.bags, state.bags);
  EXPECT_EQ(back.receipt, kEnd);
  EXPECT_EQ(back.reader, "reader");
  EXPECT_EQ(back.stages, state.stages);
  EXPECT_EQ(back.state("swf_vo"), "vo");
  EXPECT_EQ(back.state("lasers"), "");
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_THROW(unpackBagCheckpoint(bytes.substr(0, i)), urban_nav_core::DataError) << i;
}

TEST(BagCheckpointTest, ReadsTheVersionWithVisualOdometryOnly) {
  urban_nav_core::Archive archive;
  std::vector<std::string> bags = {"a"};
  urban_nav_core::StampNs receipt = kEnd;
  std::string reader = "reader", vo = "vo";
  archive(bags, receipt, reader, vo);
  const BagCheckpoint back = unpackBagCheckpoint(urban_nav_core::seal("map at the end of a bag", 1, archive.take()));
  EXPECT_EQ(back.bags, bags);
  EXPECT_EQ(back.receipt, kEnd);
  EXPECT_EQ(back.reader, "reader");
  EXPECT_EQ(back.stages, (std::vector<BagCheckpoint::StageState>{{"swf_vo", "vo"}}));
}

TEST(BagCheckpointTest, KnowsWhichNamesArePartsOfASplitRecording) {
  for (const char* name : {"drive_0.bag", "/a.b/drive_12.bag", "prefix_2026-11-30-14-05-00_3.bag", "rec_0.mcap",
                           "rec_1.db3", "drive_0.bag.zst", "2026-11-30-14-05-00_0.bag"})
    EXPECT_TRUE(isPartOfSplit(name)) << name;
  for (const char* name : {"drive.bag", "day2.bag", "prefix_2026-11-30-14-05-00.bag", "/rec_0/drive.bag", "_.bag",
                           "7.bag", "drive_0x.bag", "drive_.bag", ""})
    EXPECT_FALSE(isPartOfSplit(name)) << name;
}

TEST(BagCheckpointTest, DetectsConsecutiveBags) {
  const BagCheckpoint state{{"a", "b"}, kEnd, "", {}};
  const auto covered = [&](const std::vector<std::string>& bags, double seconds) {
    return coveredBags(state, bags, kEnd + static_cast<urban_nav_core::StampNs>(1e9 * seconds));
  };
  EXPECT_EQ(covered({"a", "b"}, -20.0), 2U);
  EXPECT_EQ(covered({"a", "b", "c"}, -20.0), 2U);
  EXPECT_EQ(covered({"b", "c"}, -10.0), 1U);
  EXPECT_EQ(covered({"c", "d"}, 0.1), 0U);
  EXPECT_EQ(covered({"c"}, 4.9), 0U);
  EXPECT_FALSE(covered({"c"}, 5.0));
  EXPECT_FALSE(covered({"c"}, 0.0)) << "recorded at the same time";
  EXPECT_FALSE(covered({"a"}, -20.0)) << "the one after it is missing";
  EXPECT_FALSE(covered({}, 1.0)) << "a folder";
}

}  // namespace
}  // namespace urban_nav
