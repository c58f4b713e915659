// SPDX-License-Identifier: BSD-3-Clause
#include "patches.hpp"

#include <optional>

#include "surface_map.hpp"

namespace laser_odometry {

std::vector<Patch> makePatches(const std::vector<Segment>& segments, double size) {
  struct Part {
    Vector3d origin;  // mean of the first segment, so that sums remain small
    Moments moments;
    double time = 0.0, half_square = 0.0;  // sums, s and s^2
  };
  std::vector<Part> parts;
  urban_nav_registration::CellTable table(segments.size() / 2 + 64);
  for (const Segment& segment : segments) {
    const std::optional<std::uint64_t> key = findKey(segment.mean, size);
    if (!key) continue;
    const std::uint32_t number = table.insert(*key);
    if (number == parts.size()) parts.push_back({segment.mean, {}, 0.0, 0.0});
    Part& part = parts[number];
    part.moments.add(segment.count, segment.mean - part.origin, segment.covariance);
    part.time += segment.count * segment.time;
    part.half_square += segment.count * segment.half_square;
  }
  std::vector<Patch> patches;
  patches.reserve(parts.size());
  for (const Part& part : parts)
    patches.push_back({part.origin + part.moments.mean(), part.moments.covariance(), part.moments.count,
                       part.time / part.moments.count, part.half_square / part.moments.count});
  return patches;
}

}  // namespace laser_odometry
