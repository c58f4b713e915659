// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/temporal.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "front_end/refine.hpp"

namespace swf_vo {

using urban_nav_core::Corner;
using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::Pyramid;
using urban_nav_core::SadPatch;
using urban_nav_core::StereoCamera;

namespace {

// Maximum difference relative to the patch's own contrast. A corner may be a pixel off the landmark.
constexpr double kAcceptedShare = 0.75;
// From a corner to the landmark, px of the level: FAST responses move by a pixel or two.
constexpr double kCornerReach = 2.5;
constexpr double kDirectReach = 3.0;
// Ratio of the best to the second best of separate corners, for a large search region.
constexpr double kUniqueness = 0.85;
constexpr int kApart = 3;  // px of the level

struct BestCorner {
  bool any = false;
  Corner corner;
  int sad = 0, second = 0;  // `second`: of the corners separate from the best
};

BestCorner bestCorner(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& projected,
                      double radius) {
  const ImageView& image = corners.image(side, track.level);
  const SadPatch patch = urban_nav_core::sadPatch(side == Side::Left ? track.in_left : track.in_right);
  int contrast = 0;
  for (const std::int16_t value : patch.value) contrast += std::abs(value);
  const double scale = Pyramid::scale(track.level);
  BestCorner best;
  best.sad = best.second = static_cast<int>(kAcceptedShare * contrast);
  corners.at(side, track.level)
      .forEachWithin(
          projected.x() * scale, projected.y() * scale, radius * scale + 1.0, [&](const Corner& corner, std::size_t) {
            if (!urban_nav_core::sadFits(image, corner.u, corner.v)) return;
            const int sad = urban_nav_core::meanRemovedSad(patch, image, corner.u, corner.v);
            const bool is_same =
                best.any && std::abs(corner.u - best.corner.u) < kApart && std::abs(corner.v - best.corner.v) < kApart;
            if (sad >= best.sad) {
              if (!is_same) best.second = std::min(best.second, sad);
              return;
            }
            if (!is_same) best.second = best.sad;
            best.sad = sad;
            best.corner = corner;
            best.any = true;
          });
  return best;
}

PixelMeasurement at(Side side, const Corners& corners, const Track& track, const Corner& corner) {
  return refine(side, corners, track, Eigen::Vector2d(corner.u, corner.v) / Pyramid::scale(track.level), kCornerReach);
}

PixelMeasurement search(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& projected,
                        double radius) {
  const BestCorner best = bestCorner(side, corners, track, projected, radius);
  PixelMeasurement sighting;
  if (best.any) sighting = at(side, corners, track, best.corner);
  if (!sighting.found) sighting = refine(side, corners, track, projected, kDirectReach);
  return sighting;
}

PixelMeasurement searchAnywhere(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& projected,
                                double radius) {
  const BestCorner best = bestCorner(side, corners, track, projected, radius);
  if (!best.any || best.sad > kUniqueness * best.second) return PixelMeasurement();
  return at(side, corners, track, best.corner);
}

/// Matches one image per landmark, left and right alternately.
template <typename Search>
void matchInTurn(const Corners& corners, const StereoCamera& camera, const Pose& T_camera_odom, double radius,
                 std::vector<Match>& matches, double row_offset, const Search& search_one) {
  Side side = Side::Left;
  for (Match& match : matches) {
    match.left = match.right = PixelMeasurement();
    side = side == Side::Left ? Side::Right : Side::Left;
    if (match.track->level >= corners.levels()) continue;
    const auto projected = projectInto(side, camera, T_camera_odom, match.p_odom, row_offset);
    if (!projected || !prepareTemplate(side, camera, T_camera_odom, match)) continue;
    (side == Side::Left ? match.left : match.right) = search_one(side, corners, *match.track, *projected, radius);
  }
}

}  // namespace

std::optional<Eigen::Vector2d> projectInto(Side side, const StereoCamera& camera, const Pose& T_camera_odom,
                                           const Eigen::Vector4d& p_odom, double row_offset) {
  Eigen::Vector3d p = T_camera_odom.q() * p_odom.head<3>() + T_camera_odom.t() * p_odom.w();
  if (side == Side::Right) p.x() -= camera.baseline * p_odom.w();
  if (!(p.z() > 0.0) || !(p.z() > 0.1 * p_odom.w())) return std::nullopt;
  const double cx = side == Side::Right ? camera.left.cx - camera.disparity_offset : camera.left.cx;
  return Eigen::Vector2d(camera.left.fx * p.x() / p.z() + cx,
                         camera.left.fy * p.y() / p.z() + camera.left.cy + (side == Side::Right ? row_offset : 0.0));
}

void matchTemporal(const Corners& corners, const StereoCamera& camera, const Pose& T_camera_odom, double radius,
                   std::vector<Match>& matches, double row_offset) {
  matchInTurn(corners, camera, T_camera_odom, radius, matches, row_offset, search);
}

void matchAnywhere(const Corners& corners, const StereoCamera& camera, const Pose& T_camera_odom, double radius,
                   std::vector<Match>& matches, double row_offset) {
  matchInTurn(corners, camera, T_camera_odom, radius, matches, row_offset, searchAnywhere);
}

}  // namespace swf_vo
