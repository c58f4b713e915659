// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/lasers_report.hpp"

#include <algorithm>
#include <cmath>

#include "base/plot.hpp"
#include "topics/lasers/calibration_report.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

constexpr double kManyMixed = 0.05, kManyWithoutPose = 0.01;  // shares worth a warning
constexpr double kDegreesPerRad = 180.0 / M_PI;

double beamShare(std::size_t part, std::size_t all) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
}

std::string beamPercent(std::size_t part, std::size_t all) {
  return urban_nav_core::formatNumber(100.0 * beamShare(part, all), 3) + " %";
}

PageTable beamsTable(const LasersRun& run) {
  const laser_mapper::BeamCounts beams = run.beams();
  const std::size_t used = beams.all - beams.mixed - beams.without_pose - beams.out_of_range - run.ghostBeams();
  return {"Use of the beams",
          {"", "beams", "share"},
          {{"with a valid range", std::to_string(beams.all), ""},
           {"in the map", std::to_string(used), beamPercent(used, beams.all)},
           {"left out: too near or too far", std::to_string(beams.out_of_range),
            beamPercent(beams.out_of_range, beams.all)},
           {"left out: between two surfaces", std::to_string(beams.mixed), beamPercent(beams.mixed, beams.all)},
           {"left out: on moving objects, which beams of other times passed through", std::to_string(run.ghostBeams()),
            beamPercent(run.ghostBeams(), beams.all)},
           {"left out: at a time without a pose", std::to_string(beams.without_pose),
            beamPercent(beams.without_pose, beams.all)}},
          ""};
}

std::string toDegrees(double rad) { return urban_nav_core::formatNumber(kDegreesPerRad * rad, 2) + " deg"; }
std::string toMillimetres(double m) { return urban_nav_core::formatNumber(1e3 * m, 3) + " mm"; }

/// Table 4 of Newman et al. 2009, with its figures.
PageTable qualityTable(const LasersRun& run) {
  const laser_mapper::QualityFigures walls = run.walls(), ground = run.ground();
  PageTable table;
  table.title = "Agreement of the passes";
  table.head = {"", "walls", "ground", "paper, walls"};
  using Spread = laser_mapper::QualityFigures::Spread;
  const auto addRow = [&](const std::string& name, double Spread::*value, const std::string& angle,
                          const std::string& displacement) {
    table.rows.push_back({name + ", angle", toDegrees(walls.angle.*value), toDegrees(ground.angle.*value), angle});
    table.rows.push_back({name + ", displacement", toMillimetres(walls.displacement.*value),
                          toMillimetres(ground.displacement.*value), displacement});
  };
  addRow("mean of all pairs", &Spread::mean, "3.6 deg", "210 mm");
  addRow("largest of all pairs", &Spread::largest, "9.1 deg", "600 mm");
  addRow("smallest of all pairs", &Spread::least, "0.32 deg", "20 mm");
  addRow("largest mean of a place", &Spread::largest_mean, "4.86 deg", "330 mm");
  addRow("smallest mean of a place", &Spread::least_mean, "0.66 deg", "140 mm");
  addRow("noise of the mean of a place", &Spread::sigma, "", "");
  table.rows.push_back({"places", std::to_string(walls.places), std::to_string(ground.places), ""});
  table.rows.push_back({"pairs of passes", std::to_string(walls.pairs), std::to_string(ground.pairs), ""});
  table.caption =
      "Planes measured by several passes at least 20 s apart, without ground truth: the angle between their normals "
      "and their displacement along the common normal. The paper (Table 4) states distances of centroids, which also "
      "differ along the wall. Every place is a row of quality.csv.";
  return table;
}

}  // namespace

std::vector<std::string> lasersWarnings(const LasersRun& run) {
  std::vector<std::string> warnings;
  for (const LaserMapRun& map : run.maps)
    warnings.insert(warnings.end(), map.rendered.warnings.begin(), map.rendered.warnings.end());
  const laser_mapper::BeamCounts beams = run.beams();
  if (beamShare(beams.without_pose, beams.all) > kManyWithoutPose)
    warnings.push_back(beamPercent(beams.without_pose, beams.all) +
                       " of the laser beams are left out of the map: the trajectory has no pose at their time");
  if (beamShare(beams.mixed, beams.all) > kManyMixed)
    warnings.push_back(beamPercent(beams.mixed, beams.all) + " of the laser beams lie between two surfaces");
  return warnings;
}

Section lasersSection(const LasersRun& run) {
  Section section;
  section.id = "map";
  section.title = "Map";
  section.introduction =
      "Laser beams, each placed by the pose of the robot at its time. Points with normals and uncertainties are in "
      "map.ply.";
  for (const LaserMapRun& map : run.maps)
    if (!map.viewer.empty())
      section.figures.push_back(
          {"In three dimensions", map.viewer, "Click a point for its data, a second one for the distance.", true});
  for (const LaserMapRun& map : run.maps)
    section.pictures.insert(section.pictures.end(), map.pictures.begin(), map.pictures.end());
  if (run.walls().pairs + run.ground().pairs > 0) section.tables.push_back(qualityTable(run));
  for (PageTable& table : calibrationTables(run)) section.tables.push_back(std::move(table));
  section.tables.push_back(beamsTable(run));
  return section;
}

std::vector<Tile> lasersTiles(const LasersRun& run) {
  if (run.points() == 0) return {};
  std::vector<Tile> tiles{{urban_nav_core::formatNumber(1e-6 * static_cast<double>(run.points()), 3), "M",
                           "points in the map", Grade::Plain}};
  const laser_mapper::QualityFigures walls = run.walls();
  if (walls.pairs > 0)
    tiles.push_back({urban_nav_core::formatNumber(1e3 * walls.displacement.mean, 3), "mm",
                     "between the passes, at walls", Grade::Plain});
  return tiles;
}

Json toJson(const LasersRun& run) {
  const laser_mapper::BeamCounts beams = run.beams();
  Json json = Json::object();
  json["points"] = run.points();
  Json& by_sensor = json["points_by_sensor"] = Json::object();
  for (const auto& [sensor, points] : run.pointsBySensor()) by_sensor[sensor] = points;
  json["points_per_s"] = static_cast<double>(beams.all) / std::max(run.seconds, 1e-9);
  const laser_mapper::QualityFigures walls = run.walls(), ground = run.ground();
  const auto known = [](const laser_mapper::QualityFigures& figures, double value) {
    return figures.pairs > 0 ? Json(value) : Json();
  };
  json["planes"] = walls.places;
  json["angle_deg_mean"] = known(walls, kDegreesPerRad * walls.angle.mean);
  json["displacement_m_mean"] = known(walls, walls.displacement.mean);
  json["plane_pairs"] = walls.pairs;
  json["ground_planes"] = ground.places;
  json["ground_angle_deg_mean"] = known(ground, kDegreesPerRad * ground.angle.mean);
  json["ground_displacement_m_mean"] = known(ground, ground.displacement.mean);
  json["delays_ms"] = delaysJson(run);
  if (!run.calibrations.empty()) json["calibration"] = calibrationJson(run);
  std::size_t chunks = 0, passes = 0;
  for (const LaserMapRun& map : run.maps) {
    chunks += map.rendered.chunks;
    passes += map.passes;
  }
  json["chunks"] = chunks;
  json["chunks_rendered"] = run.chunksRendered();
  json["passes"] = passes;
  json["beams"] = beams.all;
  json["beams_mixed"] = beams.mixed;
  json["beams_ghosts"] = run.ghostBeams();
  json["movers_removed"] = run.ghostBeams();
  json["beams_without_pose"] = beams.without_pose;
  json["beams_out_of_range"] = beams.out_of_range;
  const std::map<std::string, std::size_t> points = run.pointsBySensor();
  const auto stereo = points.find("stereo");
  json["points_stereo"] = stereo == points.end() ? std::size_t(0) : stereo->second;
  json["coloured_share"] = beamShare(run.coloured(), run.points());
  json["sigma_m_median"] = run.maps.empty() ? Json() : Json(run.maps.front().sigma_median);
  json["seconds"] = run.seconds;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : lasersWarnings(run)) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
