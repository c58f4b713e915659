// SPDX-License-Identifier: BSD-3-Clause
#include "health/row_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "urban_nav_core/image/patch.hpp"

namespace swf_vo {

using urban_nav_core::Corner;
using urban_nav_core::ImageView;
using urban_nav_core::SadPatch;

namespace {

constexpr int kCellColumns = 10, kCellRows = 8;
constexpr int kContrastThreshold = 12;         // grey levels, of FAST
constexpr int kRowsToSearch = 24;              // px to both sides
constexpr double kFarthestDisparity = 0.16;    // share of the image's width, as in Replenisher
constexpr int kNearestDisparity = -8;          // px: converging cameras
constexpr double kUniqueShare = 0.85;          // best over second best, more than two pixels away
constexpr double kContrastShare = 0.75;        // best over the patch's own contrast
constexpr std::size_t kFewestRowMatches = 15;  // matches required
constexpr int kPairsApart = 20;

int contrastOf(const SadPatch& patch) {
  int sum = 0;
  for (const std::int16_t value : patch.value) sum += std::abs(value);
  return sum;
}

}  // namespace

/// Returns the best position of a patch in columns `first` to `last` of the rows around v, and the score of the best
/// one more than two pixels away.
RowCheck::Place RowCheck::search(const SadPatch& patch, const ImageView& image, int first, int last, int v) {
  const int from = std::max(4, first), to = std::min(image.width - 4, last), columns = to - from + 1;
  const int top = std::max(4, v - kRowsToSearch), bottom = std::min(image.height - 5, v + kRowsToSearch);
  Place best;
  if (columns <= 0 || bottom < top) return best;
  costs_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(bottom - top + 1));
  const auto index = [&](int u, int row) { return static_cast<std::size_t>((row - top) * columns + u - from); };
  for (int row = top; row <= bottom; ++row)
    urban_nav_core::meanRemovedSads(patch, image, from, row, columns, &costs_[index(from, row)]);
  const auto lowest = std::min_element(costs_.begin(), costs_.end());
  const int at = static_cast<int>(lowest - costs_.begin());
  best.sad = *lowest;
  best.u = from + at % columns;
  best.v = top + at / columns;
  for (int row = top; row <= bottom; ++row)
    for (int u = from; u <= to; ++u)
      if (std::abs(u - best.u) > 2 || std::abs(row - best.v) > 2)
        best.second = std::min(best.second, costs_[index(u, row)]);
  return best;
}

std::optional<double> RowCheck::measure(const urban_nav_core::StereoPair& pair, double row_offset_px) {
  const ImageView &left = pair.left, &right = pair.right;
  strongest_.assign(kCellColumns * kCellRows, Corner());
  std::array<bool, kCellColumns * kCellRows> filled{};
  for (const Corner& corner : fast_.detect(left, kContrastThreshold, urban_nav_core::Fast::Suppression::LocalMaximum)) {
    const int cell = corner.v * kCellRows / left.height * kCellColumns + corner.u * kCellColumns / left.width;
    const auto at = static_cast<std::size_t>(cell);
    if (filled[at] && corner.fast <= strongest_[at].fast) continue;
    strongest_[at] = corner;
    filled[at] = true;
  }
  const int farthest = static_cast<int>(kFarthestDisparity * left.width);
  differences_.clear();
  matches_.clear();
  for (std::size_t at = 0; at < strongest_.size(); ++at) {
    const int u = strongest_[at].u, v = strongest_[at].v;
    if (!filled[at] || !urban_nav_core::sadFits(left, u, v)) continue;
    const SadPatch patch = urban_nav_core::sadPatch(left, u, v);
    const Place there = search(patch, right, u - farthest, u - kNearestDisparity, v);
    if (there.sad > kContrastShare * contrastOf(patch) || there.sad > kUniqueShare * there.second) continue;
    const Place back = search(urban_nav_core::sadPatch(right, there.u, there.v), left, there.u + kNearestDisparity,
                              there.u + farthest, there.v);
    if (std::abs(back.u - u) > 1 || std::abs(back.v - v) > 1) continue;
    differences_.push_back(std::abs(there.v - v - row_offset_px));
    matches_.push_back({Eigen::Vector2d(u, v), Eigen::Vector2d(there.u, there.v)});
  }
  if (differences_.size() < kFewestRowMatches) return std::nullopt;
  const auto middle = differences_.begin() + static_cast<std::ptrdiff_t>(differences_.size() / 2);
  std::nth_element(differences_.begin(), middle, differences_.end());
  return *middle;
}

std::optional<double> RowCheck::measureSometimes(const urban_nav_core::StereoPair& pair, double row_offset_px) {
  matches_.clear();
  if (pairs_until_next_ == 0) {
    last_ = measure(pair, row_offset_px);
    pairs_until_next_ = kPairsApart;
  }
  --pairs_until_next_;
  return last_;
}

void RowCheck::reset() {
  pairs_until_next_ = 0;
  last_.reset();
}

void RowCheck::archive(urban_nav_core::Archive& archive) { archive(pairs_until_next_, last_); }

}  // namespace swf_vo
