// SPDX-License-Identifier: BSD-3-Clause
#include "refine/slanted_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "refine/floats.hpp"
#include "sgm/descriptors.hpp"
#include "support/surfaces.hpp"

namespace dense_stereo {
namespace {

using testing_support::SlantedPair;

/// Pair with its disparities rounded to integers, and depth edges nowhere or everywhere.
struct RoundedStart {
  Padded<std::uint8_t> left, right, edges;
  Padded<float> start;

  RoundedStart(const SlantedPair& scene, std::uint8_t edge) {
    const auto pair = scene.pair();
    copy(pair.left, left);
    copy(pair.right, right);
    edges.resize(left.width(), left.height());
    edges.fill(edge);
    start.resize(left.width(), left.height(), DisparityField::kInvalid);
    for (int v = 0; v < left.height(); ++v)
      for (int u = 0; u < left.width(); ++u) {
        const double d = scene.disparity(u, v);
        if (d <= u) start.row(v)[u] = static_cast<float>(std::lround(d));
      }
  }
  static void copy(const urban_nav_core::ImageView& from, Padded<std::uint8_t>& to) {
    to.resize(from.width, from.height);
    for (int v = 0; v < from.height; ++v) std::memcpy(to.row(v), from.row(v), static_cast<std::size_t>(from.width));
    extendRows(to);
  }
  template <typename V>
  DisparityField aligned(const Exposure& exposure = {}) const {
    SlantedAlignment<V> alignment;
    alignment.resize(left.width(), left.height());
    DisparityField field;
    alignment.step(left, right, exposure, edges, start, field);
    return field;
  }
};

double rmsError(const SlantedPair& scene, const Padded<float>& disparity) {
  double sum = 0.0;
  int count = 0;
  for (int v = 8; v < disparity.height() - 8; ++v)
    for (int u = 50; u < disparity.width() - 8; ++u) {
      if (disparity.row(v)[u] < 0.0F) continue;
      const double error = static_cast<double>(disparity.row(v)[u]) - scene.disparity(u, v);
      sum += error * error;
      ++count;
    }
  return std::sqrt(sum / count);
}

TEST(SlantedAlignment, VectorsGiveTheBitsOfPlainCode) {
  for (const std::uint8_t edge : {std::uint8_t{0}, std::uint8_t{255}}) {
    const RoundedStart start(SlantedPair(131, 47, 20.0, 0.05, 0.11, 1.0), edge);
    const DisparityField fast = start.aligned<Floats>({1.1F, -3.0F}), plain = start.aligned<PlainFloats>({1.1F, -3.0F});
    for (int v = 0; v < 47; ++v)
      for (int u = 0; u < 131; ++u) {
        ASSERT_EQ(fast.disparity.row(v)[u], plain.disparity.row(v)[u]) << u << " " << v;
        ASSERT_EQ(fast.noise.row(v)[u], plain.noise.row(v)[u]);
        ASSERT_EQ(fast.information.row(v)[u], plain.information.row(v)[u]);
      }
  }
}

TEST(SlantedAlignment, OneStepLeavesAFifthOfTheRounding) {
  for (const std::uint8_t edge : {std::uint8_t{0}, std::uint8_t{255}}) {
    const SlantedPair scene(200, 120, 20.4, 0.06, 0.12, 1.0);
    const RoundedStart start(scene, edge);
    EXPECT_GT(rmsError(scene, start.start), 0.25);
    EXPECT_LT(rmsError(scene, start.aligned<Floats>().disparity), 0.06);
  }
}

TEST(SlantedAlignment, HasNoPreferenceForWholePixels) {
  for (const double offset : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    const SlantedPair scene(200, 80, 20.0 + offset, 0.0, 0.0, 1.0);
    const DisparityField field = RoundedStart(scene, 0).aligned<Floats>();
    double sum = 0.0;
    for (int v = 8; v < 72; ++v)
      for (int u = 50; u < 190; ++u) sum += static_cast<double>(field.disparity.row(v)[u]) - scene.disparity(u, v);
    EXPECT_NEAR(sum / (64 * 140), 0.0, 0.02) << offset;
  }
}

TEST(SlantedAlignment, StatesNoiseAndInformationOfTheWindow) {
  const SlantedPair scene(200, 80, 20.3, 0.0, 0.0, 1.0);
  const DisparityField field = RoundedStart(scene, 0).aligned<Floats>();
  const double predicted = std::sqrt(static_cast<double>(field.noise.row(40)[100] / field.information.row(40)[100]));
  EXPECT_GT(predicted, 0.001);
  EXPECT_LT(predicted, 0.1);
}

}  // namespace
}  // namespace dense_stereo
