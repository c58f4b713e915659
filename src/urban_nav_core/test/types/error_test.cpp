// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/error.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace urban_nav_core {
namespace {

TEST(UserError, ReadsAsOneSentence) {
  const UserError error(atLine("config.yaml", 12), "swf_vo.window = 0", "allowed 1...100000 (frames)");
  EXPECT_STREQ(error.what(), "config.yaml:12: swf_vo.window = 0: allowed 1...100000 (frames)");
  EXPECT_EQ(error.parts().where, "config.yaml:12");
}

TEST(UserError, LeavesEmptyPartsOut) {
  EXPECT_STREQ(UserError("a.bag", "is no bag", "").what(), "a.bag: is no bag");
  EXPECT_STREQ(UserError("", "no input", "").what(), "no input");
  EXPECT_STREQ(UserError("", "no input", "bags or folders").what(), "no input: expected bags or folders");
}

TEST(Error, KindsAreSiblings) {
  static_assert(std::is_base_of_v<Error, UserError> && std::is_base_of_v<Error, DataError>);
  static_assert(!std::is_convertible_v<DataError*, UserError*> && !std::is_convertible_v<UserError*, DataError*>);
  static_assert(!std::is_constructible_v<Error, std::string, std::string, std::string>, "one of its kinds is thrown");
  EXPECT_THROW(throw DataError("a.bag", "no stereo images", ""), DataError);
  EXPECT_THROW(throw UserError("a.bag", "is no bag", ""), UserError);
}

TEST(Error, CatchesEitherKindWithItsParts) {
  const auto toParts = [](const auto& error) {
    try {
      throw error;
    } catch (const Error& caught) {
      return std::string(caught.what()) + "|" + caught.parts().where + "|" + caught.parts().found;
    }
  };
  EXPECT_EQ(toParts(DataError("a.bag", "no stereo images", "")), "a.bag: no stereo images|a.bag|no stereo images");
  EXPECT_EQ(toParts(UserError("a.bag", "is no bag", "")), "a.bag: is no bag|a.bag|is no bag");
}

TEST(Error, BecomesTheOtherKindByItsParts) {
  const UserError user("evidence:2", "one cell", "three");
  EXPECT_STREQ(DataError(user.parts()).what(), user.what());
}

TEST(UserError, PlaceWithoutALine) { EXPECT_EQ(atLine("a.txt", 0), "a.txt"); }

}  // namespace
}  // namespace urban_nav_core
