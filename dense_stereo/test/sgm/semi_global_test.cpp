// SPDX-License-Identifier: BSD-3-Clause
#include "sgm/semi_global.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sgm/bytes.hpp"
#include "support/padded_images.hpp"

namespace dense_stereo {
namespace {

using testing_support::noiseImage;
using testing_support::shiftedImage;

template <typename V>
Winners matchedBy(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, int disparities) {
  SemiGlobal<V> matcher;
  matcher.resize(left.width(), left.height(), disparities);
  Winners winners;
  matcher.match(left, right, Penalties{}, winners);
  return winners;
}

template <typename T>
bool sameRows(const Padded<T>& a, const Padded<T>& b) {
  for (int v = 0; v < a.height(); ++v)
    if (!std::equal(a.row(v), a.row(v) + a.width(), b.row(v))) return false;
  return true;
}

TEST(SemiGlobal, VectorsGiveTheBytesOfPlainCode) {
  for (const int disparities : {16, 48, 64, 128, 256, 272, 512}) {
    const auto right = noiseImage(141, 19, 3), left = shiftedImage(right, 11);
    const Winners fast = matchedBy<Bytes>(left, right, disparities),
                  plain = matchedBy<PlainBytes>(left, right, disparities);
    EXPECT_TRUE(sameRows(fast.disparity, plain.disparity)) << disparities;
    EXPECT_TRUE(sameRows(fast.cost, plain.cost)) << disparities;
    EXPECT_TRUE(sameRows(fast.rival, plain.rival)) << disparities;
  }
}

TEST(SemiGlobal, FindsOneShiftWhereBothImagesShowTheScene) {
  const int shift = 11;
  const auto right = noiseImage(160, 24, 5), left = shiftedImage(right, shift);
  const Winners winners = matchedBy<Bytes>(left, right, 64);
  for (int v = 0; v < left.height(); ++v)
    for (int u = 2 * shift; u < left.width() - 4; ++u) ASSERT_EQ(winners.disparity.row(v)[u], shift) << u << " " << v;
}

TEST(SemiGlobal, FindsDisparitiesThatDoNotFitAByte) {
  for (const int shift : {254, 255, 256, 300, 505}) {
    const auto right = noiseImage(900, 12, 5), left = shiftedImage(right, shift);
    const Winners winners = matchedBy<Bytes>(left, right, 512);
    for (int v = 0; v < left.height(); ++v)
      for (int u = shift + 20; u < left.width() - 4; ++u)
        ASSERT_EQ(winners.disparity.row(v)[u], shift) << u << " " << v;
  }
}

TEST(SemiGlobal, AnswersTheLeftMarginWithDisparitiesInsideTheRightImage) {
  const auto right = noiseImage(160, 24, 5), left = shiftedImage(right, 11);
  const Winners winners = matchedBy<Bytes>(left, right, 64);
  for (int v = 0; v < left.height(); ++v)
    for (int u = 0; u < 63; ++u)
      ASSERT_TRUE(winners.disparity.row(v)[u] == Winners::kInvalid || winners.disparity.row(v)[u] <= u);
}

TEST(SemiGlobal, TheRivalCostsMoreThanTheWinner) {
  const auto right = noiseImage(160, 24, 5), left = shiftedImage(right, 11);
  const Winners winners = matchedBy<Bytes>(left, right, 64);
  for (int v = 0; v < left.height(); ++v)
    for (int u = 20; u < left.width(); ++u) ASSERT_GT(winners.rival.row(v)[u], winners.cost.row(v)[u]);
}

}  // namespace
}  // namespace dense_stereo
