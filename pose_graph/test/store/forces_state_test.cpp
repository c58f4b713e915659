// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/forces_state.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/fuzz.hpp"

namespace pose_graph {
namespace {

TEST(ForcesState, comeBackToTheLastBit) {
  const std::vector<FeltForce> forces = {{5, {0.1, 0.2, 9.8}}, {7, {-0.1, 1e-9, 9.7}}};
  const auto back = unpackForces(packForces(forces));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 2u);
  EXPECT_EQ((*back)[1].stamp, 7);
  EXPECT_EQ((*back)[1].force, forces[1].force);
  EXPECT_TRUE(unpackForces(packForces({})).value().empty());
}

TEST(ForcesState, whatIsNotWholeIsNothing) {
  const std::string whole = packForces({{5, {0.1, 0.2, 9.8}}, {7, {-0.1, 1e-9, 9.7}}});
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(unpackForces(whole.substr(0, size))) << size;
  EXPECT_FALSE(unpackForces(whole.substr(1)));
  EXPECT_FALSE(unpackForces(whole + "x"));
  std::string many = whole;
  many[10] = '\x7f';  // of a number of forces that no memory holds
  EXPECT_FALSE(unpackForces(many));
}

}  // namespace
}  // namespace pose_graph
