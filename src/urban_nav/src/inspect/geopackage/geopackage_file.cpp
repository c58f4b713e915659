// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/geopackage/geopackage_file.hpp"

#include <sqlite3.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

// OGC 12-128r17: requirements 2 and 19, table 1.
constexpr std::uint32_t kApplicationId = 0x47504B47;  // "GPKG"
constexpr int kVersion = 10300;
constexpr int kCartesian = -1;  // srs_id of a system without geodetic reference
constexpr std::uint32_t kWkbPointZ = 1001, kWkbLineZ = 1002, kWkbPolygon = 3, kWkbMultiPolygon = 6;

constexpr const char* kTables =
    "CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY, organization TEXT "
    "NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);"
    "CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT "
    "UNIQUE, "
    "description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')), min_x "
    "DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER, CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) "
    "REFERENCES gpkg_spatial_ref_sys(srs_id));"
    "CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT "
    "NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL, CONSTRAINT pk_geom_cols PRIMARY KEY "
    "(table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name), CONSTRAINT fk_gc_tn FOREIGN KEY "
    "(table_name) REFERENCES gpkg_contents(table_name), CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES "
    "gpkg_spatial_ref_sys(srs_id));";
// The three systems of requirement 11.
constexpr const char* kSystems =
    "INSERT INTO gpkg_spatial_ref_sys VALUES('Undefined Cartesian SRS',-1,'NONE',-1,'undefined','the frame map: m');"
    "INSERT INTO gpkg_spatial_ref_sys VALUES('Undefined geographic SRS',0,'NONE',0,'undefined',NULL);"
    "INSERT INTO gpkg_spatial_ref_sys VALUES('WGS 84',4326,'EPSG',4326,'GEOGCS[\"WGS "
    "84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
    "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]',NULL);";

template <typename Number>
void append(std::string& bytes, Number value) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));  // little-endian, as all hosts of the suite
  bytes.append(raw, sizeof(Number));
}

void appendHead(std::string& bytes, std::uint32_t kind) {
  bytes += '\1';  // little-endian
  append(bytes, kind);
}

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

const char* wordFor(GeoPackageFile::ColumnType type) {
  if (type == GeoPackageFile::ColumnType::Text) return "TEXT";
  return type == GeoPackageFile::ColumnType::Integer ? "INTEGER" : "DOUBLE";
}

}  // namespace

Geometry Geometry::point(const Point& p) {
  Geometry geometry;
  geometry.has_envelope_ = false;
  geometry.box_.extend(p.head<2>());
  appendHead(geometry.wkb_, kWkbPointZ);
  for (int i = 0; i < 3; ++i) append(geometry.wkb_, p(i));
  return geometry;
}

Geometry Geometry::line(const std::vector<Point>& points) {
  Geometry geometry;
  appendHead(geometry.wkb_, kWkbLineZ);
  append(geometry.wkb_, static_cast<std::uint32_t>(points.size()));
  for (const Point& p : points) {
    geometry.box_.extend(p.head<2>());
    for (int i = 0; i < 3; ++i) append(geometry.wkb_, p(i));
  }
  return geometry;
}

Geometry Geometry::polygons(const std::vector<Polygon>& polygons) {
  Geometry geometry;
  appendHead(geometry.wkb_, kWkbMultiPolygon);
  append(geometry.wkb_, static_cast<std::uint32_t>(polygons.size()));
  for (const Polygon& polygon : polygons) {
    appendHead(geometry.wkb_, kWkbPolygon);
    append(geometry.wkb_, static_cast<std::uint32_t>(polygon.size()));
    for (const Ring& ring : polygon) {
      append(geometry.wkb_, static_cast<std::uint32_t>(ring.size() + 1));
      for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Eigen::Vector2d& p = ring[i % ring.size()];
        geometry.box_.extend(p);
        append(geometry.wkb_, p.x());
        append(geometry.wkb_, p.y());
      }
    }
  }
  return geometry;
}

std::string Geometry::bytes(int srs_id) const {
  const bool is_empty = box_.isEmpty();
  const bool writes_envelope = has_envelope_ && !is_empty;
  std::string all = "GP";
  all += '\0';                                                                    // version 1
  all += static_cast<char>(1 | (writes_envelope ? 2 : 0) | (is_empty ? 16 : 0));  // little-endian, envelope of x and y
  append(all, static_cast<std::int32_t>(srs_id));
  if (writes_envelope)
    for (int axis = 0; axis < 2; ++axis) {
      append(all, box_.min()(axis));
      append(all, box_.max()(axis));
    }
  return all + wkb_;
}

class GeoPackageFile::Implementation {
 public:
  Implementation(const std::string& path, LayerCrs crs, std::string changed)
      : path_(path), partial_(path, ".part"), crs_(std::move(crs)), changed_(std::move(changed)) {
    std::error_code ignored;
    std::filesystem::remove(partial_.path(), ignored);  // left by a killed process
    if (sqlite3_open_v2(partial_.path().c_str(), &file_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr) !=
        SQLITE_OK)
      fail();
    execute("PRAGMA journal_mode=MEMORY");
    execute("PRAGMA application_id=" + std::to_string(kApplicationId));
    execute("PRAGMA user_version=" + std::to_string(kVersion));
    execute("BEGIN");
    execute(kTables);
    execute(kSystems);
    if (crs_.epsg != 0 && crs_.epsg != 4326)
      run("INSERT INTO gpkg_spatial_ref_sys VALUES(?,?,'EPSG',?,?,NULL)",
          {"EPSG:" + std::to_string(crs_.epsg), std::int64_t{crs_.epsg}, std::int64_t{crs_.epsg}, crs_.wkt});
  }
  ~Implementation() { close(); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void addLayer(const std::string& name, const std::string& geometry, bool has_z, const std::vector<Column>& columns) {
    finishLayer();
    layer_ = name;
    box_ = Eigen::AlignedBox2d();
    std::string sql =
        "CREATE TABLE " + quoted(name) + " (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom " + geometry;
    insert_ = "INSERT INTO " + quoted(name) + " VALUES(NULL,?";
    for (const Column& column : columns) {
      sql += ", " + quoted(column.name) + " " + wordFor(column.type);
      insert_ += ",?";
    }
    insert_ += ")";
    execute(sql + ")");
    run("INSERT INTO gpkg_contents (table_name,data_type,identifier,last_change,srs_id) VALUES(?,'features',?,?,?)",
        {name, name, changed_, std::int64_t{srsId()}});
    run("INSERT INTO gpkg_geometry_columns VALUES(?,'geom',?,?,?,0)",
        {name, geometry, std::int64_t{srsId()}, std::int64_t{has_z ? 1 : 0}});
  }

  void addFeature(const Geometry& geometry, const Eigen::AlignedBox2d& box, const std::vector<Value>& values) {
    if (!box.isEmpty()) box_.extend(box);
    run(insert_, values, geometry.bytes(srsId()));
  }

  void commit() {
    finishLayer();
    execute("COMMIT");
    close();
    partial_.commit();
  }

 private:
  int srsId() const { return crs_.epsg == 0 ? kCartesian : crs_.epsg; }

  void finishLayer() {
    if (!layer_.empty() && !box_.isEmpty())
      run("UPDATE gpkg_contents SET min_x=?, min_y=?, max_x=?, max_y=? WHERE table_name=?",
          {box_.min().x(), box_.min().y(), box_.max().x(), box_.max().y(), layer_});
  }

  void execute(const std::string& sql) {
    if (sqlite3_exec(file_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }

  /// Runs a statement with a BLOB, if there is one, and values bound in order.
  void run(const std::string& sql, const std::vector<Value>& values, const std::optional<std::string>& blob = {}) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(file_, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) fail();
    int place = 1;
    if (blob) sqlite3_bind_blob64(statement, place++, blob->data(), blob->size(), SQLITE_STATIC);
    for (const Value& value : values) {
      if (const auto* text = std::get_if<std::string>(&value))
        sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_STATIC, SQLITE_UTF8);
      else if (const auto* integer = std::get_if<std::int64_t>(&value)) sqlite3_bind_int64(statement, place, *integer);
      else sqlite3_bind_double(statement, place, std::get<double>(value));
      ++place;
    }
    const bool is_done = sqlite3_step(statement) == SQLITE_DONE;
    sqlite3_finalize(statement);
    if (!is_done) fail();
  }

  [[noreturn]] void fail() const {
    throw urban_nav_core::DataError(path_, std::string("cannot be written: ") + sqlite3_errmsg(file_),
                                    "room on the disk, and a folder that can be written");
  }

  void close() {
    sqlite3_close(file_);
    file_ = nullptr;
  }

  const std::string path_;
  urban_nav_core::PartialFile partial_;
  const LayerCrs crs_;
  const std::string changed_;
  sqlite3* file_ = nullptr;
  std::string layer_, insert_;  // of the layer that was added last
  Eigen::AlignedBox2d box_;     // of its features
};

GeoPackageFile::GeoPackageFile(const std::string& path, LayerCrs crs, std::string changed)
    : implementation_(std::make_unique<Implementation>(path, std::move(crs), std::move(changed))) {}
GeoPackageFile::~GeoPackageFile() = default;

void GeoPackageFile::addLayer(const std::string& name, const std::string& geometry, bool has_z,
                              const std::vector<Column>& columns) {
  implementation_->addLayer(name, geometry, has_z, columns);
}

void GeoPackageFile::addFeature(const Geometry& geometry, const std::vector<Value>& values) {
  implementation_->addFeature(geometry, geometry.box_, values);
}

void GeoPackageFile::commit() { implementation_->commit(); }

}  // namespace urban_nav
