// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav {

/// Coordinate reference system of all layers of a GeoPackage.
struct LayerCrs {
  int epsg = 0;     ///< 0: the frame `map`, a Cartesian system without geodetic reference (srs_id -1)
  std::string wkt;  ///< definition; empty without a code
};

/// A geometry as GeoPackage stores it: header, envelope and well-known binary.
class Geometry {
 public:
  using Point = urban_nav_core::Vector3d;
  /// Vertices of a closed polygon; the first one is not repeated.
  using Ring = std::vector<Eigen::Vector2d>;
  /// The outer ring, counter-clockwise, then its holes, clockwise.
  using Polygon = std::vector<Ring>;

  static Geometry point(const Point& p);
  static Geometry line(const std::vector<Point>& points);
  static Geometry polygons(const std::vector<Polygon>& polygons);

  /// Returns the bytes of the BLOB, little-endian.
  std::string bytes(int srs_id) const;

 private:
  std::string wkb_;
  Eigen::AlignedBox2d box_;
  bool has_envelope_ = true;
  friend class GeoPackageFile;
};

/// Writes a GeoPackage 1.3 (OGC 12-128r17): an SQLite file with layers of features. The same calls give the same bytes.
/// Not thread-safe.
class GeoPackageFile {
 public:
  enum class ColumnType { Text, Integer, Real };
  struct Column {
    std::string name;
    ColumnType type;
  };
  using Value = std::variant<std::string, std::int64_t, double>;

  /// `changed`: time of the last change of each layer, ISO 8601. Throws UserError if the file cannot be written.
  GeoPackageFile(const std::string& path, LayerCrs crs, std::string changed);
  ~GeoPackageFile();
  GeoPackageFile(const GeoPackageFile&) = delete;
  GeoPackageFile& operator=(const GeoPackageFile&) = delete;

  /// Adds a layer. `geometry`: "POINT", "LINESTRING", "MULTIPOLYGON"; `has_z`: of all its geometries.
  void addLayer(const std::string& name, const std::string& geometry, bool has_z, const std::vector<Column>& columns);
  /// Adds a feature to the layer that was added last: one value for each of its columns.
  void addFeature(const Geometry& geometry, const std::vector<Value>& values);
  /// Completes the file, which appears atomically. Without this call there is no file.
  void commit();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav
