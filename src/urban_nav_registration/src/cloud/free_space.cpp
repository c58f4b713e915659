// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/cloud/free_space.hpp"

#include <algorithm>

namespace urban_nav_registration {

using urban_nav_core::PointCloud;

namespace {

constexpr std::size_t kWide = 128, kHigh = 64;  // cubes: 64 m by 64 m by 32 m for cubes of half a metre
constexpr std::size_t kAcross = kWide, kAbove = kWide * kWide;
constexpr std::uint8_t kOccupied = 255;
constexpr std::uint8_t kFewest = 2;         // beams: a single one may have passed at the cube's edge
constexpr std::size_t kMostBeams = 40'000;  // two lasers with 181 beams in each of 100 scans over 20 m
constexpr float kBeforeTheEnd = 2.0F;       // edges before the end of a beam

}  // namespace

FreeSpace::FreeSpace(const PointCloud& cloud, float edge) : per_m_(1.0F / edge), beams_(kAbove * kHigh, 0) {
  const std::size_t count = std::min(cloud.points.size(), cloud.origins.size());
  for (const Eigen::Vector3f& point : cloud.points) mark(findCube(point));
  const std::size_t step = std::max<std::size_t>(1, (count + kMostBeams - 1) / kMostBeams);
  for (std::size_t i = 0; i < count; i += step) {
    const Eigen::Vector3f beam = cloud.points[i] - cloud.origins[i];
    const float length = beam.norm();
    if (!(length < 200.0F)) continue;  // NaN too
    const Eigen::Vector3f along = beam * (edge / std::max(length, edge));
    Eigen::Vector3f at = cloud.origins[i] + 0.5F * along;
    for (float left = length - 0.5F * edge; left > kBeforeTheEnd * edge; left -= edge, at += along) {
      const std::size_t cube = findCube(at);
      if (cube != kNone && beams_[cube] < kOccupied - 1) ++beams_[cube];
    }
  }
}

std::size_t FreeSpace::findCube(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f at =
      point * per_m_ + Eigen::Vector3f(0.5F * static_cast<float>(kWide), 0.5F * static_cast<float>(kWide),
                                       0.5F * static_cast<float>(kHigh));
  const auto within = [](float value, std::size_t most) {
    return value >= 1.0F && value < static_cast<float>(most - 1);
  };
  if (!within(at.x(), kWide) || !within(at.y(), kWide) || !within(at.z(), kHigh)) return kNone;
  return static_cast<std::size_t>(at.x()) + kAcross * static_cast<std::size_t>(at.y()) +
         kAbove * static_cast<std::size_t>(at.z());
}

void FreeSpace::mark(std::size_t cube) {
  if (cube == kNone) return;
  for (std::size_t k = cube - kAbove; k <= cube + kAbove; k += kAbove)
    for (std::size_t j = k - kAcross; j <= k + kAcross; j += kAcross)
      for (std::size_t i = j - 1; i <= j + 1; ++i) beams_[i] = kOccupied;
}

bool FreeSpace::isFree(const Eigen::Vector3f& point) const {
  const std::size_t cube = findCube(point);
  return cube != kNone && beams_[cube] >= kFewest && beams_[cube] != kOccupied;
}

}  // namespace urban_nav_registration
