// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/cloud_units.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::CloudFile;
using urban_nav_core::formatNumber;

namespace {

constexpr std::size_t kQueries = 200;
constexpr float kWidestSpacing = 1.0F;  // m, between neighbours, median of a cloud in metres
constexpr double kFarApart = 1000.0;    // m, in addition to the extent of the clouds
constexpr float kOtherScale = 30.0F;    // ratio of the spacings of one cloud in metres and one in centimetres

/// Returns the median distance from a point to its nearest neighbour, in the unit of the file; 0 for fewer than two.
float medianSpacing(const urban_nav_core::PointCloud& cloud) {
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& point : cloud.points)
    if (point.allFinite()) points.push_back(point);
  if (points.size() < 2) return 0.0F;
  std::vector<float> distances;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kQueries);
  for (std::size_t i = 0; i < points.size(); i += stride) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j)
      if (j != i) least = std::min(least, (points[j] - points[i]).squaredNorm());
    distances.push_back(std::sqrt(least));
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

double largestRadius(const urban_nav_core::PointCloud& cloud) {
  float radius = 0.0F;
  for (const Eigen::Vector3f& point : cloud.points)
    if (point.allFinite()) radius = std::max(radius, point.norm());
  return static_cast<double>(radius);
}

std::string describeSpacing(float spacing) {
  const bool is_millimetres = 0.01F * spacing > kWidestSpacing;
  return "points are " + formatNumber(static_cast<double>(spacing), 3) + " apart (median), as for coordinates in " +
         (is_millimetres ? "millimetres" : "centimetres") + ": give both clouds in metres (multiplied by " +
         (is_millimetres ? "0.001" : "0.01") + ")";
}

}  // namespace

std::string describeUnits(const CloudFile& source, const CloudFile& target) {
  const float a = medianSpacing(source.cloud), b = medianSpacing(target.cloud);
  if (a > kOtherScale * b || b > kOtherScale * a)
    return "points are " + formatNumber(static_cast<double>(a), 3) + " apart in the source and " +
           formatNumber(static_cast<double>(b), 3) + " in the target (median): their units differ; give both in metres";
  if (std::min(a, b) > kWidestSpacing) return describeSpacing(std::min(a, b));
  const double apart = (target.offset - source.offset).norm();
  if (apart > kFarApart + largestRadius(source.cloud) + largestRadius(target.cloud))
    return "their centres are " + formatNumber(1e-3 * apart, 5) +
           " km apart, as local coordinates and UTM: give both in one frame, or --initial FILE";
  return {};
}

}  // namespace urban_nav
