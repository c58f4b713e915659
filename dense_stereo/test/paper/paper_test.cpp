// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "dense_stereo/dense_stereo.hpp"
#include "dense_stereo/near_scene.hpp"
#include "dense_stereo_paper/paper_matcher.hpp"
#include "paper/log_filter.hpp"
#include "paper/supporting_windows.hpp"
#include "paper/words.hpp"
#include "support/padded_images.hpp"
#include "support/surfaces.hpp"
#include "urban_nav_core/types/error.hpp"

namespace dense_stereo {
namespace {

using testing_support::noiseImage;
using testing_support::shiftedImage;
using testing_support::SlantedPair;

Padded<std::uint8_t> filteredNoise(unsigned seed) {
  Padded<std::uint8_t> filtered;
  LogFilter().apply(noiseImage(70, 30, seed), filtered);
  return filtered;
}

/// Sum of absolute differences over the window around a pixel, by its definition.
int windowSum(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, int u, int v, int d) {
  const int x = std::clamp(u, 0, left.width() - 1), y = std::clamp(v, 0, left.height() - 1);
  int sum = 0;
  for (int dv = -5; dv <= 5; ++dv)
    for (int du = -5; du <= 5; ++du) {
      const int column = std::clamp(x + du, 0, left.width() - 1);
      sum += std::abs(left.clampedRow(y + dv)[column] - right.clampedRow(y + dv)[std::max(column - d, 0)]);
    }
  return sum;
}

TEST(SupportingWindows, SumThePixelsWindowAndTheBestTwoOfFour) {
  const auto left = filteredNoise(1), right = filteredNoise(2);
  SupportingWindows<Words> windows;
  windows.begin(left, right, 32);
  for (int v = 0; v < left.height(); ++v) {
    const ScoreRow row = windows.next();
    for (int u = 0; u < left.width(); u += 7)
      for (int d = 0; d < 32; d += 5) {
        if (d > u) {
          ASSERT_EQ(row.scores[u * 32 + d], 65535);
          continue;
        }
        std::vector<int> corners{windowSum(left, right, u - 5, v - 5, d), windowSum(left, right, u + 5, v - 5, d),
                                 windowSum(left, right, u - 5, v + 5, d), windowSum(left, right, u + 5, v + 5, d)};
        std::sort(corners.begin(), corners.end());
        ASSERT_EQ(row.scores[u * 32 + d], windowSum(left, right, u, v, d) + corners[0] + corners[1]) << u << " " << v;
      }
  }
}

TEST(SupportingWindows, VectorsGiveTheNumbersOfPlainCode) {
  const auto left = filteredNoise(3), right = filteredNoise(4);
  SupportingWindows<Words> fast;
  SupportingWindows<PlainWords> plain;
  fast.begin(left, right, 48);
  plain.begin(left, right, 48);
  for (int v = 0; v < left.height(); ++v) {
    const ScoreRow a = fast.next(), b = plain.next();
    ASSERT_TRUE(std::equal(a.scores, a.scores + 70 * 48, b.scores)) << v;
    ASSERT_TRUE(std::equal(a.right_disparity, a.right_disparity + 70, b.right_disparity)) << v;
  }
}

TEST(LogFilter, IgnoresBrightnessAndMarksSpots) {
  Padded<std::uint8_t> image, filtered, brighter;
  image.resize(40, 20);
  image.fill(90);
  image.row(10)[20] = 130;
  extendRows(image);
  LogFilter filter;
  filter.apply(image, filtered);
  EXPECT_EQ(filtered.row(2)[2], 128);
  EXPECT_LT(filtered.row(10)[20], 128);
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 40; ++u) image.row(v)[u] = static_cast<std::uint8_t>(image.row(v)[u] + 50);
  extendRows(image);
  filter.apply(image, brighter);
  for (int v = 0; v < 20; ++v) ASSERT_TRUE(std::equal(filtered.row(v), filtered.row(v) + 40, brighter.row(v)));
}

TEST(PaperMethod, IsThatOfTheMatcherHandedIn) {
  const SlantedPair scene(160, 100, 12.3, 0.02, 0.03, 1.0);
  Parameters parameters;
  EXPECT_EQ(makePaperMatcher(parameters), nullptr) << "the stage's own method";
  parameters.method = "paper";
  EXPECT_THROW(DenseStereo{parameters}, urban_nav_core::UserError) << "without its matcher";
  EXPECT_THROW(NearSceneEstimator(parameters, urban_nav_core::StereoCamera()), urban_nav_core::UserError);
  DenseStereo paper(parameters, makePaperMatcher(parameters)), own{Parameters()};
  EXPECT_NE(paper.process(scene.pair()).image.disparity, own.process(scene.pair()).image.disparity);
}

TEST(PaperMethod, MeasuresAPlaneToAQuarterOfAPixel) {
  const SlantedPair scene(200, 120, 20.3, 0.02, 0.03, 1.0);
  Parameters parameters;
  parameters.method = "paper";
  DenseStereo stereo(parameters, makePaperMatcher(parameters));
  const StereoResult& result = stereo.process(scene.pair());
  EXPECT_GT(result.answered, 0.6);
  int good = 0, all = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 40; u < 200; ++u) {
      if (!result.image.isValid(u, v)) continue;
      ++all;
      good +=
          std::abs(static_cast<double>(result.image.disparity[result.image.index(u, v)]) - scene.disparity(u, v)) < 0.25
              ? 1
              : 0;
    }
  EXPECT_GT(good, 0.9 * all);
}

}  // namespace
}  // namespace dense_stereo
