// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/surfel_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <utility>

namespace urban_nav_registration {

namespace {
constexpr float kSimilarSurface = 0.70710678F;  // cosine of 45 deg, to exclude surfaces across

constexpr std::uint32_t kSurfelLanes = 4;  // surfels compared at once

/// The eight cells around the nearest corner of a point's cell, nearest first: bits 0, 1, 2 select the cell across the
/// nearest face in x, y, z.
constexpr std::array<int, 8> kNearestFirst = {0, 1, 2, 4, 3, 5, 6, 7};
}  // namespace

// Cells of twice the reach: the eight around the nearest corner contain all surfels within reach, and once a near
// surfel is found in the point's own cell, the others are mostly too far away.
SurfelIndex::SurfelIndex(const std::vector<Surfel>& surfels, float reach, std::shared_ptr<const SurfelIndex> finer)
    : finer_(std::move(finer)), reach_(reach), per_m_(0.5F / reach), table_(surfels.size() / 4 + 16) {
  std::vector<std::uint32_t> cells(surfels.size(), CellTable::kNone);
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    if (!(surfels[i].planarity > 0.0F)) continue;
    cells[i] = table_.insert(toKey(toCell(surfels[i].mean, per_m_)));
    if (cells[i] == counts.size()) counts.push_back(0);
    ++counts[cells[i]];
  }
  begins_.resize(counts.size() + 1, 0);
  for (std::size_t c = 0; c < counts.size(); ++c) begins_[c + 1] = begins_[c] + counts[c];
  sorted_.resize(begins_.back());
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < surfels.size(); ++i)
    if (cells[i] != CellTable::kNone) sorted_[next[cells[i]]++] = surfels[i];
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    lanes_[lane].resize(sorted_.size() + kSurfelLanes - 1, 0.0F);
    const auto axis = static_cast<Eigen::Index>(lane % 3);
    for (std::size_t i = 0; i < sorted_.size(); ++i)
      lanes_[lane][i] = lane < 3 ? sorted_[i].mean[axis] : sorted_[i].normal[axis];
  }
}

SurfelIndex::Nearest SurfelIndex::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const {
  if (finer_ != nullptr)
    if (const Nearest near = finer_->nearest(point, normal); near.surfel != nullptr) return near;
  const Eigen::Vector3f at = point * per_m_;
  if (!(at.cwiseAbs().maxCoeff() < static_cast<float>(kFarthestCell - 1))) return {};
  const Cell own = toCell(point, per_m_);
  const Eigen::Vector3f within =
      at - Eigen::Vector3f(static_cast<float>(own.x), static_cast<float>(own.y), static_cast<float>(own.z));
  const Eigen::Vector3f gap = within.cwiseMin(Eigen::Vector3f::Ones() - within) / per_m_;  // m to the nearest faces
  const auto side = [](float inside) { return inside < 0.5F ? -1 : 1; };
  const Cell over{side(within.x()), side(within.y()), side(within.z())};
  const cv::v_float32x4 x0 = cv::v_setall_f32(point.x()), y0 = cv::v_setall_f32(point.y()),
                        z0 = cv::v_setall_f32(point.z()), nx = cv::v_setall_f32(normal.x()),
                        ny = cv::v_setall_f32(normal.y()), nz = cv::v_setall_f32(normal.z()),
                        least_cosine = cv::v_setall_f32(kSimilarSurface);
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
        table_.find(toKey({own.x + (x ? over.x : 0), own.y + (y ? over.y : 0), own.z + (z ? over.z : 0)}));
    if (cell == CellTable::kNone) continue;
    for (std::uint32_t i = begins_[cell]; i < begins_[cell + 1]; i += kSurfelLanes) {
      const auto lane = [&](std::size_t which) { return cv::v_load(&lanes_[which][i]); };
      const cv::v_float32x4 dx = lane(0) - x0, dy = lane(1) - y0, dz = lane(2) - z0;
      const cv::v_float32x4 squares = dx * dx + dy * dy + dz * dz;
      const cv::v_float32x4 alike = cv::v_abs(lane(3) * nx + lane(4) * ny + lane(5) * nz);
      const int near = cv::v_signmask((squares < cv::v_setall_f32(second)) & (alike > least_cosine));
      if (near == 0) continue;
      std::array<float, kSurfelLanes> distances;
      cv::v_store(distances.data(), squares);
      for (std::uint32_t k = 0; k < std::min(kSurfelLanes, begins_[cell + 1] - i); ++k) {
        const float distance = distances[k];
        if ((near >> k & 1) == 0 || !(distance < second)) continue;
        if (distance < least) {
          second = least;
          least = distance;
          best = &sorted_[i + k];
        } else {
          second = distance;
        }
      }
    }
  }
  if (best == nullptr) return {};
  return {best, 0.5F * (std::sqrt(second) - std::sqrt(least))};
}

}  // namespace urban_nav_registration
