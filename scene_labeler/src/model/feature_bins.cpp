// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/feature_bins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

constexpr std::size_t kMostEdges = FeatureBins::kCodeCount - 2;

std::vector<float> quantileEdges(std::vector<float> values) {
  std::sort(values.begin(), values.end());
  std::vector<float> edges;
  for (std::size_t i = 0; i < kMostEdges && !values.empty(); ++i) {
    const std::size_t at = (i + 1) * values.size() / (kMostEdges + 1);
    const float edge = values[std::min(at, values.size() - 1)];
    if (edge > values.front() && (edges.empty() || edge > edges.back())) edges.push_back(edge);
  }
  return edges;
}

}  // namespace

FeatureBins::FeatureBins(const std::vector<float>& values, std::size_t columns) : edges_(columns) {
  const std::size_t rows = columns == 0 ? 0 : values.size() / columns;
  urban_nav_core::forEach(columns, 1, [&](std::size_t column) {
    std::vector<float> present;
    for (std::size_t row = 0; row < rows; ++row)
      if (const float value = values[row * columns + column]; !std::isnan(value)) present.push_back(value);
    edges_[column] = quantileEdges(std::move(present));
  });
}

std::uint8_t FeatureBins::code(std::size_t column, float value) const {
  if (std::isnan(value)) return 0;
  const std::vector<float>& edges = edges_[column];
  return static_cast<std::uint8_t>(1 + (std::upper_bound(edges.begin(), edges.end(), value) - edges.begin()));
}

void FeatureBins::encode(const float* row, std::uint8_t* codes) const {
  for (std::size_t column = 0; column < edges_.size(); ++column) codes[column] = code(column, row[column]);
}

float FeatureBins::decode(std::size_t column, std::uint8_t code) const {
  const std::vector<float>& edges = edges_[column];
  if (code == 0) return std::numeric_limits<float>::quiet_NaN();
  if (edges.empty()) return 0.0F;
  if (code == 1) return edges.front() - std::max(1e-6F, 1e-3F * std::abs(edges.front()));
  return edges[std::min<std::size_t>(code - 2U, edges.size() - 1)];
}

void FeatureBins::archive(urban_nav_core::Archive& archive) {
  archive(edges_);
  bool is_sound = edges_.size() <= 255;
  for (const std::vector<float>& edges : edges_)
    is_sound = is_sound && edges.size() <= kMostEdges && std::is_sorted(edges.begin(), edges.end());
  archive.require(is_sound, "its feature edges do not ascend");
}

}  // namespace scene_labeler
