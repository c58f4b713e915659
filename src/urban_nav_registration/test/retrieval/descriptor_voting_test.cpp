// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/retrieval/descriptor_voting.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::testing::lookingAlong;

TEST(DescriptorVoting, FindsTheViewThatWasTakenNearby) {
  urban_nav_registration::testing::Photographer street(urban_nav_core::testing::texturedStreet());
  DescriptorVoting finder(street.camera());
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(finder.add(street.keyframe(lookingAlong({4.0 + 5.0 * i, 0.0, 1.2}, 0.0))));
  for (const int wanted : {1, 3, 6}) {
    const auto found = finder.find(street.keyframe(lookingAlong({3.2 + 5.0 * wanted, 0.5, 1.2}, 0.1), 0.8), 3);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].view, static_cast<std::size_t>(wanted));
    EXPECT_GT(found[0].score, 1.5 * found[1].score);
  }
}

TEST(DescriptorVoting, StandsViewsOfNothing) {
  urban_nav_registration::testing::Photographer street(urban_nav_core::testing::texturedStreet());
  DescriptorVoting finder(street.camera());
  EXPECT_TRUE(finder.find(street.keyframe(lookingAlong({4.0, 0.0, 1.2}, 0.0)), 3).empty());
  EXPECT_FALSE(finder.add(Keyframe()));
  EXPECT_TRUE(finder.add(street.keyframe(lookingAlong({4.0, 0.0, 1.2}, 0.0))));
  EXPECT_EQ(finder.size(), 2U);
  EXPECT_TRUE(finder.find(Keyframe(), 3).empty());
  EXPECT_EQ(finder.find(street.keyframe(lookingAlong({4.2, 0.0, 1.2}, 0.0)), 3).front().view, 1U);
}

}  // namespace
}  // namespace urban_nav_registration
