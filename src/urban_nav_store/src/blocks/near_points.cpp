// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/tables/near_points.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

namespace {

constexpr std::size_t kNearPointBytes = 9;
constexpr float kUnitsPerMetre = 4000.0F, kSigmaUnitsPerMetre = 1e4F;
constexpr float kMostUnits = 32767.0F, kMostSigmaUnits = 65535.0F;

void append16(std::string& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<char>(value & 0xffU));
  bytes.push_back(static_cast<char>(value >> 8U));
}

std::uint16_t read16(const char* bytes) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[0]) | static_cast<unsigned char>(bytes[1]) << 8U);
}

}  // namespace

std::string NearPoints::pack(const std::vector<Point>& points) {
  std::string bytes;
  bytes.reserve(points.size() * kNearPointBytes);
  for (const Point& point : points) {
    const Eigen::Vector3f units = point.p_base * kUnitsPerMetre;
    if (!(units.cwiseAbs().maxCoeff() <= kMostUnits) || !(point.sigma >= 0.0F)) continue;
    for (int axis = 0; axis < 3; ++axis)
      append16(bytes, static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(units[axis]))));
    append16(bytes, static_cast<std::uint16_t>(
                        std::lround(std::clamp(point.sigma * kSigmaUnitsPerMetre, 1.0F, kMostSigmaUnits))));
    bytes.push_back(static_cast<char>(point.grey));
  }
  return bytes;
}

std::vector<NearPoints::Point> NearPoints::points() const {
  if (packed.size() % kNearPointBytes != 0)
    throw urban_nav_core::DataError("near_points", std::to_string(packed.size()) + " bytes of points",
                                    "a multiple of " + std::to_string(kNearPointBytes));
  std::vector<Point> points(packed.size() / kNearPointBytes);
  const char* bytes = packed.data();
  for (Point& point : points) {
    for (int axis = 0; axis < 3; ++axis)
      point.p_base[axis] = static_cast<float>(static_cast<std::int16_t>(read16(bytes + 2 * axis))) / kUnitsPerMetre;
    point.sigma = static_cast<float>(read16(bytes + 6)) / kSigmaUnitsPerMetre;
    point.grey = static_cast<std::uint8_t>(bytes[8]);
    bytes += kNearPointBytes;
  }
  return points;
}

Eigen::Matrix3d NearPoints::covariance(const Point& point) const {
  const Eigen::Vector3d ray = point.p_base.cast<double>() - camera;
  const double range = std::max(ray.norm(), 1e-6), across = range * pixel_angle / std::sqrt(12.0);
  const Eigen::Vector3d sight = ray / range;
  const double along = static_cast<double>(point.sigma);
  const Eigen::Matrix3d outer = sight * sight.transpose();
  return along * along * outer + across * across * (Eigen::Matrix3d::Identity() - outer);
}

}  // namespace urban_nav_store
