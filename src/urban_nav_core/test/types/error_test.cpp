// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/error.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

TEST(UserError, ReadsAsOneSentence) {
  const UserError error(atLine("config.yaml", 12), "swf_vo.window = 0", "1...100000 (frames)");
  EXPECT_STREQ(error.what(), "config.yaml:12: swf_vo.window = 0: allowed 1...100000 (frames)");
  EXPECT_EQ(error.parts().where, "config.yaml:12");
}

TEST(UserError, LeavesEmptyPartsOut) {
  EXPECT_STREQ(UserError("a.bag", "is no bag", "").what(), "a.bag: is no bag");
  EXPECT_STREQ(UserError("", "no input", "").what(), "no input");
  EXPECT_STREQ(UserError("", "no input", "bags or folders").what(), "no input: allowed bags or folders");
}

TEST(DataError, IsAUserErrorThatCanBeToldApart) {
  try {
    throw DataError("a.bag", "no stereo images", "");
  } catch (const UserError& error) {
    EXPECT_NE(dynamic_cast<const DataError*>(&error), nullptr);
  }
}

TEST(UserError, PlaceWithoutALine) { EXPECT_EQ(atLine("a.txt", 0), "a.txt"); }

}  // namespace
}  // namespace urban_nav_core
