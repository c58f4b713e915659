// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/corner_grid.hpp"

#include <cassert>

namespace urban_nav_core {
namespace {

constexpr int kScores = 256;

}  // namespace

CornerGrid::CornerGrid(int cell) : cell_(cell) { assert(cell >= 1); }

void CornerGrid::assign(const std::vector<Corner>& corners, int width, int height) {
  width_ = width;
  height_ = height;
  columns_ = std::max(1, (width + cell_ - 1) / cell_);
  rows_ = std::max(1, (height + cell_ - 1) / cell_);
  corners_.resize(corners.size());
  const auto cell = [this](const Corner& corner) {
    assert(corner.u >= 0 && corner.v >= 0 && corner.u < width_ && corner.v < height_);
    return static_cast<std::size_t>((corner.v / cell_) * columns_ + corner.u / cell_);
  };
  // Counting sort with counts stored at offset 2, which leaves starts_[c] at the beginning of cell c.
  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 2, 0);
  for (const Corner& corner : corners) ++starts_[cell(corner) + 2];
  for (std::size_t c = 2; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  for (const Corner& corner : corners) corners_[starts_[cell(corner) + 1]++] = corner;
}

void CornerCap::apply(std::vector<Corner>& corners, int width, int height) {
  const int columns = (width + quota_.cell - 1) / quota_.cell;
  const int rows = (height + quota_.cell - 1) / quota_.cell;
  const std::size_t cells = static_cast<std::size_t>(std::max(0, columns * rows));
  const auto cell = [&](const Corner& corner) {
    assert(corner.u >= 0 && corner.v >= 0 && corner.u < width && corner.v < height);
    return static_cast<std::size_t>((corner.v / quota_.cell) * columns + corner.u / quota_.cell);
  };

  histograms_.assign(cells * kScores, 0);
  for (const Corner& corner : corners) ++histograms_[cell(corner) * kScores + corner.fast];

  limits_.assign(cells, 0);
  room_.assign(cells, 0);
  for (std::size_t c = 0; c < cells; ++c) {
    const int* histogram = histograms_.data() + c * kScores;
    int kept = 0;
    int score = kScores - 1;
    for (; score >= 0; --score) {
      const int wanted = score > quota_.threshold ? quota_.most : quota_.least;
      if (kept >= wanted) break;
      if (histogram[score] == 0) continue;
      limits_[c] = score;
      room_[c] = std::min(histogram[score], wanted - kept);
      kept += room_[c];
    }
  }

  std::size_t out = 0;
  for (const Corner& corner : corners) {
    const std::size_t c = cell(corner);
    const bool stays = corner.fast > limits_[c] || (corner.fast == limits_[c] && room_[c]-- > 0);
    if (stays) corners[out++] = corner;
  }
  corners.resize(out);
}

}  // namespace urban_nav_core
