// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_crs.hpp"

#include <cmath>

#include "base/plot.hpp"
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

MapCrs::MapCrs(const std::string& crs, urban_nav_store::Store& store,
               const std::vector<urban_nav_store::StoredTrajectory>& map)
    : epsg_(parseCrs(crs)) {
  std::size_t stored = 0;
  const std::vector<AntennaFix> fixes = antennaFixes(store, map, stored);
  const std::string remedy = "no --crs: coordinates of the frame map";
  if (stored == 0)
    throw urban_nav_core::DataError("--crs " + crs, "the store holds no GPS fixes to place the map by", remedy);
  const laser_mapper::GeoFit fit = laser_mapper::fitGeoReference(fixes);
  if (!fit.reference) throw urban_nav_core::DataError("--crs " + crs, fit.reason, remedy);
  reference_ = *fit.reference;
  tangent_.emplace(reference_.origin);
  if (epsg_ == 0) epsg_ = laser_mapper::utmZoneCode(reference_.origin);
  if (epsg_ == 0) throw urban_nav_core::DataError("--crs auto", "there is no UTM zone so near to a pole", "EPSG:N");
  projection_ = std::make_unique<laser_mapper::MapProjection>(epsg_, "--crs");
}

Vector3d MapCrs::project(const Vector3d& p_map) const {
  return projection_->project(tangent_->toGeodetic(reference_.T_local_map * p_map));
}

Vector3d MapCrs::toMap(const laser_mapper::Geodetic& position) const {
  return reference_.T_local_map.inverse() * tangent_->toLocal(position);
}

std::string MapCrs::describe() const {
  return "EPSG:" + std::to_string(epsg_) + " (" + projection_->name() + "), " + std::to_string(reference_.fixes) +
         " GPS fixes, median distance " + urban_nav_core::formatNumber(reference_.residual, 2) +
         " m; standard deviations: position " + urban_nav_core::formatNumber(reference_.position_sigma, 2) +
         " m, height " + urban_nav_core::formatNumber(reference_.height_sigma, 2) + " m, heading " +
         urban_nav_core::formatNumber(reference_.heading_sigma / kToRad, 2) + " deg";
}

}  // namespace urban_nav
