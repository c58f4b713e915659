// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/rendered_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"

namespace urban_nav_core::testing {
namespace {

SequenceOptions options(double noise) {
  SequenceOptions result;
  result.camera = {250.0, 250.0, 159.5, 119.5, 320, 240, 0.12, 0.5};
  result.noise = noise;
  return result;
}

TEST(RenderedSequence, AFrameIsTheSameWheneverItIsAskedFor) {
  RenderedSequence a(texturedRoom(), namedMotion("wander", "room", 1), options(2.0)),
      b(texturedRoom(), namedMotion("wander", "room", 1), options(2.0));
  const StereoFrame first = a.frame(5);
  b.frame(9);
  const StereoFrame& again = b.frame(5);
  EXPECT_EQ(first.left.pixels, again.left.pixels);
  EXPECT_EQ(first.right.pixels, again.right.pixels);
  EXPECT_EQ(first.stamp, 1'250'000'000);
}

TEST(RenderedSequence, NoiseHasItsDeviationAndIsNewForEachFrameAndCamera) {
  // A flat grey wall all around, so that frames differ only by noise.
  Scene scene;
  scene.background = 120.0;
  RenderedSequence sequence(scene, standing(Pose()), options(3.0));
  const StereoFrame a = sequence.frame(0), b = sequence.frame(1);
  const auto products = [](const GreyImage& x, const GreyImage& y) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.pixels.size(); ++i) sum += (x.pixels[i] - 120.0) * (y.pixels[i] - 120.0);
    return sum / static_cast<double>(x.pixels.size());
  };
  EXPECT_NEAR(products(a.left, a.left), 9.0 + 1.0 / 12.0, 0.2);
  EXPECT_NEAR(products(a.left, a.right), 0.0, 0.15);
  EXPECT_NEAR(products(a.left, b.left), 0.0, 0.15);
  double neighbours = 0.0, mean = 0.0;
  for (std::size_t i = 0; i + 1 < a.left.pixels.size(); ++i) {
    neighbours += (a.left.pixels[i] - 120.0) * (a.left.pixels[i + 1] - 120.0);
    mean += a.left.pixels[i] - 120.0;
  }
  EXPECT_NEAR(neighbours / static_cast<double>(a.left.pixels.size()), 0.0, 0.15);
  EXPECT_NEAR(mean / static_cast<double>(a.left.pixels.size()), 0.0, 0.05);
}

TEST(RenderedSequence, GainScalesGreyLevels) {
  Scene scene;
  scene.background = 40.0;
  SequenceOptions bright = options(0.0);
  bright.gain = [](double t) { return t < 0.5 ? 1.0 : 4.0; };
  RenderedSequence sequence(scene, standing(Pose()), bright);
  EXPECT_EQ(sequence.frame(0).left.pixels[77], 40);
  EXPECT_EQ(sequence.frame(12).left.pixels[77], 160);
}

TEST(RenderedSequence, PicturesHaveCornersButNotEverywhere) {
  Fast fast;
  const auto expectCorners = [&](RenderedSequence& sequence, int i) {
    const StereoFrame& frame = sequence.frame(i);
    const auto& corners = fast.detect(frame.left.view(), 15, Fast::Suppression::LocalMaximum);
    EXPECT_GT(corners.size(), 100U) << "frame " << i;
    std::vector<int> cells(20 * 15, 0);
    for (const Corner& corner : corners) ++cells[static_cast<std::size_t>(corner.v / 16 * 20 + corner.u / 16)];
    const auto empty = std::count(cells.begin(), cells.end(), 0);
    EXPECT_GT(empty, 30) << "of 300 cells, frame " << i;
    EXPECT_LT(empty, 240) << "of 300 cells, frame " << i;
  };
  RenderedSequence room(texturedRoom(), namedMotion("turns", "room", 1), options(1.0));
  for (const int i : {0, 60, 120, 180, 240, 300}) expectCorners(room, i);
  RenderedSequence street(texturedStreet(), namedMotion("straight", "street", 1), options(1.0));
  for (const int i : {0, 200, 550}) expectCorners(street, i);
}

TEST(RenderedSequence, TheVanMovesAndTheStreetDoesNot) {
  const auto scene = streetWithVan({}, 8.0, 14.0);
  const Vector3d eye(0.0, 0.0, 1.2);
  const auto van = scene(0.0).trace(eye, Vector3d::UnitX());
  ASSERT_TRUE(van);
  EXPECT_NEAR(van->distance, 14.0, 1e-9);
  EXPECT_NEAR(scene(1.0).trace(eye, Vector3d::UnitX())->distance, 8.0 + 14.0 * (1.0 + 0.2 * std::sin(0.5)), 1e-9);
  const Vector3d aside(0.3, 1.0, 0.1);
  EXPECT_EQ(scene(0.0).trace(eye, aside)->distance, scene(1.0).trace(eye, aside)->distance);
}

}  // namespace
}  // namespace urban_nav_core::testing
