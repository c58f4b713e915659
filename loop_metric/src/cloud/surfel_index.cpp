// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/surfel_index.hpp"

namespace loop_metric {

namespace {
constexpr float kAlike = 0.70710678F;  // cosine of 45 deg: nearer to this surface than to one across it
}

// Cells of twice the reach: the eight around the corner next to a point hold all that is within reach.
SurfelIndex::SurfelIndex(const std::vector<Surfel>& surfels, float reach)
    : reach_(reach), per_m_(0.5F / reach), table_(surfels.size() / 4 + 16) {
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

const Surfel* SurfelIndex::nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const {
  const Eigen::Vector3f shifted = point - Eigen::Vector3f::Constant(reach_);
  const float limit = static_cast<float>(kFarthestCell);
  if (!((shifted * per_m_).cwiseAbs().maxCoeff() < limit)) return nullptr;
  const Cell corner = cellOf(shifted, per_m_);
  const Surfel* best = nullptr;
  float least = reach_ * reach_;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const std::uint32_t cell = table_.find(keyOf({corner.x + i, corner.y + j, corner.z + k}));
        if (cell == CellTable::none) continue;
        for (std::uint32_t at = begins_[cell]; at < begins_[cell + 1]; ++at) {
          const float distance = (sorted_[at].mean - point).squaredNorm();
          if (distance < least && std::abs(sorted_[at].normal.dot(normal)) > kAlike) {
            least = distance;
            best = &sorted_[at];
          }
        }
      }
  return best;
}

}  // namespace loop_metric
