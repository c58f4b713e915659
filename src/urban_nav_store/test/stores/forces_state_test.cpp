// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/forces_state.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "urban_nav_store/digest.hpp"

namespace urban_nav_store {
namespace {

TEST(ForcesState, ComeBackToTheLastBit) {
  const std::vector<urban_nav_core::SpecificForce> forces = {{5, {0.1, 0.2, 9.8}}, {7, {-0.1, 1e-9, 9.7}}};
  const auto back = unpackForces(packForces(forces));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 2u);
  EXPECT_EQ((*back)[1].stamp, 7);
  EXPECT_EQ((*back)[1].force, forces[1].force);
  EXPECT_TRUE(unpackForces(packForces({})).value().empty());
}

TEST(ForcesState, WhatIsNotWholeIsNothing) {
  const std::string whole = packForces({{5, {0.1, 0.2, 9.8}}, {7, {-0.1, 1e-9, 9.7}}});
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(unpackForces(whole.substr(0, size))) << size;
  EXPECT_FALSE(unpackForces(whole.substr(1)));
  EXPECT_FALSE(unpackForces(whole + "x"));
}

/// Returns the bytes of version 1: its number (4 bytes), the number of forces (8), then stamp and three numbers of each
/// (8 bytes each); little-endian.
std::string versionOne() {
  std::string bytes;
  const auto integer = [&](std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffU);
  };
  const auto number = [&](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    integer(bits, 8);
  };
  integer(1, 4);
  integer(2, 8);
  integer(5, 8);
  for (const double value : {0.5, -0.25, 9.75}) number(value);
  integer(7, 8);
  for (const double value : {-0.5, 1e-9, 9.5}) number(value);
  return bytes;
}

TEST(ForcesState, Version1IsRead) {
  const std::string bytes = versionOne();
  ASSERT_EQ(urban_nav_store::sha256(bytes), "3a27bd5842754495ee2b45b9671d56787bb2d3a26e083080e9424f4ff3e78d40")
      << "as the program of that version wrote them";
  const auto forces = unpackForces(bytes);
  ASSERT_TRUE(forces);
  ASSERT_EQ(forces->size(), 2u);
  EXPECT_EQ((*forces)[0].stamp, 5);
  EXPECT_EQ((*forces)[0].force, Eigen::Vector3d(0.5, -0.25, 9.75));
  EXPECT_EQ((*forces)[1].stamp, 7);
  EXPECT_EQ((*forces)[1].force, Eigen::Vector3d(-0.5, 1e-9, 9.5));
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(unpackForces(bytes.substr(0, size))) << size;
  EXPECT_FALSE(unpackForces(bytes + "x"));
  std::string many = bytes;
  many[10] = '\x7f';  // a number of forces that exceeds any memory
  EXPECT_FALSE(unpackForces(many));
  std::string newer = bytes;
  newer[0] = '\2';
  EXPECT_FALSE(unpackForces(newer));
}

}  // namespace
}  // namespace urban_nav_store
