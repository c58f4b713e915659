// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/lasers_run.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include "base/command_parameters.hpp"
#include "laser_mapper/map_files.hpp"
#include "laser_mapper/map_picture.hpp"
#include "laser_mapper/sensors.hpp"
#include "laser_mapper/tiles/tile_store.hpp"
#include "map/rendered_poses.hpp"
#include "map/stage_result.hpp"
#include "topics/lasers/map_colour.hpp"
#include "topics/lasers/map_viewer.hpp"
#include "topics/lasers/report_tiles.hpp"
#include "topics/lasers/sensor_counts.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using laser_mapper::LaserMap;
using laser_mapper::MapPicture;
using laser_mapper::MapPoint;
using urban_nav_core::Trajectory;

namespace {

constexpr double kShownMargin = 25.0;  // m around the path in the plan view, before cropping
constexpr int kLongestPicture = 2000, kPictureWidth = 1400, kPictureHeight = 800;  // px
constexpr double kPathStep = 0.25;                                                 // m
constexpr double kImageMemoryShare = 0.1;                                          // of memory_mb
constexpr std::size_t kSigmaBins = 4096;
constexpr float kSigmaBin = 1e-4F;  // m

std::vector<urban_nav_core::Vector3d> thinnedPath(const Trajectory& trajectory) {
  std::vector<urban_nav_core::Vector3d> path;
  for (const urban_nav_core::StampedPose& pose : trajectory)
    if (path.empty() || (pose.pose.t() - path.back()).norm() > kPathStep) path.push_back(pose.pose.t());
  return path;
}

PagePicture pagePicture(const MapPicture& drawn, const std::string& caption) {
  const urban_nav_registration::Picture picture = drawn.finish(drawn.shownBox());
  return {caption, urban_nav_registration::encodeJpeg(picture), picture.width, picture.height};
}

/// Histogram of the standard deviations of the points.
class SigmaHistogram {
 public:
  void add(float sigma) {
    ++bins_[std::min(kSigmaBins - 1, static_cast<std::size_t>(sigma / kSigmaBin))];
    ++all_;
  }
  double median() const {
    std::size_t below = 0;
    for (std::size_t i = 0; i < kSigmaBins; ++i) {
      below += bins_[i];
      if (2 * below >= all_ && all_ > 0) return (static_cast<double>(i) + 0.5) * static_cast<double>(kSigmaBin);
    }
    return 0.0;
  }

 private:
  std::vector<std::size_t> bins_ = std::vector<std::size_t>(kSigmaBins, 0);
  std::size_t all_ = 0;
};

/// Returns the reason why a map has no points.
std::string whyEmpty(const LaserMapRun& run) {
  const laser_mapper::BeamCounts& beams = run.rendered.beams;
  return run.file + " cannot be made: no point is left of " + std::to_string(beams.all) + " beams (" +
         std::to_string(beams.without_pose) + " without a pose, " + std::to_string(beams.out_of_range) +
         " out of range), and no surface is seen by three images of dense stereo or of a depth camera";
}

/// Returns points as records of the map's file, and counts them.
std::string printPoints(const std::vector<MapPoint>& points, SensorCounts& counts, SigmaHistogram& sigmas) {
  std::string bytes;
  for (const MapPoint& point : points) {
    appendVertex(bytes, point);
    counts.add(point.laser);
    if (!laser_mapper::isOfImages(point.laser)) sigmas.add(point.sigma);
  }
  return bytes;
}

/// Writes the tiles of a map next to the report if the report does not hold all of its points, else removes those of an
/// earlier run. Returns the list for the report.
std::string writeFinerLevels(const MapContext& context, const urban_nav_store::SessionId& first, std::size_t number,
                             bool are_needed) {
  const std::string folder = (std::filesystem::path(context.options.out) / kReportTiles).string();
  if (are_needed) return writeReportTiles(*context.store, first, folder, number);
  removeReportTiles(folder, number);
  return "";
}

/// Renders a map. `make_colours`: called after rendering.
LaserMapRun renderMap(LaserMap& map, const std::function<std::unique_ptr<MapColours>()>& make_colours,
                      const std::vector<laser_mapper::MappedSession>& mapped, std::size_t first_session,
                      const MapContext& context) {
  LaserMapRun run;
  run.map = first_session;
  run.file = "map" + fileSuffix(first_session) + ".ply";
  Progress bar(context.console, "lasers", "chunks", 0);
  run.rendered = map.render([&](std::size_t done, std::size_t) { bar.update(static_cast<std::int64_t>(done)); });
  bar.finish(static_cast<std::int64_t>(run.rendered.chunks));
  const std::unique_ptr<MapColours> colours = make_colours();
  run.views = colours->views();
  std::vector<std::vector<urban_nav_core::Vector3d>> paths;
  std::vector<urban_nav_core::Vector3d> all;
  for (const laser_mapper::MappedSession& session : mapped) {
    paths.push_back(thinnedPath(*session.T_map_base));
    all.insert(all.end(), paths.back().begin(), paths.back().end());
  }
  const laser_mapper::MapQuality quality(map);
  run.walls = quality.walls();
  run.ground = quality.ground();
  if (!quality.places().empty()) run.quality_csv = quality.printCsv();
  MapPicture above(laser_mapper::viewFromAbove(all, kShownMargin, kLongestPicture));
  MapPicture perspective(laser_mapper::viewInPerspective(all, kPictureWidth, kPictureHeight));
  const std::vector<laser_mapper::SensorName> sensors = sensorNames(*context.store, mapped);
  urban_nav_core::PlyWriter file((std::filesystem::path(context.options.out) / run.file).string(),
                                 laser_mapper::mapLayout(sensors));
  SensorCounts counts;
  SigmaHistogram sigmas;
  MapViewer viewer(first_session);
  laser_mapper::TileWriter tiles(*context.store, laser_mapper::tiledSessions(*context.store, mapped, map.passes()),
                                 map.parameters().voxel);
  run.ghost_beams = map.forEachTile([&](const laser_mapper::Tile& tile, std::vector<MapPoint> points) {
    run.coloured += colours->colour(tile, points);
    tiles.add(tile, points);
    file.append(printPoints(points, counts, sigmas));
    above.draw(points);
    perspective.draw(points);
    for (MapPoint& point : points) point.displacement = quality.displacementAt(point.p).value_or(-1.0F);
    viewer.add(points);
  });
  colours->finish();
  tiles.finish();
  run.points = file.vertices();
  run.points_by_sensor = counts.byName(sensors);
  run.sigma_median = sigmas.median();
  if (run.points > 0) file.commit();
  for (const auto& path : paths) {
    above.drawPath(path);
    viewer.addPath(path);
  }
  viewer.setTiles(writeFinerLevels(context, mapped.front().id, first_session, run.points > viewer.points()));
  run.viewer = viewer.render();
  if (run.points > 0) {
    run.pictures.push_back(pagePicture(above, "The map from above, the path of the robot in red."));
    run.pictures.push_back(pagePicture(perspective, "The map in perspective."));
  }
  for (const laser_mapper::SessionPasses& passes : map.passes()) run.passes += passes.begins.size();
  return run;
}

/// Calibrates the lasers of a session of this run if requested. Previous sessions keep their adopted calibration. The
/// result of stage calibration is used unless a relaxation has changed the trajectory.
void calibrateForMap(const laser_mapper::Parameters& parameters, std::size_t session, const MapContext& context,
                     const std::vector<SessionCalibration>& along_odometry, LasersRun& run) {
  if (!context.options.calibrate || context.isPrevious(session)) return;
  const auto found = std::find_if(along_odometry.begin(), along_odometry.end(),
                                  [&](const SessionCalibration& each) { return each.number == session; });
  if (found != along_odometry.end() && !context.relaxed) run.calibrations.push_back(*found);
  else run.calibrations.push_back(calibrateSession(parameters, session, context));
}

/// Calibrates the panoramas of sessions with calibrated lasers, by the map of these lasers.
void calibrateViews(const std::vector<std::size_t>& sessions, const LaserMap& map,
                    const std::vector<laser_mapper::MappedSession>& mapped, MapContext& context, LasersRun& run) {
  for (SessionCalibration& calibration : run.calibrations) {
    if (std::find(sessions.begin(), sessions.end(), calibration.number) == sessions.end()) continue;
    for (const laser_mapper::MappedSession& session : mapped) {
      if (session.id != context.ids()[calibration.number]) continue;
      const urban_nav_core::OdometryChain odometry = odometryChain(*context.runs()[calibration.number]);
      calibration.panorama = calibratePanoramas(*context.store, session, odometry, map);
      if (calibration.panorama) laser_mapper::storeViewCalibration(*context.store, session.id, *calibration.panorama);
    }
  }
}

}  // namespace

std::size_t LasersRun::points() const {
  std::size_t all = 0;
  for (const LaserMapRun& map : maps) all += map.points;
  return all;
}

std::map<std::string, std::size_t> LasersRun::pointsBySensor() const {
  std::map<std::string, std::size_t> all;
  for (const LaserMapRun& map : maps)
    for (const auto& [sensor, points] : map.points_by_sensor) all[sensor] += points;
  return all;
}

std::size_t LasersRun::coloured() const {
  std::size_t all = 0;
  for (const LaserMapRun& map : maps) all += map.coloured;
  return all;
}

std::size_t LasersRun::chunksRendered() const {
  std::size_t all = 0;
  for (const LaserMapRun& map : maps) all += map.rendered.chunks_rendered;
  return all;
}

std::size_t LasersRun::ghostBeams() const {
  std::size_t all = 0;
  for (const LaserMapRun& map : maps) all += map.ghost_beams;
  return all;
}

laser_mapper::QualityFigures LasersRun::walls() const {
  laser_mapper::QualityFigures all;
  for (const LaserMapRun& map : maps) all = all + map.walls;
  return all;
}

laser_mapper::QualityFigures LasersRun::ground() const {
  laser_mapper::QualityFigures all;
  for (const LaserMapRun& map : maps) all = all + map.ground;
  return all;
}

laser_mapper::BeamCounts LasersRun::beams() const {
  laser_mapper::BeamCounts all;
  for (const LaserMapRun& map : maps) all = all + map.rendered.beams;
  return all;
}

SessionCalibration calibrateSession(const laser_mapper::Parameters& parameters, std::size_t session,
                                    const MapContext& context) {
  const urban_nav_store::SessionId id = context.ids()[session];
  const urban_nav_core::OdometryChain odometry = odometryChain(*context.runs()[session]);
  SessionCalibration calibration;
  calibration.number = session;
  calibration.session = context.names[session];
  calibration.found = laser_mapper::calibrateLasers(parameters, *context.store, id,
                                                    context.trajectories[session].T_map_base, &odometry);
  laser_mapper::storeCalibration(*context.store, id, calibration.found);
  return calibration;
}

LasersRun runLasers(const laser_mapper::Parameters& parameters, MapContext& context,
                    const std::vector<SessionCalibration>& along_odometry) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<urban_nav_store::SessionId> ids = context.ids();
  std::map<std::size_t, std::vector<std::size_t>> sessions_of_map;
  for (std::size_t s = 0; s < context.trajectories.size(); ++s)
    if (context.trajectories[s].written) sessions_of_map[context.trajectories[s].map].push_back(s);
  LasersRun run;
  for (const auto& [map, sessions] : sessions_of_map) {
    std::vector<laser_mapper::MappedSession> mapped;
    for (const std::size_t s : sessions) {
      const SessionTrajectory& session = context.trajectories[s];
      if (!laser_mapper::missingMeasurements(*context.store, ids[s]).empty()) continue;
      if (!context.store->scans().lasers(ids[s]).empty()) calibrateForMap(parameters, s, context, along_odometry, run);
      mapped.push_back({ids[s], &session.T_map_base, &session.covariances});
    }
    if (mapped.empty()) continue;
    if (context.joins)  // chunks of earlier runs may be displaced by up to max_shift
      for (const laser_mapper::MappedSession& session : mapped) laser_mapper::forgetChunks(*context.store, session.id);
    LaserMap laser_map(parameters, *context.store, mapped);
    const double memory_mb = kImageMemoryShare * context.options.parameters.get(commandTable()).memory_mb;
    const auto make_colours = [&, &sessions_of_this_map = sessions] {
      calibrateViews(sessions_of_this_map, laser_map, mapped, context, run);
      return std::make_unique<MapColours>(*context.store, laser_map, mapped, memory_mb, true);
    };
    LaserMapRun map_run = renderMap(laser_map, make_colours, mapped, map, context);
    for (const laser_mapper::MappedSession& session : mapped) forgetRenderedPoses(*context.store, session.id);
    if (map_run.points == 0) {
      if (!context.options.stages.empty()) throw urban_nav_core::DataError(context.options.out, whyEmpty(map_run), "");
      map_run.rendered.warnings.push_back(whyEmpty(map_run));
    }
    run.maps.push_back(std::move(map_run));
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

}  // namespace urban_nav
