// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::texturedRoom;
using urban_nav_registration::testing::Photographer;

std::string toBytes(Keyframe keyframe) {
  urban_nav_core::Archive archive;
  archive(keyframe);
  return archive.take();
}

TEST(KeyframeExtractor, PointsAreSpreadAndTheirDisparitiesTrue) {
  const auto scene = texturedRoom();
  Photographer photographer(scene);
  const auto T = lookingAlong({-2.0, 0.5, 1.2}, 0.3);
  const Keyframe keyframe = photographer.keyframe(T);
  const auto camera = photographer.camera();
  EXPECT_GT(keyframe.points.size(), 300U);
  EXPECT_LE(keyframe.points.size(), 500U);
  EXPECT_LT(keyframe.image.size(), 120'000U);
  std::set<int> cells;
  int right = 0;
  for (const KeyframePoint& point : keyframe.points) {
    cells.insert(static_cast<int>(point.pixel().x()) / 64 + 8 * (static_cast<int>(point.pixel().y()) / 64));
    const urban_nav_core::Vector3d ray = camera.left.ray(point.pixel());
    const auto hit = scene.trace(T.t(), T.q() * ray);
    if (!hit) continue;
    const double disparity = camera.left.fx * camera.baseline / hit->distance;
    if (std::abs(disparity - static_cast<double>(point.disparity)) <
        4.0 * static_cast<double>(point.sigma_disparity) + 0.1)
      ++right;
  }
  EXPECT_GT(cells.size(), 36U) << "of 48 parts of the image";
  EXPECT_GT(right, 0.9 * static_cast<double>(keyframe.points.size()));
}

TEST(KeyframeExtractor, GivesTheSameBytesWhateverTheThreads) {
  Photographer photographer(texturedRoom());
  const auto frame = photographer.take(lookingAlong({0.0, 0.0, 1.0}, 1.0));
  const KeyframeExtractor extractor(photographer.camera(), 200);
  std::string first;
  for (const int threads : {1, 2}) {
    const urban_nav_core::ThreadLimit limit(threads);
    const std::string bytes = toBytes(extractor.extract({"s", 5}, frame.pair()));
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first);
  }
}

TEST(KeyframeExtractor, WithoutImagesThereAreNoPoints) {
  Photographer photographer(texturedRoom());
  const auto frame = photographer.take(lookingAlong({0.0, 0.0, 1.0}, 1.0));
  const KeyframeExtractor extractor(photographer.camera(), 200);
  EXPECT_TRUE(extractor.extract({}, {}).image.empty());
  const Keyframe one_eyed = extractor.extract({}, {0, frame.left.view(), {}});
  EXPECT_FALSE(one_eyed.image.empty());
  EXPECT_TRUE(one_eyed.points.empty());
  auto small = frame.left.view();
  small.width /= 2;
  EXPECT_TRUE(extractor.extract({}, {0, small, frame.right.view()}).points.empty());
  const std::vector<std::uint8_t> dark(512 * 384, 0);
  const urban_nav_core::ImageView black{dark.data(), 512, 384, 512};
  EXPECT_TRUE(extractor.extract({}, {0, black, black}).points.empty());
}

}  // namespace
}  // namespace urban_nav_registration
