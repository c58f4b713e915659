// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/geopackage/geopackage_file.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;

void writeLayers(const std::string& path, const LayerCrs& crs) {
  GeoPackageFile file(path, crs, "2008-11-03T13:44:33.000Z");
  file.addLayer("points", "POINT", true, {{"name", GeoPackageFile::ColumnType::Text}});
  file.addFeature(Geometry::point({1.0, 2.0, 3.0}), {std::string("it's one")});
  file.addLayer("lines", "LINESTRING", true,
                {{"n", GeoPackageFile::ColumnType::Integer}, {"x", GeoPackageFile::ColumnType::Real}});
  file.addFeature(Geometry::line({{0.0, 0.0, 0.0}, {3.0, 4.0, 0.0}}), {std::int64_t{1'000'000'000'000'000'001}, 0.5});
  file.commit();
}

/// The first column of the first row, as text.
std::string ask(const std::string& path, const std::string& sql) {
  sqlite3* file = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &file, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(file, sql.c_str(), -1, &statement, nullptr), SQLITE_OK) << sqlite3_errmsg(file);
  std::string answer;
  if (sqlite3_step(statement) == SQLITE_ROW) {
    const void* const bytes = sqlite3_column_blob(statement, 0);
    answer.assign(static_cast<const char*>(bytes), static_cast<std::size_t>(sqlite3_column_bytes(statement, 0)));
  }
  sqlite3_finalize(statement);
  sqlite3_close(file);
  return answer;
}

TEST(GeoPackage, HasTheTablesOfTheStandard) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.gpkg");
  writeLayers(path, {});
  EXPECT_EQ(ask(path, "PRAGMA application_id"), std::to_string(0x47504B47));
  EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
  EXPECT_EQ(ask(path, "PRAGMA foreign_key_check"), "");
  EXPECT_EQ(ask(path, "SELECT count(*) FROM gpkg_spatial_ref_sys WHERE srs_id IN (-1, 0, 4326)"), "3");
  EXPECT_EQ(ask(path, "SELECT group_concat(table_name || srs_id) FROM gpkg_contents"), "points-1,lines-1");
  EXPECT_EQ(ask(path, "SELECT max_x || ',' || max_y FROM gpkg_contents WHERE table_name='lines'"), "3.0,4.0");
  EXPECT_EQ(ask(path, "SELECT name FROM points"), "it's one");
  EXPECT_EQ(ask(path, "SELECT n FROM lines"), "1000000000000000001");
}

TEST(GeoPackage, GeometriesHaveHeaderEnvelopeAndBinary) {
  const TemporaryFolder folder;
  const std::string path = folder.file("map.gpkg");
  writeLayers(path, {25832, "PROJCRS[...]"});
  const std::string point = ask(path, "SELECT geom FROM points"), line = ask(path, "SELECT geom FROM lines");
  EXPECT_EQ(point.size(), 8U + 5U + 24U);
  EXPECT_EQ(point.substr(0, 4), std::string("GP\0\1", 4));
  EXPECT_EQ(line.size(), 8U + 32U + 9U + 48U);
  EXPECT_EQ(line.substr(0, 4), std::string("GP\0\3", 4));
  EXPECT_EQ(line.substr(4, 4), std::string("\xe8\x64\0\0", 4)) << "srs_id 25832";
  EXPECT_EQ(ask(path, "SELECT definition FROM gpkg_spatial_ref_sys WHERE organization_coordsys_id=25832"),
            "PROJCRS[...]");
}

TEST(GeoPackage, SameCallsGiveTheSameBytes) {
  const TemporaryFolder folder;
  writeLayers(folder.file("a.gpkg"), {});
  writeLayers(folder.file("b.gpkg"), {});
  EXPECT_TRUE(readFile(folder.file("a.gpkg")) == readFile(folder.file("b.gpkg")));
}

TEST(GeoPackage, NothingIsLeftWithoutCommit) {
  const TemporaryFolder folder;
  { const GeoPackageFile file(folder.file("map.gpkg"), {}, "2008-11-03T13:44:33.000Z"); }
  EXPECT_FALSE(std::filesystem::exists(folder.file("map.gpkg")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("map.gpkg.part")));
}

}  // namespace
}  // namespace urban_nav
