// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/fleet_coverage.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/plot.hpp"
#include "inspect/geopackage/coverage_outline.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

constexpr double kFleetReach = 5.0, kFleetCell = 1.0;  // m: as the layer of the GeoPackage
constexpr std::size_t kDrawnMaps = 4;
constexpr std::array<const char*, 4> kRobotColours = {"a", "b", "c", "d"};

using MapKey = std::pair<std::string, std::string>;  // store, map

double cellArea(std::size_t cells) { return static_cast<double>(cells) * kFleetCell * kFleetCell; }

MapKey mapKey(const FleetSession& session) { return {session.store, session.map}; }

/// Days on which each cell of a map was seen, in the order of the sessions.
MapCoverage coverMap(const MapKey& key, const std::vector<const FleetSession*>& sessions) {
  MapCoverage coverage;
  coverage.store = key.first;
  coverage.map = key.second;
  coverage.sessions = sessions.size();
  std::map<GridCell, std::set<std::string>> seen;
  std::set<std::string> days;
  for (const FleetSession* session : sessions) {
    days.insert(session->day);
    for (const GridCell& cell : cellsAround(session->path, kFleetReach, kFleetCell)) seen[cell].insert(session->day);
  }
  coverage.days = days.size();
  coverage.last_day = days.empty() ? std::string() : *days.rbegin();
  std::size_t repeated = 0, newest = 0;
  for (const auto& [cell, of_days] : seen) {
    repeated += of_days.size() > 1 ? 1U : 0U;
    newest += of_days.size() == 1 && *of_days.begin() == coverage.last_day ? 1U : 0U;
  }
  coverage.area_m2 = cellArea(seen.size());
  coverage.repeated_m2 = cellArea(repeated);
  coverage.newest_m2 = cellArea(newest);
  return coverage;
}

std::map<MapKey, std::vector<const FleetSession*>> groupByMap(const Fleet& fleet) {
  std::map<MapKey, std::vector<const FleetSession*>> maps;
  for (const FleetSession& session : fleet.sessions) maps[mapKey(session)].push_back(&session);
  return maps;
}

Figure drawMap(const MapCoverage& coverage, const std::vector<const FleetSession*>& sessions,
               const std::vector<std::string>& robots) {
  Plot plot;
  plot.x_label = "x (m)";
  plot.y_label = "y (m)";
  plot.equal_axes = true;
  plot.height = 420;
  std::set<std::string> named;
  for (const FleetSession* session : sessions) {
    const auto robot =
        static_cast<std::size_t>(std::find(robots.begin(), robots.end(), session->session.robot) - robots.begin());
    Series series;
    if (named.insert(session->session.robot).second) series.name = session->session.robot;
    series.colour = kRobotColours[robot % kRobotColours.size()];
    for (const Eigen::Vector2d& p : session->path) series.points.push_back({p.x(), p.y()});
    plot.series.push_back(std::move(series));
  }
  return {"Map " + coverage.map.substr(0, 8) + " of " + coverage.store, renderSvg(plot),
          "Paths of its " + std::to_string(coverage.sessions) + " sessions from above, by robot.", false};
}

}  // namespace

std::vector<MapCoverage> computeCoverage(const Fleet& fleet) {
  std::vector<MapCoverage> all;
  for (const auto& [key, sessions] : groupByMap(fleet)) all.push_back(coverMap(key, sessions));
  std::stable_sort(all.begin(), all.end(),
                   [](const MapCoverage& a, const MapCoverage& b) { return a.area_m2 > b.area_m2; });
  return all;
}

Section coverageSection(const Fleet& fleet) {
  Section section;
  section.id = "coverage";
  section.title = "Coverage";
  section.introduction = "Area within 5 m of the paths of each map.";
  PageTable table{
      "Maps",
      {"map", "store", "sessions", "days", "area (m2)", "seen on several days (%)", "new on the last day (m2)"},
      {},
      ""};
  std::set<std::string> found;
  for (const FleetSession& session : fleet.sessions) found.insert(session.session.robot);
  const std::vector<std::string> robots(found.begin(), found.end());
  const auto maps = groupByMap(fleet);
  for (const MapCoverage& each : computeCoverage(fleet)) {
    const double share = each.area_m2 > 0.0 ? 100.0 * each.repeated_m2 / each.area_m2 : 0.0;
    table.rows.push_back({each.map.substr(0, 8), each.store, std::to_string(each.sessions), std::to_string(each.days),
                          urban_nav_core::formatNumber(each.area_m2, 4), urban_nav_core::formatNumber(share, 3),
                          urban_nav_core::formatNumber(each.newest_m2, 4) + " on " + each.last_day});
    if (section.figures.size() < kDrawnMaps)
      section.figures.push_back(drawMap(each, maps.at({each.store, each.map}), robots));
  }
  section.tables.push_back(std::move(table));
  return section;
}

Json coverageJson(const Fleet& fleet) {
  Json maps = Json::array();
  for (const MapCoverage& each : computeCoverage(fleet))
    maps.append(Json::object({{"map", each.map},
                              {"store", each.store},
                              {"sessions", static_cast<std::int64_t>(each.sessions)},
                              {"days", static_cast<std::int64_t>(each.days)},
                              {"area_m2", each.area_m2},
                              {"repeated_m2", each.repeated_m2},
                              {"newest_m2", each.newest_m2}}));
  return maps;
}

}  // namespace urban_nav
