// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/bytes.hpp"

#include <gtest/gtest.h>

namespace urban_nav_store {
namespace {

TEST(Bytes, RoundTrip) {
  std::string bytes;
  appendInteger(bytes, 0xfedcba9876543210U);
  appendInteger32(bytes, 7);
  appendNumber(bytes, -0.1);
  appendFloat(bytes, 1e-30F);
  appendText(bytes, std::string("a\0b", 3));
  EXPECT_EQ(bytes.substr(0, 4), std::string("\x10\x32\x54\x76")) << "little-endian";
  ByteReader reader(bytes);
  EXPECT_EQ(reader.integer(), 0xfedcba9876543210U);
  EXPECT_EQ(reader.integer32(), 7U);
  EXPECT_EQ(reader.number(), -0.1);
  EXPECT_EQ(reader.real32(), 1e-30F);
  EXPECT_FALSE(reader.complete());
  EXPECT_EQ(reader.text(), std::string_view("a\0b", 3));
  EXPECT_TRUE(reader.complete());
}

TEST(Bytes, NothingIsReadAfterTheEnd) {
  std::string bytes;
  appendText(bytes, "words");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader reader(std::string_view(bytes).substr(0, size));
    EXPECT_EQ(reader.text(), "");
    EXPECT_FALSE(reader.ok());
    EXPECT_EQ(reader.integer32(), 0U) << "all later reads fail";
    EXPECT_FALSE(reader.complete());
  }
  bytes.clear();
  appendInteger(bytes, ~std::uint64_t{0});
  ByteReader reader(bytes);
  EXPECT_EQ(reader.text(), "");
  EXPECT_FALSE(reader.ok());
}

}  // namespace
}  // namespace urban_nav_store
