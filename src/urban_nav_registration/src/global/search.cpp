// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/global/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>

#include "global/up_direction.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace urban_nav_registration {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

namespace {

constexpr double kHalfTurn = 3.14159265358979;
constexpr int kBearings = 12;       // bins of wall directions, 15 deg each
constexpr double kFarthest = 50.0;  // m from the sensor: beyond, the resolution of headings is too coarse
constexpr std::size_t kKept = 10;   // candidates
constexpr int kShiftLanes = 8;      // shifts summed at once

using Piece = VerticalStructure::Piece;

std::vector<Piece> cutPieces(const Surfels& surfels, const UpDirection& upright, const Eigen::Matrix3f& level,
                             double cell) {
  CellTable cells(1024);
  std::vector<Piece> pieces;
  for (const Surfel& surfel : surfels.all) {
    if (!(surfel.planarity > 0.3F) || std::abs(surfel.normal.dot(upright.up)) > 0.5F) continue;
    const Eigen::Vector3f p = level * surfel.mean, n = level * surfel.normal;
    if (p.head<2>().norm() > static_cast<float>(kFarthest)) continue;
    const std::uint32_t number = cells.insert(toKey(toCell({p.x(), p.y(), 0.0F}, static_cast<float>(1.0 / cell))));
    if (number == pieces.size())
      pieces.push_back({static_cast<double>(p.x()), static_cast<double>(p.y()),
                        std::atan2(static_cast<double>(n.y()), static_cast<double>(n.x()))});
  }
  return pieces;
}

int toBearing(double angle) {
  const double turns = angle / kHalfTurn;  // modulo half a turn, as walls have two sides
  return static_cast<int>((turns - std::floor(turns)) * kBearings) % kBearings;
}

/// One top view per wall direction: 2 at a piece, 1 next to it (in position or direction). A margin of two windows
/// around the pieces ensures that windows beyond it are empty.
struct Pictures {
  double x0 = 0.0, y0 = 0.0, cell = 1.0;
  int width = 0;
  std::vector<std::uint8_t> pixels;

  std::uint8_t* at(int bearing, int x, int y) {
    return &pixels[(static_cast<std::size_t>(bearing) * static_cast<std::size_t>(width) + static_cast<std::size_t>(y)) *
                       static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)];
  }
};

Pictures makePictures(const std::vector<Piece>& pieces, double cell, int half) {
  Pictures pictures;
  const int margin = 2 * half + kShiftLanes + 2;
  pictures.cell = cell;
  pictures.x0 = pictures.y0 = -kFarthest - margin * cell;
  pictures.width = static_cast<int>(2.0 * kFarthest / cell) + 2 * margin;
  pictures.pixels.assign(static_cast<std::size_t>(kBearings) * static_cast<std::size_t>(pictures.width) *
                             static_cast<std::size_t>(pictures.width),
                         0);
  for (const Piece& piece : pieces) {
    const int x = static_cast<int>((piece.x - pictures.x0) / cell),
              y = static_cast<int>((piece.y - pictures.y0) / cell), b = toBearing(piece.bearing);
    for (int db = -1; db <= 1; ++db)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= pictures.width || y + dy >= pictures.width) continue;
          std::uint8_t& pixel = *pictures.at((b + db + kBearings) % kBearings, x + dx, y + dy);
          const bool middle = db == 0 && dx == 0 && dy == 0;
          pixel = std::max<std::uint8_t>(pixel, middle ? 2 : 1);
        }
  }
  return pictures;
}

struct Peak {
  int heading = 0, x = 0, y = 0;
  int score = 0;
};

/// sums[i] += counts[i]; requires a multiple of kShiftLanes.
void addRow(const std::uint8_t* counts, std::uint16_t* sums, int length) {
  for (int i = 0; i < length; i += kShiftLanes)
    cv::v_store(sums + i, cv::v_add_wrap(cv::v_load(sums + i), cv::v_load_expand(counts + i)));
}

/// Returns the best shifts for one heading.
std::vector<Peak> findPeaks(Pictures& pictures, const std::vector<Piece>& pieces, int heading, int headings,
                            const Vector3d& centre, int half) {
  const double angle = 2.0 * kHalfTurn * heading / headings, c = std::cos(angle), s = std::sin(angle);
  const int side = 2 * half + 1, stride = (side + kShiftLanes - 1) / kShiftLanes * kShiftLanes;
  std::vector<std::uint16_t> wide(static_cast<std::size_t>(side) * static_cast<std::size_t>(stride), 0);
  for (const Piece& piece : pieces) {
    const double x = c * piece.x - s * piece.y + centre.x(), y = s * piece.x + c * piece.y + centre.y();
    const int left = static_cast<int>(std::floor((x - pictures.x0) / pictures.cell)) - half,
              top = static_cast<int>(std::floor((y - pictures.y0) / pictures.cell)) - half;
    if (left < 0 || top < 0 || left + stride > pictures.width || top + side > pictures.width) continue;
    const int bearing = toBearing(piece.bearing + angle);
    for (int row = 0; row < side; ++row)
      addRow(pictures.at(bearing, left, top + row), &wide[static_cast<std::size_t>(row * stride)], stride);
  }
  std::vector<std::uint16_t> scores;
  for (int row = 0; row < side; ++row)
    scores.insert(scores.end(), wide.begin() + row * stride, wide.begin() + row * stride + side);
  std::vector<Peak> peaks;
  for (int n = 0; n < 3; ++n) {
    const auto best = std::max_element(scores.begin(), scores.end());
    if (*best == 0) break;
    const int at = static_cast<int>(best - scores.begin()), px = at % side, py = at / side;
    peaks.push_back({heading, px - half, py - half, *best});
    for (int y = std::max(0, py - 4); y < std::min(side, py + 5); ++y)
      for (int x = std::max(0, px - 4); x < std::min(side, px + 5); ++x)
        scores[static_cast<std::size_t>(y * side + x)] = 0;
  }
  return peaks;
}

Eigen::Matrix3f levelling(const Eigen::Vector3f& up) {
  return Eigen::Quaternionf::FromTwoVectors(up, Eigen::Vector3f::UnitZ()).toRotationMatrix();
}

bool areNear(const Peak& a, const Peak& b, const SearchResolution& grain) {
  const int turn = std::abs(a.heading - b.heading), around = std::min(turn, grain.headings - turn);
  return around * 360.0 / grain.headings <= 10.0 && std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= 3;
}

}  // namespace

VerticalStructure extractVerticalStructure(const Surfels& surfels, const SearchResolution& grain) {
  const UpDirection upright = estimateUpDirection(surfels);
  VerticalStructure outline;
  outline.level = levelling(upright.up);
  outline.ground = upright.ground;
  outline.has_ground = upright.has_ground;
  outline.pieces = cutPieces(surfels, upright, outline.level, grain.cell);
  return outline;
}

std::vector<PoseCandidate> searchGlobally(const VerticalStructure& source, const VerticalStructure& target,
                                          const Vector3d& centre, double radius, const SearchResolution& grain) {
  std::vector<Piece> pieces = source.pieces;
  if (pieces.empty()) return {};
  if (pieces.size() > grain.most) {  // evenly over the list
    std::vector<Piece> some;
    for (std::size_t i = 0; i < grain.most; ++i) some.push_back(pieces[i * pieces.size() / grain.most]);
    pieces = some;
  }
  const int half = std::max(1, static_cast<int>(radius / grain.cell));
  Pictures pictures = makePictures(target.pieces, grain.cell, half);
  const Vector3d middle = target.level.cast<double>() * centre;
  std::vector<std::vector<Peak>> by_heading(static_cast<std::size_t>(grain.headings));
  urban_nav_core::forEach(by_heading.size(), 6, [&](std::size_t heading) {
    by_heading[heading] = findPeaks(pictures, pieces, static_cast<int>(heading), grain.headings, middle, half);
  });
  std::vector<Peak> peaks;
  for (const auto& some : by_heading) peaks.insert(peaks.end(), some.begin(), some.end());
  std::stable_sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return a.score > b.score; });
  std::vector<Peak> kept;
  for (const Peak& peak : peaks) {
    if (kept.size() == kKept) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const Peak& other) { return areNear(peak, other, grain); }))
      kept.push_back(peak);
  }
  std::vector<PoseCandidate> candidates;
  for (const Peak& peak : kept) {
    const Pose turned(
        Quaterniond(Eigen::AngleAxisd(2.0 * kHalfTurn * peak.heading / grain.headings, Vector3d::UnitZ())),
        {middle.x() + grain.cell * peak.x, middle.y() + grain.cell * peak.y,
         source.has_ground && target.has_ground ? static_cast<double>(target.ground - source.ground) : middle.z()});
    const Pose T_level_source(urban_nav_core::Matrix3d(source.level.cast<double>()), Vector3d::Zero());
    const Pose T_level_target(urban_nav_core::Matrix3d(target.level.cast<double>()), Vector3d::Zero());
    candidates.push_back(
        {T_level_target.inverse() * turned * T_level_source, peak.score / (2.0 * static_cast<double>(pieces.size()))});
  }
  return candidates;
}

}  // namespace urban_nav_registration
