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

constexpr double reach = 3.0;  // px of the level
constexpr int row_steps = 4;   // px of the level to both sides, searched where the template does not take hold at once
constexpr double uniqueness = 0.85;      // best over second best, more than two pixels away
constexpr double accepted_share = 0.75;  // of the patch's own contrast
constexpr int longest_row = 1024;        // disparities of one search

/// The place along a row where the template fits best to whole pixels.
Eigen::Vector2d bestOnRow(Side side, const Corners& corners, const Track& track, const Eigen::Vector2d& around) {
  const ImageView& image = corners.image(side, track.level);
  const double scale = Pyramid::scale(track.level);
  const SadPatch patch = urban_nav_core::sadPatch(side == Side::Left ? track.in_left : track.in_right);
  const int u = static_cast<int>(std::lround(around.x() * scale)),
            v = static_cast<int>(std::lround(around.y() * scale));
  int best = std::numeric_limits<int>::max(), at = u;
  for (int i = u - row_steps; i <= u + row_steps; ++i) {
    if (!urban_nav_core::sadFits(image, i, v)) continue;
    const int sad = urban_nav_core::meanRemovedSad(patch, image, i, v);
    if (sad >= best) continue;
    best = sad;
    at = i;
  }
  return Eigen::Vector2d(at, v) / scale;
}

struct Best {
  int sad = std::numeric_limits<int>::max(), second = std::numeric_limits<int>::max(), u = 0;
};

/// Best place of a patch on row v between two columns, and the best one more than two pixels from it.
Best searchRow(const SadPatch& patch, const ImageView& image, int from, int to, int v) {
  Best best;
  std::array<int, longest_row> sads;
  to = std::min(to, from + longest_row - 1);
  urban_nav_core::meanRemovedSads(patch, image, from, v, to - from + 1, sads.data());
  for (int u = from; u <= to; ++u) {
    const int sad = sads[static_cast<std::size_t>(u - from)];
    if (sad >= best.sad) continue;
    best.sad = sad;
    best.u = u;
  }
  for (int u = from; u <= to; ++u)
    if (std::abs(u - best.u) > 2) best.second = std::min(best.second, sads[static_cast<std::size_t>(u - from)]);
  return best;
}

}  // namespace

void matchAcross(const Corners& corners, const StereoCamera& camera, const Pose& T_camera_odom,
                 std::vector<Match>& matches, double row_offset) {
  for (Match& match : matches) {
    if (match.track->level >= corners.levels()) continue;
    for (const Side side : {Side::Left, Side::Right}) {
      Sighting& mine = side == Side::Left ? match.left : match.right;
      const Sighting& other = side == Side::Left ? match.right : match.left;
      if (mine.found) continue;
      const auto projected = projectInto(side, camera, T_camera_odom, match.p_odom, row_offset);
      const auto partner =
          projectInto(side == Side::Left ? Side::Right : Side::Left, camera, T_camera_odom, match.p_odom, row_offset);
      if (!projected || !partner || !prepareTemplate(side, camera, T_camera_odom, match)) continue;
      // What the sighting in the other image is off by is mostly the pose's error, and so common to both.
      const Eigen::Vector2d start = other.found ? Eigen::Vector2d(*projected + (other.pixel - *partner)) : *projected;
      mine = refine(side, corners, *match.track, start, reach);
      if (!mine.found && other.found)
        mine = refine(side, corners, *match.track, bestOnRow(side, corners, *match.track, start), reach);
    }
  }
}

std::optional<int> findDisparity(const ImageView& left, const ImageView& right, int u, int v, int lowest, int highest,
                                 int row_offset) {
  const int row = v + row_offset;
  if (!urban_nav_core::sadFits(left, u, v) || !urban_nav_core::sadFits(right, right.width / 2, row))
    return std::nullopt;
  const SadPatch patch = urban_nav_core::sadPatch(left, u, v);
  int contrast = 0;
  for (const std::int16_t value : patch.value) contrast += std::abs(value);
  const int from = std::max(4, u - highest), to = std::min(right.width - 4, u - lowest);
  if (to <= from) return std::nullopt;
  const Best forth = searchRow(patch, right, from, to, row);
  if (forth.sad > accepted_share * contrast || forth.sad > uniqueness * forth.second) return std::nullopt;
  const Best back = searchRow(urban_nav_core::sadPatch(right, forth.u, row), left, std::max(4, forth.u + lowest),
                              std::min(left.width - 4, forth.u + highest), v);
  if (std::abs(back.u - u) > 1) return std::nullopt;
  return u - forth.u;
}

}  // namespace swf_vo
