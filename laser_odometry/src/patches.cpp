// SPDX-License-Identifier: BSD-3-Clause
#include "patches.hpp"

#include <optional>

#include "surface_map.hpp"

namespace laser_odometry {

std::vector<Patch> makePatches(const std::vector<Vector3d>& points, const std::vector<float>& times, double size) {
  struct Part {
    Vector3d origin;  // the first point, so that sums remain small
    Moments moments;
    double time = 0.0, half_square = 0.0;  // sums, s and s^2
  };
  std::vector<Part> parts;
  urban_nav_registration::CellTable table(points.size() / 4 + 64);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d& p = points[i];
    const std::optional<std::uint64_t> key = findKey(p, size);
    if (!key) continue;
    const std::uint32_t number = table.insert(*key);
    if (number == parts.size()) parts.push_back({p, {}, 0.0, 0.0});
    parts[number].moments.add(p - parts[number].origin);
    const double time = static_cast<double>(times[i]);
    parts[number].time += time;
    parts[number].half_square += 0.5 * time * time;
  }
  std::vector<Patch> patches;
  patches.reserve(parts.size());
  for (const Part& part : parts)
    patches.push_back({part.origin + part.moments.mean(), part.moments.covariance(), part.moments.count,
                       part.time / part.moments.count, part.half_square / part.moments.count});
  return patches;
}

}  // namespace laser_odometry
