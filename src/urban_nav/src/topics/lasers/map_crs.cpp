// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_crs.hpp"

#include <array>
#include <cmath>

#include "base/plot.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_fix.hpp"

namespace urban_nav {

using laser_mapper::AntennaFix;
using urban_nav_core::Vector3d;
using urban_nav_store::StoredFix;

namespace {

constexpr urban_nav_core::StampNs kLongestFixGap = 500'000'000;
constexpr double kToRad = M_PI / 180.0;
constexpr const char* kWithoutCrs = "no --crs: coordinates of the frame map";

std::vector<AntennaFix> antennaFixes(urban_nav_store::Store& store,
                                     const std::vector<urban_nav_store::StoredTrajectory>& map, std::size_t& stored) {
  std::vector<AntennaFix> fixes;
  for (const urban_nav_store::StoredTrajectory& each : map) {
    const urban_nav_core::Trajectory trajectory(each.T_map_base);
    urban_nav_store::TableStore<StoredFix>(store).forEach(each.session.id, [&](const StoredFix& row) {
      ++stored;
      const auto T_map_base = trajectory.empty() ? std::nullopt : trajectory.at(row.stamp, kLongestFixGap);
      if (!T_map_base) return;
      fixes.push_back({row.stamp,
                       *T_map_base * Vector3d(row.x, row.y, row.z),
                       {kToRad * row.latitude, kToRad * row.longitude, row.height},
                       {row.sigma_east, row.sigma_north, row.sigma_up}});
    });
  }
  return fixes;
}

}  // namespace

int parseCrs(const std::string& crs) {
  if (crs == "auto") return 0;
  const auto code = crs.rfind("EPSG:", 0) == 0 ? urban_nav_core::parseInteger(crs.substr(5)) : std::nullopt;
  if (!code || *code < 1 || *code > 999999) throw urban_nav_core::UserError("--crs", crs, "auto, or EPSG:N");
  return static_cast<int>(*code);
}

std::vector<laser_mapper::ControlPoint> readControlPoints(const std::string& file,
                                                          const laser_mapper::MapProjection& projection) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(file);
  std::vector<laser_mapper::ControlPoint> points;
  const auto vectorAt = [&](std::size_t row, const std::array<const char*, 3>& columns) {
    Vector3d p;
    for (std::size_t i = 0; i < 3; ++i) p(static_cast<int>(i)) = table.number(row, table.column(columns[i]));
    return p;
  };
  for (std::size_t row = 0; row < table.rows(); ++row)
    points.push_back({table.text(row, table.column("name")), projection.unproject(vectorAt(row, {"x", "y", "z"})),
                      vectorAt(row, {"map_x", "map_y", "map_z"})});
  return points;
}

MapCrs::MapCrs(const std::string& crs, const std::string& control, urban_nav_store::Store& store,
               const std::vector<urban_nav_store::StoredTrajectory>& map)
    : epsg_(parseCrs(crs)) {
  if (!control.empty() && epsg_ == 0)
    throw urban_nav_core::UserError("--control", "--crs " + crs, "--crs EPSG:N, the system of the surveyed points");
  if (epsg_ != 0) projection_ = std::make_unique<laser_mapper::MapProjection>(epsg_, "--crs");
  const laser_mapper::GeoFit fit = control.empty() ? fitFixes(store, map) : fitControl(control);
  if (!fit.reference)
    throw control.empty()
        ? urban_nav_core::DataError("--crs " + crs, fit.reason, kWithoutCrs)
        : urban_nav_core::DataError(control, fit.reason, "metres east, north, up and their place in map");
  reference_ = *fit.reference;
  tangent_.emplace(reference_.origin);
  if (projection_) return;
  epsg_ = laser_mapper::utmZoneCode(reference_.origin);
  if (epsg_ == 0) throw urban_nav_core::DataError("--crs auto", "there is no UTM zone so near to a pole", "EPSG:N");
  projection_ = std::make_unique<laser_mapper::MapProjection>(epsg_, "--crs");
}

laser_mapper::GeoFit MapCrs::fitFixes(urban_nav_store::Store& store,
                                      const std::vector<urban_nav_store::StoredTrajectory>& map) const {
  std::size_t stored = 0;
  const std::vector<AntennaFix> fixes = antennaFixes(store, map, stored);
  if (stored == 0) return {std::nullopt, "the store holds no GPS fixes to place the map by"};
  return laser_mapper::fitGeoReference(fixes);
}

laser_mapper::GeoFit MapCrs::fitControl(const std::string& file) {
  const std::vector<laser_mapper::ControlPoint> points = readControlPoints(file, *projection_);
  const laser_mapper::ControlFit fit = laser_mapper::fitControlPoints(points);
  for (std::size_t i = 0; i < fit.errors.size(); ++i) control_.push_back({points[i].name, fit.errors[i]});
  return fit.fit;
}

Vector3d MapCrs::project(const Vector3d& p_map) const {
  return projection_->project(tangent_->toGeodetic(reference_.T_local_map * p_map));
}

Vector3d MapCrs::toMap(const laser_mapper::Geodetic& position) const {
  return reference_.T_local_map.inverse() * tangent_->toLocal(position);
}

Vector3d MapCrs::unproject(const Vector3d& p) const { return toMap(projection_->unproject(p)); }

std::string MapCrs::describe() const {
  return "EPSG:" + std::to_string(epsg_) + " (" + projection_->name() + "), " + std::to_string(reference_.fixes) +
         (control_.empty() ? " GPS fixes" : " surveyed points") + ", median distance " +
         urban_nav_core::formatNumber(reference_.residual, 2) + " m; standard deviations: position " +
         urban_nav_core::formatNumber(reference_.position_sigma, 2) + " m, height " +
         urban_nav_core::formatNumber(reference_.height_sigma, 2) + " m, heading " +
         urban_nav_core::formatNumber(reference_.heading_sigma / kToRad, 2) + " deg";
}

}  // namespace urban_nav
