// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/pictures/match_picture.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::texturedRoom;
using urban_nav_registration::testing::Photographer;

std::string packed(Keyframe keyframe) {
  urban_nav_core::Archive archive;
  archive(keyframe);
  return archive.take();
}

Keyframe toKeyframe(const std::string& bytes) {
  urban_nav_core::Archive archive(bytes, "keyframe");
  Keyframe keyframe;
  archive(keyframe);
  archive.finish();
  return keyframe;
}

bool isRefused(const Keyframe& keyframe) {
  try {
    toKeyframe(packed(keyframe));
  } catch (const urban_nav_core::DataError&) {
    return true;
  }
  return false;
}

Keyframe someKeyframe() {
  static const Keyframe keyframe = Photographer(texturedRoom()).keyframe(lookingAlong({0.0, 0.0, 1.0}, 1.0), 1.0, 100);
  return keyframe;
}

TEST(KeyframeArchive, ComesBackFromItsBytesAndDamageIsRefused) {
  const std::string bytes = packed(someKeyframe());
  EXPECT_EQ(packed(toKeyframe(bytes)), bytes);
  EXPECT_EQ(packed(toKeyframe(packed({}))), packed({}));
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(toKeyframe(bytes.substr(0, length)), urban_nav_core::DataError) << length;
  EXPECT_THROW(toKeyframe(bytes + "x"), urban_nav_core::DataError);
}

TEST(KeyframeArchive, WhatNoMakerMakesIsRefused) {
  EXPECT_FALSE(isRefused(someKeyframe()));
  Keyframe bad = someKeyframe();
  bad.width = -1;
  EXPECT_TRUE(isRefused(bad));
  bad.width = 40'000;
  EXPECT_TRUE(isRefused(bad));
  const auto isRefusedWith = [](const KeyframePoint& point) {
    Keyframe keyframe = someKeyframe();
    keyframe.points.push_back(point);
    return isRefused(keyframe);
  };
  EXPECT_FALSE(isRefusedWith({511, 383, 0, 3.0F, 0.1F, 0.0F, 0.0F}));
  EXPECT_TRUE(isRefusedWith({512, 383, 0, 3.0F, 0.1F, 0.0F, 0.0F}));
  EXPECT_TRUE(isRefusedWith({300, 100, 1, 3.0F, 0.1F, 0.0F, 0.0F}));
  EXPECT_TRUE(isRefusedWith({100, -1, 0, 3.0F, 0.1F, 0.0F, 0.0F}));
  EXPECT_TRUE(isRefusedWith({1, 1, 200, 3.0F, 0.1F, 0.0F, 0.0F}));
  EXPECT_TRUE(isRefusedWith({100, 100, 0, 600.0F, 0.1F, 0.0F, 0.0F}));
  EXPECT_TRUE(isRefusedWith({100, 100, 0, 3.0F, 0.0F, 0.0F, 0.0F}));
}

// Damage with a valid checksum: accepted keyframes can be matched and drawn.
TEST(KeyframeArchive, Fuzzed) {
  Photographer photographer(texturedRoom());
  const Keyframe good = photographer.keyframe(lookingAlong({0.3, 0.0, 1.0}, 1.1), 1.0, 100);
  Keyframe seed = someKeyframe();
  const std::vector<std::uint8_t> image = seed.image;
  seed.image.clear();  // fuzzes the bytes of the points, not those of the picture
  StereoMatcher matcher(photographer.camera(), {});
  int matched = 0;
  const auto result = urban_nav_core::testing::fuzzText({packed(seed)}, [&](const std::string& text) {
    Keyframe damaged = toKeyframe(text);
    if (++matched > 20) return;
    damaged.image = image;
    damaged.at = {"fuzz", matched};
    const StereoClosure closure = matcher.match(good, damaged);
    ASSERT_TRUE(closure.lefts.T_a_b.isFinite());
    ASSERT_TRUE(closure.lefts.information.allFinite());
    ASSERT_GT(drawMatches(good, damaged, closure.pixels).width, 0);
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace urban_nav_registration
