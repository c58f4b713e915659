// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/replenish.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "front_end/refine.hpp"
#include "urban_nav_core/camera/surface.hpp"
#include "urban_nav_core/image/harris.hpp"
#include "urban_nav_core/image/row_match.hpp"

namespace swf_vo {

using urban_nav_core::cutSource;
using urban_nav_core::ImageView;
using urban_nav_core::kHarrisMargin;
using urban_nav_core::Pose;
using urban_nav_core::Pyramid;
using urban_nav_core::SlopedAlignment;
using urban_nav_core::StereoCamera;

namespace {

constexpr double kSlack = 2.0;              // tolerance of the quadtree
constexpr double kLargestDisparity = 0.16;  // share of the image's width: nearer points pass too fast to be useful
constexpr int kLowestDisparity = -2;        // px of the level: far points, including the error of rectification
constexpr double kLeastDisparityPx = -1.0;  // after refinement, level 0
constexpr float kLevelPreference = 0.3F;    // features are localised in pixels of their own level
constexpr double kSameRow = 1.0;            // px of the level between the rows of both images
constexpr double kLeastCorrelationAcross = 0.85;
// Grey level of saturation; lookup tables of cameras and JPEG saturate a level or two early.
constexpr std::uint8_t kClippedFrom = 254;
constexpr int kClippingReach = 2;                              // px of the level
constexpr int kAttemptsPerFeature = 3, kAttemptsAtLeast = 20;  // bounds the time where nothing can be matched

/// Returns whether a corner is caused by saturation, such as leaves before a white sky. The saturated border moves with
/// the exposure and with the light in each pixel, equally for all such corners: they bias the rotation without visible
/// residuals.
bool isOfClipped(const ImageView& image, int u, int v, int reach) {
  const int first = std::max(u - reach, 0), end = std::min(u + reach + 1, image.width);
  for (int j = std::max(v - reach, 0); j <= std::min(v + reach, image.height - 1); ++j)
    if (*std::max_element(image.row(j) + first, image.row(j) + end) >= kClippedFrom) return true;
  return false;
}

int depthFor(int features) {
  int depth = 0;
  while (depth < 8 && (1 << (2 * depth)) < 2 * features) ++depth;
  return depth;
}

}  // namespace

Replenisher::Replenisher(const StereoCamera& camera, int features, double floor_px, bool subpixel)
    : camera_(camera),
      features_(features),
      floor_px_(floor_px),
      subpixel_(subpixel),
      quadtree_(camera.left.width, camera.left.height, features, depthFor(features), kSlack) {}

void Replenisher::gather(const Corners& corners) {
  candidates_.clear();
  residual_test_.resize(static_cast<std::size_t>(corners.levels()));
  float weight = 1.0F;
  for (int level = 0; level < corners.levels(); ++level, weight *= kLevelPreference) {
    const ImageView& image = corners.image(Side::Left, level);
    for (const auto& corner : corners.at(Side::Left, level).corners()) {
      if (!quadtree_.mayAdd(corner.u << level, corner.v << level)) continue;
      if (corner.u < kHarrisMargin || corner.v < kHarrisMargin || corner.u >= image.width - kHarrisMargin ||
          corner.v >= image.height - kHarrisMargin)
        continue;
      const bool of_clipped =
          isOfClipped(corners.image(Side::Left, 0), corner.u << level, corner.v << level, kClippingReach << level);
      candidates_.push_back({level, corner.u, corner.v,
                             weight * urban_nav_core::structureTensor(image, corner.u, corner.v).harris(), of_clipped});
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.of_clipped != b.of_clipped) return b.of_clipped;
    if (a.score != b.score) return a.score > b.score;
    if (a.level != b.level) return a.level < b.level;
    return a.v != b.v ? a.v < b.v : a.u < b.u;
  });
}

namespace {

/// Sets surface, uncertainty and templates of a new track from its match in both images.
void describeTrack(const StereoCamera& camera, double floor_px, const Match& match, const SlopedAlignment& found,
                   const urban_nav_core::PatchSource& source, Track& track) {
  track.plane = urban_nav_core::surfaceThrough(
      camera, {match.left.pixel.x(), match.left.pixel.y(), match.right.pixel.x()}, found.slopes);
  track.slant = found.seen.scaled(1.0 / camera.baseline);
  track.slant_reach = camera.baseline;
  track.sigma_disparity =
      std::sqrt(match.left.covariance(0, 0) + match.right.covariance(0, 0) + 2.0 * floor_px * floor_px);
  track.z = match.z;
  track.row_difference_px = match.right.pixel.y() - match.left.pixel.y();
  track.source = source;
  track.left_ready = true;
  track.right_ready = true;
}

}  // namespace

bool Replenisher::start(const Candidate& candidate, FrameId frame, const Corners& corners, const Pose& T_odom_camera,
                        Tracks& tracks, std::vector<Observation>& fresh, RowOffset& rows) {
  const ImageView& left = corners.image(Side::Left, candidate.level);
  const ImageView& right = corners.image(Side::Right, candidate.level);
  const int offset = static_cast<int>(std::lround(camera_.disparity_offset * Pyramid::scale(candidate.level)));
  const double row_offset = rows.px() * Pyramid::scale(candidate.level);
  const auto disparity = urban_nav_core::findDisparity(left, right, candidate.u, candidate.v, kLowestDisparity + offset,
                                                       static_cast<int>(kLargestDisparity * left.width) + offset,
                                                       static_cast<int>(std::lround(row_offset)));
  if (!disparity) return false;
  const auto source = cutSource(left, candidate.u, candidate.v);
  if (!source) return false;
  Track* track = tracks.start();
  if (track == nullptr) return false;
  track->level = candidate.level;
  // typical slope: a surface at 45 deg to the line of sight
  const double usual_slope =
      std::max(1.0, (*disparity - offset + 0.5) / Pyramid::scale(candidate.level)) / camera_.left.fx;
  const SlopedAlignment found = urban_nav_core::alignAcross(
      right, *source, {candidate.u - *disparity, candidate.v + row_offset}, usual_slope, track->in_right);
  const double size = 1.0 / Pyramid::scale(candidate.level);
  Match match;
  match.left.found = match.right.found = true;
  match.left.pixel = size * Eigen::Vector2d(candidate.u, candidate.v);
  match.right.pixel = size * found.alignment.position;
  const bool fits = found.alignment.converged && found.alignment.correlation >= kLeastCorrelationAcross;
  const double lower = found.alignment.position.y() - candidate.v;
  if (fits) rows.see(size * lower);
  const bool plausible = fits && std::abs(lower - row_offset) <= kSameRow &&
                         match.left.pixel.x() - match.right.pixel.x() - camera_.disparity_offset >= kLeastDisparityPx &&
                         residual_test_[static_cast<std::size_t>(candidate.level)].isTypical(found.alignment.noise) &&
                         urban_nav_core::warpTemplate(*source, {}, track->in_left);
  if (plausible) {
    // the noise of the template is that of the left image
    const double noise = std::max(found.alignment.noise, 0.3);
    match.left.covariance = track->in_left.unit_covariance * (noise * noise * size * size);
    match.right.covariance = found.alignment.covariance * (size * size);
    match.track = track;
    if (!subpixel_) roundToPixels(match);
    combine(floor_px_, match, rows.px());
  }
  if (!match.measured) {
    tracks.end(track->id);
    return false;
  }
  track->born = frame;
  track->T_born_odom = T_odom_camera.inverse();
  track->ray = camera_.left.ray(match.left.pixel);
  describeTrack(camera_, floor_px_, match, found, *source, *track);
  fresh.push_back({track->id, frame, match.z, match.information, Eigen::Matrix2d::Zero(), 0.0});
  return true;
}

void Replenisher::replenish(FrameId frame, const Corners& corners, const Pose& T_odom_camera,
                            const std::vector<Match>& matches, Tracks& tracks, std::vector<Observation>& fresh,
                            RowOffset& rows) {
  quadtree_.clear();
  for (const Match& match : matches)
    if (match.inlier && match.left.found) quadtree_.add(match.left.pixel.x(), match.left.pixel.y());
  const int missing = features_ - quadtree_.count();
  if (missing <= 0) return;
  gather(corners);
  int attempts = std::max(kAttemptsAtLeast, kAttemptsPerFeature * missing);
  for (const Candidate& candidate : candidates_) {
    if (quadtree_.count() >= features_ || attempts <= 0) return;
    if (candidate.of_clipped && 2 * quadtree_.count() >= features_)
      return;  // used only where there are few other features
    const double u = candidate.u << candidate.level, v = candidate.v << candidate.level;
    if (!quadtree_.mayAdd(u, v)) continue;
    --attempts;
    if (start(candidate, frame, corners, T_odom_camera, tracks, fresh, rows)) quadtree_.add(u, v);
  }
}

void Replenisher::archive(urban_nav_core::Archive& archive) { archive(residual_test_); }

}  // namespace swf_vo
