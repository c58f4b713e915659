// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/tables/depth_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {
namespace {

DepthView::Samples someSamples() {
  DepthView::Samples samples;
  samples.width = 7;
  samples.height = 5;
  for (int i = 0; i < 35; ++i) {
    samples.disparity.push_back(i % 6 == 5 ? 0.0F : 3.0F + 1.37F * static_cast<float>(i));
    samples.sigma.push_back(i % 6 == 5 ? 0.0F : 0.1F + 0.01F * static_cast<float>(i));
    samples.grey.push_back(static_cast<std::uint8_t>(255 - 3 * i));
  }
  return samples;
}

DepthView storedView(std::string packed) {
  DepthView view;
  view.packed = std::move(packed);
  return view;
}

TEST(DepthViews, ComeBackToAHundredthOfAPixel) {
  const DepthView::Samples samples = someSamples();
  const DepthView::Samples back = storedView(DepthView::pack(samples)).samples();
  ASSERT_EQ(back.width, 7);
  ASSERT_EQ(back.height, 5);
  for (std::size_t i = 0; i < 35; ++i) {
    EXPECT_NEAR(back.disparity[i], samples.disparity[i], 0.0079F);
    EXPECT_NEAR(back.sigma[i], samples.sigma[i], 0.0079F);
    EXPECT_EQ(back.grey[i], samples.grey[i]);
  }
}

TEST(DepthViews, HaveNoAnswerWhereNumbersAreNotFinite) {
  DepthView::Samples samples = someSamples();
  samples.disparity[1] = std::numeric_limits<float>::quiet_NaN();
  samples.sigma[2] = std::numeric_limits<float>::quiet_NaN();
  samples.sigma[3] = std::numeric_limits<float>::infinity();
  const DepthView::Samples back = storedView(DepthView::pack(samples)).samples();
  EXPECT_EQ(back.disparity[1], 0.0F);
  EXPECT_EQ(back.disparity[2], 0.0F);
  EXPECT_GT(back.sigma[3], 3.9F) << "the largest one";
}

TEST(DepthViews, SurviveAnything) {
  const std::string packed = DepthView::pack(someSamples()), plain = *inflated(packed, 1 << 20);
  for (const bool inside : {false, true}) {
    const auto result = urban_nav_core::testing::fuzzText({inside ? plain : packed}, [&](const std::string& text) {
      const DepthView::Samples samples = storedView(inside ? deflated(text) : text).samples();
      ASSERT_EQ(samples.disparity.size(),
                static_cast<std::size_t>(samples.width) * static_cast<std::size_t>(samples.height));
      for (const float disparity : samples.disparity) ASSERT_TRUE(std::isfinite(disparity));
    });
    EXPECT_EQ(result.failure, "");
    EXPECT_GT(result.accepted, 0);
    EXPECT_GT(result.refused, 0);
  }
}

}  // namespace
}  // namespace urban_nav_store
