// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/retrieval/cloud_descriptor.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_registration {

namespace {

constexpr float kLowest = 0.1F, kHighest = 10.0F;  // m above the ground, of a bin with returns
constexpr double kGroundShare = 0.05;              // share of the returns below the ground
constexpr std::size_t kSeenBins = 5;               // of a direction with returns

/// Returns the height of the ground: a low quantile of the returns.
float groundHeight(const urban_nav_core::PointCloud& cloud) {
  std::vector<float> heights;
  for (const Eigen::Vector3f& p : cloud.points)
    if (p.allFinite()) heights.push_back(p.z());
  if (heights.empty()) return 0.0F;
  const auto place = static_cast<std::ptrdiff_t>(kGroundShare * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), heights.begin() + place, heights.end());
  return heights[static_cast<std::size_t>(place)];
}

}  // namespace

std::optional<CloudDescriptor> CloudDescriptor::describe(const urban_nav_core::PointCloud& cloud) {
  CloudDescriptor descriptor;
  const float ground = groundHeight(cloud);
  constexpr auto kFarthest = static_cast<float>(kReach);
  for (const Eigen::Vector3f& p : cloud.points) {
    const float distance = p.head<2>().norm();
    if (!p.allFinite() || !(distance < kFarthest)) continue;
    const auto ring = static_cast<std::size_t>(distance / kFarthest * static_cast<float>(kDistances));
    const double turn = (std::atan2(static_cast<double>(p.y()), static_cast<double>(p.x())) + M_PI) / (2.0 * M_PI);
    const auto direction = std::min(kDirections - 1, static_cast<std::size_t>(turn * static_cast<double>(kDirections)));
    float& height = descriptor.columns_[direction][std::min(kDistances - 1, ring)];
    height = std::max(height, std::clamp(p.z() - ground, kLowest, kHighest));
  }
  std::size_t seen = 0;
  for (std::size_t i = 0; i < kDirections; ++i) {
    Column& column = descriptor.columns_[i];
    float squares = 0.0F;
    std::size_t bins = 0;
    for (std::size_t k = 0; k < kDistances; ++k) {
      descriptor.profile_[k] += column[k] / static_cast<float>(kDirections);
      squares += column[k] * column[k];
      bins += column[k] > 0.0F ? 1 : 0;
    }
    descriptor.is_seen_[i] = bins > 0;
    seen += bins >= kSeenBins ? 1 : 0;
    for (float& height : column) height /= std::sqrt(std::max(1e-12F, squares));
  }
  if (10 * seen < kDirections) return std::nullopt;
  return descriptor;
}

double CloudDescriptor::similarity(const CloudDescriptor& other) const {
  double best = 0.0;
  for (std::size_t turn = 0; turn < kDirections; ++turn) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < kDirections; ++i) {
      const std::size_t j = (i + turn) % kDirections;
      if (!is_seen_[i] && !other.is_seen_[j]) continue;
      ++count;
      float product = 0.0F;  // zero if one of the two is not seen
      for (std::size_t k = 0; k < kDistances; ++k) product += columns_[i][k] * other.columns_[j][k];
      sum += static_cast<double>(product);
    }
    if (count > 0) best = std::max(best, sum / static_cast<double>(count));
  }
  return best;
}

double CloudDescriptor::profileDifference(const CloudDescriptor& other) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < kDistances; ++k) sum += static_cast<double>(std::abs(profile_[k] - other.profile_[k]));
  return sum / static_cast<double>(kDistances);
}

}  // namespace urban_nav_registration
