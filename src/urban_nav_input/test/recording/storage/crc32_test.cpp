// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/crc32.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <vector>

namespace urban_nav_input {
namespace {

TEST(Crc32, IsThatOfZlibAtEverySizeAndPlace) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes(2000);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  for (std::size_t size = 0; size < 700; ++size) {
    const std::size_t at = random() % 1000;
    const std::uint32_t before = random() % 2 == 0 ? 0 : static_cast<std::uint32_t>(random());
    EXPECT_EQ(crc32({bytes.data() + at, size}, before), ::crc32_z(before, bytes.data() + at, size)) << size;
  }
}

}  // namespace
}  // namespace urban_nav_input
