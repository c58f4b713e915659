// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/across.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "front_end/refine.hpp"
#include "front_end/temporal.hpp"

namespace swf_vo {

using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::Pyramid;
using urban_nav_core::SadPatch;
using urban_nav_core::StereoCamera;

namespace {

constexpr double kAcrossReach = 3.0;  // px of the level
constexpr int kRowSteps = 4;  // px of the level to both sides, searched where the template does not converge at once

/// Returns the position along a row with the best match of the template, to whole pixels.
Eigen::Vector2d bestOnRow(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& around) {
  const ImageView& image = corners.image(side, track.level);
  const double scale = Pyramid::scale(track.level);
  const SadPatch patch = urban_nav_core::sadPatch(side == Side::Left ? track.in_left : track.in_right);
  const int u = static_cast<int>(std::lround(around.x() * scale)),
            v = static_cast<int>(std::lround(around.y() * scale));
  int best = std::numeric_limits<int>::max(), at = u;
  for (int i = u - kRowSteps; i <= u + kRowSteps; ++i) {
    if (!urban_nav_core::sadFits(image, i, v)) continue;
    const int sad = urban_nav_core::meanRemovedSad(patch, image, i, v);
    if (sad >= best) continue;
    best = sad;
    at = i;
  }
  return Eigen::Vector2d(at, v) / scale;
}

}  // namespace

void matchAcross(const Corners& corners, const StereoCamera& camera, const Pose& T_camera_odom,
                 std::vector<Match>& matches, double row_offset) {
  for (Match& match : matches) {
    if (match.track->level >= corners.levels()) continue;
    for (const Side side : {Side::Left, Side::Right}) {
      PixelMeasurement& mine = side == Side::Left ? match.left : match.right;
      const PixelMeasurement& other = side == Side::Left ? match.right : match.left;
      if (mine.found) continue;
      const auto projected = projectInto(side, camera, T_camera_odom, match.p_odom, row_offset);
      const auto partner =
          projectInto(side == Side::Left ? Side::Right : Side::Left, camera, T_camera_odom, match.p_odom, row_offset);
      if (!projected || !partner || !prepareTemplate(side, camera, T_camera_odom, match)) continue;
      // The error of the projection is mainly that of the pose, hence common to both images.
      const Eigen::Vector2d start = other.found ? Eigen::Vector2d(*projected + (other.pixel - *partner)) : *projected;
      mine = refine(side, corners, *match.track, start, kAcrossReach);
      if (!mine.found && other.found)
        mine = refine(side, corners, *match.track, bestOnRow(side, corners, *match.track, start), kAcrossReach);
    }
  }
}

}  // namespace swf_vo
