// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/image/feature_quadtree.hpp"
#include "urban_nav_core/image/harris.hpp"
#include "urban_nav_core/image/patch.hpp"
#include "urban_nav_core/image/pyramid.hpp"
#include "urban_nav_core/image/row_match.hpp"
#include "urban_nav_registration/io/jpeg.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"

namespace urban_nav_registration {

using urban_nav_core::ImageView;
using urban_nav_core::kHarrisMargin;
using urban_nav_core::Pyramid;
using urban_nav_core::StereoCamera;

namespace {

// As in swf_vo's front end, which states their sources.
constexpr int kStereoLevels = 3;
constexpr double kSlack = 2.0;
constexpr double kLargestDisparity = 0.16;
constexpr int kLowestDisparity = -2;
constexpr double kLeastDisparityPx = -1.0;
constexpr float kLevelPreference = 0.3F;
constexpr double kSameRow = 1.5;
constexpr double kLeastStereoCorrelation = 0.85;
constexpr std::uint8_t kClippedFrom = 254;
constexpr int kClippingReach = 2;
constexpr int kAttemptsPerPoint = 3;
constexpr std::array<int, 3> kThresholds = {20, 10, 4};  // FAST thresholds, tried until there are enough corners
constexpr int kWantedPerPoint = 6;                       // corners per point, as a choice for the quadtree
// Bench pairs, street of 512x384: qualities 80, 90, 95, 100 need 34, 51, 73, 124 kB; of pairs 4 to 7.5 m apart 75, 77,
// 78, 79 % are upgraded; nearer pairs and errors do not differ.
constexpr int kJpegQuality = 95;

struct CornerCandidate {
  int level = 0, u = 0, v = 0;
  float score = 0.0F;
  bool of_clipped = false;
};

bool isOfClipped(const ImageView& image, int u, int v, int reach) {
  const int first = std::max(u - reach, 0), end = std::min(u + reach + 1, image.width);
  for (int j = std::max(v - reach, 0); j <= std::min(v + reach, image.height - 1); ++j)
    if (*std::max_element(image.row(j) + first, image.row(j) + end) >= kClippedFrom) return true;
  return false;
}

int depthFor(int points) {
  int depth = 0;
  while (depth < 8 && (1 << (2 * depth)) < 2 * points) ++depth;
  return depth;
}

void gather(const Pyramid& pyramid, int level, int wanted, std::vector<CornerCandidate>& candidates) {
  const ImageView& image = pyramid.level(level);
  urban_nav_core::Fast fast;
  const std::vector<urban_nav_core::Corner>* found = nullptr;
  for (const int threshold : kThresholds) {
    found = &fast.detect(image, threshold, urban_nav_core::Fast::Suppression::LocalMaximum);
    if (static_cast<int>(found->size()) >= wanted) break;
  }
  float weight = 1.0F;
  for (int i = 0; i < level; ++i) weight *= kLevelPreference;
  for (const auto& corner : *found) {
    if (corner.u < kHarrisMargin || corner.v < kHarrisMargin || corner.u >= image.width - kHarrisMargin ||
        corner.v >= image.height - kHarrisMargin)
      continue;
    candidates.push_back(
        {level, corner.u, corner.v, weight * urban_nav_core::structureTensor(image, corner.u, corner.v).harris(),
         isOfClipped(pyramid.level(0), corner.u << level, corner.v << level, kClippingReach << level)});
  }
}

bool measureDepth(const StereoCamera& camera, const ImageView& left, const ImageView& right, KeyframePoint& point) {
  const double size = 1.0 / Pyramid::scale(point.level);
  const int offset = static_cast<int>(std::lround(camera.disparity_offset / size));
  const auto whole = urban_nav_core::findDisparity(left, right, point.u, point.v, kLowestDisparity + offset,
                                                   static_cast<int>(kLargestDisparity * left.width) + offset);
  if (!whole) return false;
  const auto source = urban_nav_core::cutSource(left, point.u, point.v);
  if (!source) return false;
  // typical slope: a surface at 45 deg to the line of sight
  const double usual_slope = std::max(1.0, (*whole - offset + 0.5) * size) / camera.left.fx;
  urban_nav_core::PatchTemplate warped;
  const auto found =
      urban_nav_core::alignAcross(right, *source, Eigen::Vector2d(point.u - *whole, point.v), usual_slope, warped);
  const auto& alignment = found.alignment;
  if (!alignment.converged || alignment.correlation < kLeastStereoCorrelation ||
      std::abs(alignment.position.y() - point.v) > kSameRow)
    return false;
  const double disparity = (point.u - alignment.position.x()) * size;
  const double variance = 2.0 * alignment.covariance(0, 0) * size * size;  // includes the noise of the left patch
  if (!(disparity - camera.disparity_offset >= kLeastDisparityPx) || !std::isfinite(variance)) return false;
  point.disparity = static_cast<float>(disparity);
  point.sigma_disparity = static_cast<float>(std::sqrt(variance));
  point.slope_u = static_cast<float>(found.slopes.x());
  point.slope_v = static_cast<float>(found.slopes.y());
  return std::isfinite(point.slope_u) && std::isfinite(point.slope_v);
}

}  // namespace

KeyframeExtractor::KeyframeExtractor(const StereoCamera& camera, int points) : camera_(camera), points_(points) {}

Keyframe KeyframeExtractor::extract(const urban_nav_core::PoseRef& at, const urban_nav_core::StereoPair& pair) const {
  Keyframe keyframe;
  keyframe.at = at;
  const auto fits = [this](const ImageView& image) {
    return !image.empty() && image.width == camera_.left.width && image.height == camera_.left.height;
  };
  if (!fits(pair.left)) return keyframe;
  keyframe.width = pair.left.width;
  keyframe.height = pair.left.height;
  keyframe.image = encodeJpeg(pair.left, kJpegQuality);
  if (!fits(pair.right)) return keyframe;

  Pyramid left(kStereoLevels), right(kStereoLevels);
  left.build(pair.left);
  right.build(pair.right);
  std::vector<CornerCandidate> candidates;
  for (int level = 0; level < left.levels(); ++level)
    gather(left, level, (kWantedPerPoint * points_) >> (2 * level), candidates);
  std::sort(candidates.begin(), candidates.end(), [](const CornerCandidate& a, const CornerCandidate& b) {
    if (a.of_clipped != b.of_clipped) return b.of_clipped;
    if (a.score != b.score) return a.score > b.score;
    if (a.level != b.level) return a.level < b.level;
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
  urban_nav_core::FeatureQuadtree quadtree(keyframe.width, keyframe.height, points_, depthFor(points_), kSlack);
  int attempts = kAttemptsPerPoint * points_;
  for (const CornerCandidate& candidate : candidates) {
    if (quadtree.count() >= points_ || attempts <= 0) break;
    // used only where there are few other corners
    if (candidate.of_clipped && 2 * quadtree.count() >= points_) break;
    const double u = candidate.u << candidate.level, v = candidate.v << candidate.level;
    if (!quadtree.mayAdd(u, v)) continue;
    --attempts;
    KeyframePoint point;
    point.u = static_cast<std::int16_t>(candidate.u);
    point.v = static_cast<std::int16_t>(candidate.v);
    point.level = static_cast<std::uint8_t>(candidate.level);
    if (!measureDepth(camera_, left.level(candidate.level), right.level(candidate.level), point)) continue;
    quadtree.add(u, v);
    keyframe.points.push_back(point);
  }
  return keyframe;
}

}  // namespace urban_nav_registration
