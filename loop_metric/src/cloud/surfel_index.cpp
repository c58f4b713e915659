// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/surfel_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace loop_metric {

namespace {
constexpr float kAlike = 0.70710678F;  // cosine of 45 deg: nearer to this surface than to one across it

/// The eight cells around the corner next to a point, nearest first: bit 0, 1, 2 set means over the nearest face in x, y, z.
constexpr std::array<int, 8> kNearestFirst = {0, 1, 2, 4, 3, 5, 6, 7};
}  // namespace

// Cells of twice the reach: the eight around the corner next to a point hold all that is within reach, and once something near was found in
// its own, the others are too far away mostly.
SurfelIndex::SurfelIndex(const std::vector<Surfel>& surfels, float reach, std::shared_ptr<const SurfelIndex> finer)
    : finer_(std::move(finer)), reach_(reach), per_m_(0.5F / reach), table_(surfels.size() / 4 + 16) {
  std::vector<std::uint32_t> cells(surfels.size(), CellTable::none);
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    if (!(surfels[i].planarity > 0.0F)) continue;
    cells[i] = table_.insert(keyOf(cellOf(surfels[i].mean, per_m_)));
    if (cells[i] == counts.size()) counts.push_back(0);
    ++counts[cells[i]];
  }
  begins_.resize(counts.size() + 1, 0);
  for (std::size_t c = 0; c < counts.size(); ++c) begins_[c + 1] = begins_[c] + counts[c];
  sorted_.resize(begins_.back());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < surfels.size(); ++i)
    if (cells[i] != CellTable::none) sorted_[next[cells[i]]++] = surfels[i];
}

SurfelIndex::Nearest SurfelIndex::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const {
  if (finer_ != nullptr)
    if (const Nearest near = finer_->nearest(point, normal); near.surfel != nullptr) return near;
  const Eigen::Vector3f at = point * per_m_;
  if (!(at.cwiseAbs().maxCoeff() < static_cast<float>(kFarthestCell - 1))) return {};
  const Cell own = cellOf(point, per_m_);
  const Eigen::Vector3f within =
      at - Eigen::Vector3f(static_cast<float>(own.x), static_cast<float>(own.y), static_cast<float>(own.z));
  const Eigen::Vector3f gap = within.cwiseMin(Eigen::Vector3f::Ones() - within) / per_m_;  // m to the nearest faces
  const auto side = [](float inside) { return inside < 0.5F ? -1 : 1; };
  const Cell over{side(within.x()), side(within.y()), side(within.z())};
  const Surfel* best = nullptr;
  float least = reach_ * reach_, second = least;
  for (const int bits : kNearestFirst) {
    const bool x = (bits & 1) != 0, y = (bits & 2) != 0, z = (bits & 4) != 0;
    const Eigen::Vector3f away(x ? gap.x() : 0.0F, y ? gap.y() : 0.0F, z ? gap.z() : 0.0F);
    if (const float nearer = away.squaredNorm(); nearer > least) {
      second = std::min(second, nearer);
      continue;
    }
    const std::uint32_t cell =
        table_.find(keyOf({own.x + (x ? over.x : 0), own.y + (y ? over.y : 0), own.z + (z ? over.z : 0)}));
    if (cell == CellTable::none) continue;
    for (std::uint32_t i = begins_[cell]; i < begins_[cell + 1]; ++i) {
      const float distance = (sorted_[i].mean - point).squaredNorm();
      if (!(distance < second) || !(std::abs(sorted_[i].normal.dot(normal)) > kAlike)) continue;
      if (distance < least) {
        second = least;
        least = distance;
        best = &sorted_[i];
      } else {
        second = distance;
      }
    }
  }
  if (best == nullptr) return {};
  return {best, 0.5F * (std::sqrt(second) - std::sqrt(least))};
}

}  // namespace loop_metric
