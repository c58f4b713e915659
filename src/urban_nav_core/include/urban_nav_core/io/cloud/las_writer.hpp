// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/cloud/record_file.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Point of a LAS file.
struct LasPoint {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m
  std::uint16_t intensity = 0;
  std::uint8_t classification = 1;  ///< ASPRS standard classes: 1 unclassified
  std::uint8_t channel = 0;         ///< scanner channel, 0...3
  std::uint16_t source = 1;         ///< point source ID
  StampNs stamp = 0;                ///< UTC since the Unix epoch
  std::uint16_t red = 0, green = 0, blue = 0;
};

/// Attribute of the points beyond those of the format ("extra bytes").
struct LasAttribute {
  enum class Type : std::uint8_t { UChar = 1, UShort = 3, Float = 9 };
  std::string name;  ///< at most 31 characters
  Type type = Type::Float;
  std::string description;  ///< at most 31 characters
};

/// Returns GPS time in seconds since 1980-01-06; leap seconds up to 2017 are included.
double gpsSeconds(StampNs utc);

/// Writes a LAS 1.4 file of point format 7 (ASPRS, LAS Specification 1.4 R15) whose number of points need not be known
/// in advance: adjusted standard GPS times, 16-bit colours, attributes as extra bytes, the coordinate system as WKT.
/// Every point is a single return. Coordinates are rounded to 0.1 mm, relative to whole kilometres near the first
/// point. The file's date is that of its last point. The file is written completely or not at all. Not thread-safe.
/// Throws UserError or DataError naming the path, DataError for points that are not finite or more than 200 km from the
/// first one.
class LasWriter {
 public:
  LasWriter(const std::string& path, std::vector<LasAttribute> attributes, std::string wkt);

  /// `attributes`: values in little-endian order without padding.
  void append(const LasPoint& point, std::string_view attributes);
  std::size_t points() const { return file_.records(); }
  /// Writes the header and renames the file to its final name.
  void commit();

 private:
  std::string header() const;

  std::string path_;
  std::vector<LasAttribute> attributes_;
  std::string wkt_;
  RecordFile file_;
  std::string record_;  ///< the point being appended
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  std::array<std::int32_t, 3> low_{}, high_{};  ///< bounds of the stored coordinates
  StampNs last_ = 0;
};

}  // namespace urban_nav_core
