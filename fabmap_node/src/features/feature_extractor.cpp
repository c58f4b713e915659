// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/features/feature_extractor.hpp"

#include <algorithm>
#include <cmath>

#include "features/descriptor_source.hpp"
#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/image/feature_quadtree.hpp"
#include "urban_nav_core/image/harris.hpp"
#include "urban_nav_core/image/pyramid.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace fabmap_node {
namespace {

using urban_nav_core::ImageView;
using urban_nav_core::Pyramid;

constexpr int kPyramidLevels = 5;
// Share of the features by level; a level has fewer only if the image has no more corners there.
constexpr std::array<double, kPyramidLevels> kLevelShare = {0.40, 0.28, 0.18, 0.10, 0.04};
constexpr double kWindowPx = 32.0;  // side of a descriptor's window, px of its level: two pixels a cell of its grid
constexpr std::array<int, 3> kFastThresholds = {20, 10, 5};
constexpr int kCornersPerFeature = 4;  // candidates for the quadtree
constexpr double kQuadtreeSlack = 2.0;

struct RankedCorner {
  int u = 0, v = 0;
  float score = 0.0F;
};

std::vector<RankedCorner> rankedCorners(const ImageView& image, int wanted) {
  urban_nav_core::Fast fast;
  const std::vector<urban_nav_core::Corner>* found = nullptr;
  for (const int threshold : kFastThresholds) {
    found = &fast.detect(image, threshold, urban_nav_core::Fast::Suppression::LocalMaximum);
    if (static_cast<int>(found->size()) >= kCornersPerFeature * wanted) break;
  }
  std::vector<RankedCorner> ranked;
  ranked.reserve(found->size());
  constexpr int kMargin = urban_nav_core::kHarrisMargin;
  for (const urban_nav_core::Corner& corner : *found) {
    if (corner.u < kMargin || corner.v < kMargin || corner.u >= image.width - kMargin ||
        corner.v >= image.height - kMargin)
      continue;
    ranked.push_back({corner.u, corner.v, urban_nav_core::structureTensor(image, corner.u, corner.v).harris()});
  }
  std::sort(ranked.begin(), ranked.end(), [](const RankedCorner& a, const RankedCorner& b) {
    if (a.score != b.score) return a.score > b.score;
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  return ranked;
}

int quadtreeDepth(int features) {
  int depth = 0;
  while (depth < 8 && (1 << (2 * depth)) < 2 * features) ++depth;
  return depth;
}

void addLevel(const Pyramid& pyramid, int level, int wanted, std::uint8_t camera, std::vector<PlaceFeature>& features) {
  if (wanted < 1) return;
  const ImageView& image = pyramid.level(level);
  const ImageView& whole = pyramid.level(0);
  urban_nav_core::FeatureQuadtree quadtree(image.width, image.height, wanted, quadtreeDepth(wanted), kQuadtreeSlack);
  for (const RankedCorner& corner : rankedCorners(image, wanted)) {
    if (quadtree.count() >= wanted) break;
    if (!quadtree.mayAdd(corner.u, corner.v)) continue;
    const double size = 1.0 / Pyramid::scale(level);
    const Eigen::Vector2d pixel(corner.u * size, corner.v * size);
    PlaceFeature feature;
    if (!describeAsBytes(pyramid, pixel, kWindowPx * size, feature.descriptor)) continue;
    feature.camera = camera;
    feature.u = static_cast<float>(pixel.x() / whole.width);
    feature.v = static_cast<float>(pixel.y() / whole.height);
    quadtree.add(corner.u, corner.v);
    features.push_back(feature);
  }
}

std::vector<PlaceFeature> featuresOfImage(const ImageView& image, int wanted, std::uint8_t camera) {
  std::vector<PlaceFeature> features;
  if (image.empty() || image.width < Pyramid::kSmallestSide || image.height < Pyramid::kSmallestSide) return features;
  Pyramid pyramid(kPyramidLevels);
  pyramid.build(image);
  // Differences of rounded cumulative shares, so that the levels add up to `wanted`.
  double share = 0.0;
  int given = 0;
  for (int level = 0; level < pyramid.levels(); ++level) {
    share += kLevelShare[static_cast<std::size_t>(level)];
    const int up_to = static_cast<int>(std::lround(share * wanted));
    addLevel(pyramid, level, up_to - given, camera, features);
    given = up_to;
  }
  return features;
}

}  // namespace

PlaceObservation FeatureExtractor::extract(const std::vector<ImageView>& images) const {
  PlaceObservation observation;
  observation.cameras = static_cast<std::uint8_t>(std::clamp<std::size_t>(images.size(), 1, 255));
  const int wanted = images.size() > 1 ? options_.panorama : options_.single;
  std::vector<std::vector<PlaceFeature>> found(images.size());
  urban_nav_core::forEach(images.size(), 1, [&](std::size_t i) {
    found[i] = featuresOfImage(images[i], wanted, static_cast<std::uint8_t>(i));
  });
  for (const auto& features : found)
    observation.features.insert(observation.features.end(), features.begin(), features.end());
  return observation;
}

}  // namespace fabmap_node
