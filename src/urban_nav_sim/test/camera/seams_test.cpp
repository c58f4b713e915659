// SPDX-License-Identifier: BSD-3-Clause
#include "camera/seams.hpp"

#include <gtest/gtest.h>

#include <string>

#include "ray_tracing/small_worlds.hpp"

namespace urban_nav_sim {
namespace {

// Two triangles each, in this order.
enum Sheets : std::uint32_t { kFlat, kBeside, kBent, kAbove, kLeaf, kOtherLeaf };

World makeSheets() {
  World world = emptyWorld();
  Part ground = quad(kGround, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  addQuad(ground, {1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  addQuad(ground, {2, 0, 0}, {1, 0, 0.008F}, {0, 1, 0});
  addQuad(ground, {0, 0, 0.05F}, {1, 0, 0}, {0, 1, 0});
  Part leaves = quad(kLeaves, {5, 0, 0}, {1, 0, 0}, {0, 1, 0});
  addQuad(leaves, {5, 0, 1}, {0, 0, 1}, {0, 1, 0});
  world.parts = {ground, leaves};
  return world;
}

const World& sheets() {
  static const World world = makeSheets();
  return world;
}

Met met(Sheets sheet) { return {2 * sheet, kNothing}; }

TEST(Seams, AreBetweenSurfacesAndNotBetweenTheirTriangles) {
  const Tracer tracer(sheets());
  EXPECT_TRUE(areSame(tracer, {0, kNothing}, {1, kNothing}));
  EXPECT_TRUE(areSame(tracer, met(kFlat), met(kBeside)));
  EXPECT_TRUE(areSame(tracer, met(kBeside), met(kBent))) << "a gentle bend";
  EXPECT_FALSE(areSame(tracer, met(kFlat), met(kAbove))) << "parallel, 5 cm apart";
  EXPECT_FALSE(areSame(tracer, met(kFlat), met(kLeaf)));
  EXPECT_TRUE(areSame(tracer, met(kLeaf), met(kOtherLeaf))) << "leaves of a plant, whatever their direction";
  EXPECT_TRUE(areSame(tracer, {}, {})) << "sky";
  EXPECT_FALSE(areSame(tracer, {}, met(kFlat)));
  EXPECT_FALSE(areSame(tracer, met(kFlat), {0, 1})) << "another mover";
  for (std::uint32_t a = 0; a < tracer.facets().size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      EXPECT_EQ(areSame(tracer, {a, kNothing}, {b, kNothing}), areSame(tracer, {b, kNothing}, {a, kNothing}))
          << a << " and " << b;
}

// The class of each pixel of a small picture, a letter each: surface, shadow, nothing.
std::string classify(const Tracer& tracer, const Traces& traces, int width, int height) {
  const Seams seams(tracer, traces, width, height);
  std::string text;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const Edge edge = seams.at(u, v);
      text += edge == Edge::None ? '.' : edge == Edge::OfSurface ? 'e' : 's';
    }
    text += '\n';
  }
  return text;
}

class SeamsOfAPicture : public ::testing::Test {
 protected:
  Traces flat() const {
    return {std::vector<Met>(kWidth * kHeight, met(kFlat)), std::vector<std::uint8_t>(kWidth * kHeight)};
  }
  std::string classify(const Traces& traces) const { return urban_nav_sim::classify(tracer_, traces, kWidth, kHeight); }

  static constexpr int kWidth = 6, kHeight = 4;
  const Tracer tracer_{sheets()};
};

TEST_F(SeamsOfAPicture, AreKnownToAllEightAboutAPixel) {
  Traces traces = flat();
  EXPECT_EQ(classify(traces), "......\n......\n......\n......\n");
  traces.met[2 * kWidth + 2] = met(kAbove);
  EXPECT_EQ(classify(traces), "......\n.eee..\n.eee..\n.eee..\n");
}

TEST_F(SeamsOfAPicture, EndAtItsBorders) {
  Traces traces = flat();
  traces.met[1 * kWidth + 5] = {};
  EXPECT_EQ(classify(traces), "....ee\n....ee\n....ee\n......\n") << "the row's end is not beside the next one's begin";
  traces = flat();
  traces.met[0] = {};
  EXPECT_EQ(classify(traces), "ee....\nee....\n......\n......\n");
}

TEST_F(SeamsOfAPicture, OfAShadowComeFirst) {
  Traces traces = flat();
  traces.met[2 * kWidth + 2] = met(kAbove);
  traces.shadows[2 * kWidth + 4] = 1;
  EXPECT_EQ(classify(traces), "......\n.eesss\n.eesss\n.eesss\n");
}

TEST_F(SeamsOfAPicture, AreBetweenLeavesToo) {
  Traces traces = flat();
  for (Met& all : traces.met) all = met(kLeaf);
  traces.met[0] = met(kOtherLeaf);
  EXPECT_EQ(classify(traces), "ee....\nee....\n......\n......\n");
}

}  // namespace
}  // namespace urban_nav_sim
