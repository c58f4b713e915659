// SPDX-License-Identifier: BSD-3-Clause
#include "stages/labels/labels_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_picture.hpp"
#include "scene_labeler/drive/travelled_path.hpp"
#include "scene_labeler/parameters.hpp"
#include "stage/labelled_map.hpp"
#include "stage/panorama_views.hpp"
#include "stage/stage_result.hpp"
#include "stages/labels/class_colours.hpp"
#include "stages/labels/labelled_ply.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"

namespace urban_nav {

using laser_mapper::LaserMap;
using laser_mapper::MapPoint;
using scene_labeler::MapLabeler;
using scene_labeler::PointLabel;
using scene_labeler::SceneClass;
using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;

namespace {

using LabelsClock = std::chrono::steady_clock;

constexpr std::array<std::int64_t, 2> labelled_cameras = {1, 4};  // right and left
constexpr urban_nav_core::StampNs longest_view_gap = 500'000'000;
constexpr float extent_per_m = 5.0F;  // cubes and squares of 0.2 m
constexpr double above_margin = 25.0;
constexpr int above_longest = 2000;  // px

double millisecondsSince(LabelsClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(LabelsClock::now() - begin).count();
}

cv::Mat toImage(const urban_nav_registration::Picture& picture) {
  if (picture.width == 0) return {};
  return cv::Mat(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data())).clone();
}

/// Labels from the images of one side camera of a session, every `spacing` along its path.
void addCamera(urban_nav_store::Store& store, const laser_mapper::MappedSession& session,
               const StoredPanoramaCamera& camera, double spacing, MapLabeler& labeler, LabelledMap& made,
               std::vector<double>& milliseconds) {
  const scene_labeler::TravelledPath path(*session.T_map_base);
  double next = 0.0;
  TableStore<StoredPanorama>(store).forEach(session.id, [&](const StoredPanorama& row) {
    if (row.camera != camera.camera) return;
    const auto travelled = path.at(row.stamp);
    const auto T_map_base = session.T_map_base->at(row.stamp, longest_view_gap);
    if (!travelled || !T_map_base || *travelled < next) return;
    const auto begin = LabelsClock::now();
    const cv::Mat image = toImage(urban_nav_registration::decodePicture(row.jpeg));
    if (image.cols != camera.width || image.rows != camera.height) return;
    next = *travelled + spacing;
    made.shown += labeler.add({rawCamera(camera), *T_map_base * camera.T_base_camera, image});
    ++made.views;
    milliseconds.push_back(millisecondsSince(begin));
  });
}

/// Surfaces of each class: by squares of the ground and cubes.
void measureExtents(const std::vector<Eigen::Vector3f>& points, const std::vector<PointLabel>& labels,
                    std::array<ClassExtent, scene_labeler::class_count>& extents) {
  using urban_nav_registration::CellTable;
  std::vector<CellTable> cubes(scene_labeler::class_count, CellTable(64)), squares = cubes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (labels[i].label == SceneClass::None) continue;
    const std::size_t k = toIndex(labels[i].label);
    ++extents[k].points;
    extents[k].probability_sum += labels[i].probability / 255.0;
    const urban_nav_registration::Cell cell = urban_nav_registration::toCell(points[i], extent_per_m);
    cubes[k].insert(urban_nav_registration::toKey(cell));
    squares[k].insert(urban_nav_registration::toKey({cell.x, cell.y, 0}));
  }
  constexpr double edge = 1.0 / static_cast<double>(extent_per_m);
  for (std::size_t k = 0; k < scene_labeler::class_count; ++k) {
    const auto label = static_cast<SceneClass>(k);
    const bool is_ground = label == SceneClass::Grass || label == SceneClass::Paved || label == SceneClass::DirtPath;
    const bool is_wall = withOneWall(label) == SceneClass::Wall;
    extents[k].area = edge * edge * static_cast<double>(is_ground ? squares[k].size() : cubes[k].size());
    if (is_wall) extents[k].length = edge * static_cast<double>(squares[k].size());
  }
}

PagePicture drawLabels(const LaserMap& map, const std::vector<PointLabel>& labels,
                       const std::vector<urban_nav_core::Vector3d>& path) {
  laser_mapper::MapPicture above(laser_mapper::viewFromAbove(path, above_margin, above_longest));
  std::size_t next = 0;
  map.forEachTile([&](const laser_mapper::Tile&, std::vector<MapPoint> points) {
    for (MapPoint& point : points) {
      const ClassColour colour = classColour(labels[next].label);
      point.red = colour.red;
      point.green = colour.green;
      point.blue = colour.blue;
      ++next;
    }
    above.draw(points);
  });
  const urban_nav_registration::Picture picture = above.finish(above.shownBox());
  return {"The map from above in the colours of the classes: " + classColourNames() + ".",
          urban_nav_registration::encodeJpeg(picture), picture.width, picture.height};
}

LabelledMap labelMap(const NamedLabelModel& model, const std::string& file,
                     const std::vector<laser_mapper::MappedSession>& sessions, MapContext& context,
                     std::vector<double>& milliseconds) {
  const scene_labeler::Parameters& parameters = context.options.parameters.get(scene_labeler::table());
  LaserMap map(context.options.parameters.get(laser_mapper::table()), *context.store, sessions);
  map.load();
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint8_t> reflectance;
  MapPointsDigest digest;
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& tile) {
    digest.add(tile);
    for (const MapPoint& point : tile) {
      points.push_back(point.p);
      reflectance.push_back(point.raw_intensity);
    }
  });
  LabelledMap made;
  made.file = file;
  made.points = points.size();
  MapLabeler labeler(model.model, parameters.superpixel, 1.5 * parameters.reach, points, std::move(reflectance));
  std::vector<urban_nav_core::Vector3d> path;
  for (const laser_mapper::MappedSession& session : sessions) {
    TableStore<StoredPanoramaCamera>(*context.store).forEach(session.id, [&](const StoredPanoramaCamera& camera) {
      if (std::find(labelled_cameras.begin(), labelled_cameras.end(), camera.camera) != labelled_cameras.end())
        addCamera(*context.store, session, camera, parameters.spacing, labeler, made, milliseconds);
    });
    for (const urban_nav_core::StampedPose& pose : *session.T_map_base) path.push_back(pose.pose.t());
  }
  const std::vector<PointLabel> labels = labeler.finish();
  for (const PointLabel& label : labels) {
    if (label.label == SceneClass::None) continue;
    ++made.labelled;
    made.unsure += label.is_unsure ? 1U : 0U;
  }
  measureExtents(points, labels, made.extents);
  storeMapLabels(*context.store, sessions.front().id, digest, labels);
  addLabelsToPly((std::filesystem::path(context.options.out) / file).string(), labels);
  if (!points.empty()) made.pictures.push_back(drawLabels(map, labels, path));
  return made;
}

std::size_t sumOverMaps(const LabelsRun& run, std::size_t LabelledMap::*member) {
  std::size_t all = 0;
  for (const LabelledMap& map : run.maps) all += map.*member;
  return all;
}

}  // namespace

std::size_t LabelsRun::points() const { return sumOverMaps(*this, &LabelledMap::points); }
std::size_t LabelsRun::labelled() const { return sumOverMaps(*this, &LabelledMap::labelled); }
std::size_t LabelsRun::unsure() const { return sumOverMaps(*this, &LabelledMap::unsure); }

LabelsRun runLabels(const NamedLabelModel& model, MapContext& context) {
  const auto begin = LabelsClock::now();
  const std::vector<urban_nav_store::SessionId> ids = context.ids();
  std::map<std::size_t, std::vector<laser_mapper::MappedSession>> sessions_of_map;
  for (std::size_t s = 0; s < context.trajectories.size(); ++s) {
    const SessionTrajectory& session = context.trajectories[s];
    if (session.written && !context.store->scans().lasers(ids[s]).empty())
      sessions_of_map[session.map].push_back({ids[s], &session.T_map_base, &session.covariances});
  }
  LabelsRun run;
  run.model = model.digest;
  Progress bar(context.console, "labels", "maps", static_cast<std::int64_t>(sessions_of_map.size()));
  for (const auto& [map, sessions] : sessions_of_map) {
    run.maps.push_back(labelMap(model, "map" + fileSuffix(map) + ".ply", sessions, context, run.milliseconds));
    bar.update(static_cast<std::int64_t>(run.maps.size()));
  }
  bar.finish(static_cast<std::int64_t>(run.maps.size()));
  run.seconds = 1e-3 * millisecondsSince(begin);
  return run;
}

}  // namespace urban_nav
