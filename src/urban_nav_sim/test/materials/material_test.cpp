// SPDX-License-Identifier: BSD-3-Clause
#include "materials/material.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/material_library.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

MaterialSample spotAt(const Vector2f& at, float width, std::uint32_t seed = 3) {
  MaterialSample spot;
  spot.at = at, spot.per_u = Vector2f(width, 0), spot.per_v = Vector2f(0, width), spot.seed = seed;
  return spot;
}

/// Mean of many small looks that fill a rectangle.
Vector3f meanOver(const Material& m, const Vector2f& centre, float length, float width, int n, std::uint32_t seed = 3) {
  Vector3f sum = Vector3f::Zero();
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vector2f off((static_cast<float>(i) + 0.5F) / static_cast<float>(n) - 0.5F,
                         (static_cast<float>(j) + 0.5F) / static_cast<float>(n) - 0.5F);
      sum += lookAt(m, spotAt(centre + Vector2f(off.x() * length, off.y() * width), 0.002F, seed)).albedo;
    }
  }
  return sum / static_cast<float>(n * n);
}

class Materials : public ::testing::Test {
 protected:
  static MaterialLibrary& stock() {
    static MaterialLibrary s(11);
    return s;
  }
};

TEST_F(Materials, AWallFromAfarHasItsMeanColour) {
  for (const MaterialKind stuff :
       {MaterialKind::Ashlar, MaterialKind::Brick, MaterialKind::Gravel, MaterialKind::Lawn, MaterialKind::Slabs}) {
    Material m = stock().make(stuff);
    m.layers = {};
    const float period = m.detail->period() * m.stretch;  // of a shuffled bond, whole courses still
    const Vector3f near = meanOver(m, {5.0F, 3.0F}, 4.0F * period, 4.0F * period, 300),
                   far = lookAt(m, spotAt({5.0F, 3.0F}, 60.0F)).albedo;
    EXPECT_LT((near - far).norm(), 0.02F * far.norm()) << m.name;
  }
}

TEST_F(Materials, AFootprintHasTheMeanOfItsAreaAtAllSizes) {
  Draw draw(5);
  for (const MaterialKind stuff :
       {MaterialKind::Ashlar, MaterialKind::Brick, MaterialKind::Gravel, MaterialKind::Lawn}) {
    const Material m = stock().make(stuff);
    for (const float width : {0.01F, 0.03F, 0.1F, 0.3F}) {
      double bias = 0.0, difference = 0.0, spread = 0.0;
      const Vector3f whole = lookAt(m, spotAt({0, 0}, 30.0F)).albedo;
      for (int i = 0; i < 60; ++i) {
        const Vector2f at(static_cast<float>(draw.uniform(0, 20)), static_cast<float>(draw.uniform(0, 20)));
        const float fine = meanOver(m, at, width, width, 12).sum(), coarse = lookAt(m, spotAt(at, width)).albedo.sum();
        bias += static_cast<double>(coarse - fine) / 60;
        difference += std::pow(static_cast<double>(coarse - fine), 2) / 60,
            spread += std::pow(static_cast<double>(fine - whole.sum()), 2) / 60;
      }
      EXPECT_LT(std::abs(bias), 0.25 * std::sqrt(spread) + 0.002) << m.name << ' ' << width;
      EXPECT_LT(difference, 0.6 * spread + 1e-5) << m.name << ' ' << width;
    }
  }
}

TEST_F(Materials, AnElongatedFootprintKeepsDetailAcrossItsLongAxis) {
  const Material m = stock().make(MaterialKind::Gravel);
  double with_taps = 0.0, truth = 0.0, mean = 0.0;
  const int n = 150;
  std::vector<double> looks;
  for (int i = 0; i < n; ++i) {
    MaterialSample spot = spotAt({7.0F + 0.02F * static_cast<float>(i), 2.0F}, 0.02F);
    spot.per_v = Vector2f(0, 0.16F);
    looks.push_back(static_cast<double>(lookAt(m, spot).albedo.y()));
    mean += looks.back() / n;
    truth += std::pow(static_cast<double>(meanOver(m, spot.at, 0.02F, 0.16F, 12).y()) - looks.back(), 2) / n;
  }
  for (const double l : looks) with_taps += (l - mean) * (l - mean) / n;
  EXPECT_GT(std::sqrt(with_taps), 0.012);
  EXPECT_LT(truth, 0.6 * with_taps);
}

TEST_F(Materials, JointsStayInPlaceAtAllSizes) {
  // The middle of a brick's joint, found at three sizes of pixels, stays where it is.
  Material m = stock().make(MaterialKind::Brick);
  m.layers = {}, m.per_tone.setZero();
  const auto phaseOfJoint = [&](float width) {
    double c = 0.0, s = 0.0;
    for (int j = 0; j < 100; ++j) {
      const float v = 0.075F * static_cast<float>(j) / 100.0F;
      for (int i = 0; i < 100; ++i) {
        const double light =
            static_cast<double>(lookAt(m, spotAt({0.0225F * static_cast<float>(i), v}, width, 0)).albedo.z());
        c += light * std::cos(0.0628318530718 * j), s += light * std::sin(0.0628318530718 * j);
      }
    }
    return 0.075 * std::atan2(s, c) / 6.283185307;
  };
  EXPECT_NEAR(phaseOfJoint(0.004F), phaseOfJoint(0.01F), 2e-4);
  EXPECT_NEAR(phaseOfJoint(0.004F), phaseOfJoint(0.03F), 4e-4);
}

TEST_F(Materials, IsContinuousInPlaceAndSize) {
  Draw draw(9);
  for (const MaterialKind stuff : {MaterialKind::Gravel, MaterialKind::Lawn, MaterialKind::Ashlar}) {
    const Material m = stock().make(stuff);
    for (int i = 0; i < 2000; ++i) {
      const Vector2f at(static_cast<float>(draw.uniform(-20, 20)), static_cast<float>(draw.uniform(-20, 20)));
      const float width = static_cast<float>(std::exp2(draw.uniform(-8, 1)));
      const Vector3f here = lookAt(m, spotAt(at, width)).albedo;
      EXPECT_LT((lookAt(m, spotAt(at + Vector2f(2e-5F, -2e-5F), width)).albedo - here).norm(), 0.02F);
      EXPECT_LT((lookAt(m, spotAt(at, width * 1.0005F)).albedo - here).norm(), 0.01F);
    }
  }
}

TEST_F(Materials, EachInstanceDiffersAndIsTheSameAgain) {
  const Material m = stock().make(MaterialKind::Ashlar), again = MaterialLibrary(11).make(MaterialKind::Ashlar);
  double difference = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Vector2f at(0.17F * static_cast<float>(i), 1.0F);
    EXPECT_EQ(lookAt(m, spotAt(at, 0.01F, 1)).albedo, lookAt(again, spotAt(at, 0.01F, 1)).albedo);
    difference +=
        static_cast<double>((lookAt(m, spotAt(at, 0.01F, 1)).albedo - lookAt(m, spotAt(at, 0.01F, 2)).albedo).norm());
  }
  EXPECT_GT(difference / 100, 0.03);
}

TEST_F(Materials, ValuesAreAlbedos) {
  Draw draw(2);
  for (int s = 0; s <= static_cast<int>(MaterialKind::Skin); ++s) {
    const Material m = stock().make(static_cast<MaterialKind>(s), 1);
    for (int i = 0; i < 200; ++i) {
      MaterialSample spot =
          spotAt({static_cast<float>(draw.uniform(-60, 60)), static_cast<float>(draw.uniform(-60, 60))}, 0.01F);
      spot.wet = static_cast<float>(draw.index(2));
      const Appearance look = lookAt(m, spot);
      EXPECT_GT(look.albedo.minCoeff(), 0.0F);
      EXPECT_LT(look.albedo.maxCoeff(), 1.0F);
      EXPECT_GT(look.infrared, 0.0F);
      EXPECT_LT(look.infrared, 1.0F);
      EXPECT_GE(look.gloss, 0.0F);
      EXPECT_LE(look.gloss, 1.0F);
    }
  }
}

TEST_F(Materials, LeavesFallOneByOne) {
  const Material m = stock().make(MaterialKind::Leaves);
  ASSERT_TRUE(hasHoles(m));
  EXPECT_FALSE(hasHoles(stock().make(MaterialKind::Hedge)));
  int all = 0, half = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector2f at(0.02F * static_cast<float>(i % 100), 0.02F * static_cast<float>(i / 100));
    const bool now = isThere(m, at, 4, 1.0F), later = isThere(m, at, 4, 0.5F);
    EXPECT_TRUE(now || !later);
    EXPECT_FALSE(isThere(m, at, 4, 0.0F));
    all += now, half += later;
  }
  EXPECT_GT(all, 3500);
  EXPECT_LT(all, 9000);
  EXPECT_NEAR(half, all / 2, all / 8);
}

}  // namespace
}  // namespace urban_nav_sim
