// SPDX-License-Identifier: BSD-3-Clause
#include "patches.hpp"

#include <optional>

#include "surface_map.hpp"

namespace laser_odometry {

std::vector<Patch> makePatches(const std::vector<Vector3d>& points, double size) {
  struct Part {
    Vector3d origin;  // the first point: sums stay small
    Moments moments;
  };
  std::vector<Part> parts;
  urban_nav_registration::CellTable table(points.size() / 4 + 64);
  for (const Vector3d& p : points) {
    const std::optional<std::uint64_t> key = findKey(p, size);
    if (!key) continue;
    const std::uint32_t number = table.insert(*key);
    if (number == parts.size()) parts.push_back({p, {}});
    parts[number].moments.add(p - parts[number].origin);
  }
  std::vector<Patch> patches;
  patches.reserve(parts.size());
  for (const Part& part : parts)
    patches.push_back({part.origin + part.moments.mean(), part.moments.covariance(), part.moments.count});
  return patches;
}

}  // namespace laser_odometry
