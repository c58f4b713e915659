// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/printable.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

TEST(Printable, TextOfAnyLanguageStaysAsItIs) {
  for (const char* text :
       {"", "/camera/left/image_raw", "Z\xc3\xbcrich", "\xe6\xb8\xac\xe5\xae\x9a", "\xf0\x9f\xa4\x96"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreSpelt) {
  EXPECT_EQ(printable("/a\x1b]0;title\x07/b"), "/a\\x1b]0;title\\x07/b");
  EXPECT_EQ(printable("/a\r\n\t\x7f"), "/a\\x0d\\x0a\\x09\\x7f");
  EXPECT_EQ(printable("/a\xc2\x9b"
                      "2J"),
            "/a\\xc2\\x9b"
            "2J")
      << "CSI in eight bits, as UTF-8";
  EXPECT_EQ(printable(std::string_view("/a\0b", 4)), "/a\\x00b");
  EXPECT_EQ(printable("a\nb\tc\x1b", "\n\t"), "a\nb\tc\\x1b");
}

TEST(Printable, MarksThatTurnTheDirectionAreSpelt) {
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\xe2\\x80\\xae"
            "b");
  EXPECT_EQ(printable("a\xe2\x81\xa6"
                      "b\xe2\x80\xa8"),
            "a\\xe2\\x81\\xa6"
            "b\\xe2\\x80\\xa8");
}

TEST(Printable, BytesThatAreNoUtf8AreSpelt) {
  EXPECT_EQ(printable("\x9b"
                      "2J"),
            "\\x9b"
            "2J")
      << "CSI in eight bits";
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "longer than needed";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a pair of surrogates";
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80") << "beyond Unicode";
}

}  // namespace
}  // namespace urban_nav_core
