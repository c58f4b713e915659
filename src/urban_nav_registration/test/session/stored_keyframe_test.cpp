// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/stored_keyframe.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_registration {
namespace {

Keyframe makeKeyframe() {
  Keyframe keyframe;
  keyframe.at = {"quad", 17};
  keyframe.image = {1, 2, 3};
  keyframe.width = 512;
  keyframe.height = 384;
  for (int i = 0; i < 300; ++i) {
    KeyframePoint point;
    point.u = static_cast<std::int16_t>(i);
    point.disparity = 4.0F + 0.01F * static_cast<float>(i);
    keyframe.points.push_back(point);
  }
  return keyframe;
}

/// Features as stores of schema 11 and older have them.
std::string uncompressed(const urban_nav_store::StoredKeyframe& row) {
  return *urban_nav_store::inflated(row.features, std::size_t{1} << 20);
}

TEST(StoredKeyframeTest, RoundTripIsExact) {
  const Keyframe keyframe = makeKeyframe();
  urban_nav_store::StoredKeyframe row = toStoredKeyframe(keyframe);
  EXPECT_LT(2 * row.features.size(), uncompressed(row).size());
  const auto expectSame = [&] {
    const Keyframe back = toKeyframe(row, "quad");
    EXPECT_TRUE(back.at == keyframe.at);
    EXPECT_EQ(back.image, keyframe.image);
    ASSERT_EQ(back.points.size(), keyframe.points.size());
    for (std::size_t i = 0; i < back.points.size(); ++i) {
      EXPECT_EQ(back.points[i].u, keyframe.points[i].u);
      EXPECT_EQ(back.points[i].disparity, keyframe.points[i].disparity);
    }
  };
  expectSame();
  row.features = uncompressed(row);
  expectSame();
}

TEST(StoredKeyframeTest, RefusesDamage) {
  const urban_nav_store::StoredKeyframe good = toStoredKeyframe(makeKeyframe());
  for (const std::string& features : {good.features, uncompressed(good)})
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{20}, features.size() - 1}) {
      urban_nav_store::StoredKeyframe row = good;
      row.features = features.substr(0, size);
      EXPECT_THROW(toKeyframe(row, "quad"), urban_nav_core::DataError) << size;
    }
}

}  // namespace
}  // namespace urban_nav_registration
