// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav {

/// Digest of the positions of the points of a map, which identifies the map of stored attributes. Points are in the
/// order of the map tiles.
class MapPointsDigest {
 public:
  /// Adds points with a position `p` in floats.
  template <typename Points>
  void add(const Points& points) {
    for (const auto& point : points)
      for (const float value : {point.p.x(), point.p.y(), point.p.z()}) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash_ = (hash_ ^ bits) * 0x100000001b3U;
      }
  }
  std::int64_t value() const { return static_cast<std::int64_t>(hash_ >> 2U); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;  // FNV-1a
};

/// Attributes that a stage adds to each point of an exported map. Points are numbered in the order of the map tiles.
/// The map may have changed since they were stored: then its points have another digest or number. Functions accept any
/// number of a point.
struct PointAttributes {
  std::int64_t digest = 0;  ///< MapPointsDigest of the points that they belong to
  std::size_t points = 0;
  urban_nav_core::PlyLayout ply;  ///< properties after those of the map, and comments of the header
  urban_nav_core::LasAttribute las;
  std::function<void(std::size_t point, std::string& bytes)> append_ply;  ///< appends the values of `ply`
  std::function<void(std::size_t point, std::string& bytes)> append_las;  ///< appends the value of `las`
  std::function<std::uint8_t(std::size_t point)> las_classification;      ///< class of the ASPRS
};

}  // namespace urban_nav
