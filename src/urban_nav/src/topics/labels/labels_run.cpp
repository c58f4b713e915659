// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labels_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "base/map_layer.hpp"
#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_picture.hpp"
#include "laser_mapper/sensors.hpp"
#include "map/stage_result.hpp"
#include "scene_labeler/drive/travelled_path.hpp"
#include "scene_labeler/parameters.hpp"
#include "topics/labels/class_colours.hpp"
#include "topics/labels/class_images.hpp"
#include "topics/labels/labelled_map.hpp"
#include "topics/labels/labelled_ply.hpp"
#include "urban_nav_core/sequence/even_thinning.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"
#include "urban_nav_registration/pictures/stored_panorama_view.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_panorama.hpp"

namespace urban_nav {

using laser_mapper::LaserMap;
using laser_mapper::MapPoint;
using scene_labeler::LabelModel;
using scene_labeler::MapLabeler;
using scene_labeler::PointLabel;
using scene_labeler::SceneClass;
using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;

namespace {

using LabelsClock = std::chrono::steady_clock;

constexpr std::array<std::int64_t, 2> kLabelledCameras = {1, 4};  // right and left
constexpr urban_nav_core::StampNs kLongestGapOfLabelledViews = 500'000'000;
constexpr float kExtentPerM = 5.0F;  // cubes and squares of 0.2 m
constexpr double kAboveMargin = 25.0;
constexpr double kRowMargin = 1.0;   // m: points may be outside their tile, on the plane of their neighbourhood
constexpr int kAboveLongest = 2000;  // px

double millisecondsSince(LabelsClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(LabelsClock::now() - begin).count();
}

cv::Mat toImage(const urban_nav_registration::Picture& picture) {
  if (picture.width == 0) return {};
  return cv::Mat(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data())).clone();
}

/// Class images of the sessions of this run, whose bags are available.
using ClassImagesOfSessions = std::map<urban_nav_store::SessionId, ClassImages>;

ClassImagesOfSessions findClassImages(const scene_labeler::Parameters& parameters, const MapContext& context) {
  ClassImagesOfSessions classes;
  if (parameters.class_topic.empty()) return classes;
  for (const MapSession& session : context.sessions)
    classes.try_emplace(session.id, session.input.paths, parameters.class_topic, parameters.class_file);
  return classes;
}

/// Images of the side cameras, every `spacing` along the path of their session.
struct PlannedViews {
  std::vector<scene_labeler::PlacedView> views;
  std::vector<urban_nav_registration::PanoramaKey> images;
  std::vector<std::string> frames;  ///< of the images
  std::size_t devices = 0;          ///< cameras of sessions
};

void planCamera(urban_nav_store::Store& store, const laser_mapper::MappedSession& session,
                const StoredPanoramaCamera& camera, double spacing, PlannedViews& planned) {
  const std::size_t device = planned.devices++;
  const scene_labeler::TravelledPath path(*session.T_map_base);
  const urban_nav_registration::PanoramaCorrection correction =
      urban_nav_registration::panoramaCorrection(store, session.id);
  const urban_nav_core::Pose T_base_camera = correction.T_correction * camera.T_base_camera;
  double next = 0.0;
  TableStore<StoredPanorama>(store).forEach(session.id, [&](const StoredPanorama& row) {
    if (row.camera != camera.camera) return;
    const auto travelled = path.at(row.stamp - correction.delay);
    const auto T_map_base = session.T_map_base->at(row.stamp - correction.delay, kLongestGapOfLabelledViews);
    if (!travelled || !T_map_base || *travelled < next) return;
    next = *travelled + spacing;
    planned.views.push_back(
        {urban_nav_registration::storedRawCamera(camera), *T_map_base * T_base_camera, planned.images.size(), device});
    planned.images.push_back({session.id, row.camera, row.stamp});
    planned.frames.push_back(camera.frame);
  });
}

PlannedViews planViews(urban_nav_store::Store& store, const std::vector<laser_mapper::MappedSession>& sessions,
                       double spacing) {
  PlannedViews planned;
  for (const laser_mapper::MappedSession& session : sessions)
    TableStore<StoredPanoramaCamera>(store).forEach(session.id, [&](const StoredPanoramaCamera& camera) {
      if (std::find(kLabelledCameras.begin(), kLabelledCameras.end(), camera.camera) != kLabelledCameras.end())
        planCamera(store, session, camera, spacing, planned);
    });
  return planned;
}

/// Measures the surface of each class by squares of the ground and cubes.
class ExtentMeter {
 public:
  void add(const Eigen::Vector3f& point, const PointLabel& label) {
    if (label.label == SceneClass::None) return;
    const std::size_t k = toIndex(label.label);
    ++extents_[k].points;
    extents_[k].probability_sum += label.probability / 255.0;
    const urban_nav_registration::Cell cell = urban_nav_registration::toCell(point, kExtentPerM);
    cubes_[k].insert(urban_nav_registration::toKey(cell));
    squares_[k].insert(urban_nav_registration::toKey({cell.x, cell.y, 0}));
  }

  std::array<ClassExtent, scene_labeler::kClassCount> finish() {
    constexpr double kEdge = 1.0 / static_cast<double>(kExtentPerM);
    for (std::size_t k = 0; k < scene_labeler::kClassCount; ++k) {
      const auto label = static_cast<SceneClass>(k);
      const bool is_ground = label == SceneClass::Grass || label == SceneClass::Paved || label == SceneClass::DirtPath;
      const bool is_wall = withOneWall(label) == SceneClass::Wall;
      extents_[k].area = kEdge * kEdge * static_cast<double>(is_ground ? squares_[k].size() : cubes_[k].size());
      if (is_wall) extents_[k].length = kEdge * static_cast<double>(squares_[k].size());
    }
    return extents_;
  }

 private:
  using CellTable = urban_nav_registration::CellTable;
  std::vector<CellTable> cubes_{scene_labeler::kClassCount, CellTable(64)};
  std::vector<CellTable> squares_{scene_labeler::kClassCount, CellTable(64)};
  std::array<ClassExtent, scene_labeler::kClassCount> extents_{};
};

/// Returns the layer of classes for the map view of stage lasers.
std::string drawLayer(std::size_t view, const std::vector<PointLabel>& labels) {
  urban_nav_core::EvenThinning<unsigned char> kinds(kMostShownPoints);
  for (const PointLabel& label : labels) kinds.add(static_cast<unsigned char>(label.label));
  std::vector<std::array<int, 3>> colours;
  for (std::size_t k = 0; k < scene_labeler::kClassCount; ++k) {
    const ClassColour colour = classColour(static_cast<SceneClass>(k));
    colours.push_back({colour.red, colour.green, colour.blue});
  }
  return renderMapLayer(view, "class", kinds.items(), colours);
}

/// Draws the labels, measures their extents and finds single objects.
void describeLabels(const LaserMap& map, const std::vector<PointLabel>& labels,
                    const std::vector<urban_nav_core::Vector3d>& path, LabelledMap& made) {
  laser_mapper::MapPicture above(laser_mapper::viewFromAbove(path, kAboveMargin, kAboveLongest));
  ExtentMeter extents;
  scene_labeler::InstanceFinder objects;
  std::size_t next = 0;
  map.forEachTile([&](const laser_mapper::Tile&, std::vector<MapPoint> points) {
    for (MapPoint& point : points) {
      const PointLabel& label = labels[next++];
      extents.add(point.p, label);
      objects.add(point.p, label, point.stamp);
      const ClassColour colour = classColour(label.label);
      point.red = colour.red;
      point.green = colour.green;
      point.blue = colour.blue;
    }
    above.draw(points);
  });
  made.extents = extents.finish();
  made.instances = objects.find();
  const urban_nav_registration::Picture picture = above.finish(above.shownBox());
  made.pictures.push_back({"The map from above in the colours of the classes: " + classColourNames() + ".",
                           urban_nav_registration::encodeJpeg(picture), picture.width, picture.height});
}

/// Labels all points of a map, in its order, row of tiles by row of tiles.
std::vector<PointLabel> labelPoints(const LabelModel& model, const scene_labeler::Parameters& parameters,
                                    const LaserMap& map, const PlannedViews& planned, urban_nav_store::Store& store,
                                    const ClassImagesOfSessions& classes, MapPointsDigest& digest, LabelledMap& made,
                                    std::vector<double>& milliseconds) {
  std::vector<PointLabel> labels;
  LabelsClock::time_point begin;
  MapLabeler::Callbacks callbacks;
  callbacks.load = [&](std::size_t image) {
    begin = LabelsClock::now();
    return toImage(urban_nav_registration::loadPanorama(store, planned.images[image]));
  };
  if (!classes.empty())
    callbacks.load_classes = [&](std::size_t image) {
      const urban_nav_registration::PanoramaKey& key = planned.images[image];
      const auto of_session = classes.find(key.session);
      return of_session == classes.end() ? cv::Mat() : of_session->second.at(planned.frames[image], key.stamp);
    };
  callbacks.take_view = [&](std::size_t, const scene_labeler::ViewUse& use) {
    made.shown += use.shown;
    made.unusable += use.shown == 0 && !use.is_upside_down ? 1U : 0U;
    made.upside_down += use.is_upside_down ? 1U : 0U;
    made.in_new_place += use.is_new_place ? 1U : 0U;
    made.class_images += use.has_classes ? 1U : 0U;
    ++made.views;
    milliseconds.push_back(millisecondsSince(begin));
  };
  callbacks.take_label = [&](std::size_t point, const PointLabel& label) { labels[point] = label; };
  const MapLabeler::Options options{parameters.superpixel, 1.5 * parameters.projection_distance,
                                    parameters.class_accuracy};
  MapLabeler labeler(model, options, planned.views, callbacks);
  const double tile_edge = laser_mapper::kTileCells * map.parameters().voxel;
  std::optional<int> row;
  map.forEachTile([&](const laser_mapper::Tile& tile, const std::vector<MapPoint>& points) {
    if (row != tile.y) labeler.sweepTo(tile.y * tile_edge - kRowMargin);
    row = tile.y;
    digest.add(points);
    std::vector<Eigen::Vector3f> places;
    std::vector<float> reflectance;
    for (const MapPoint& point : points) {
      places.push_back(point.p);
      const bool is_of_laser = point.laser < laser_mapper::kFirstLidar;
      reflectance.push_back(is_of_laser ? point.intensity : std::numeric_limits<float>::quiet_NaN());
    }
    labels.resize(labels.size() + points.size());
    labeler.addPoints(places, reflectance);
  });
  labeler.finish();
  return labels;
}

bool hasSideLasers(urban_nav_store::Store& store, const std::vector<laser_mapper::MappedSession>& sessions) {
  std::vector<urban_nav_store::SessionId> ids;
  for (const laser_mapper::MappedSession& session : sessions) ids.push_back(session.id);
  const std::vector<laser_mapper::SensorName> sensors = laser_mapper::storedSensors(store, ids);
  return std::any_of(sensors.begin(), sensors.end(),
                     [](const auto& sensor) { return sensor.id < laser_mapper::kFirstLidar; });
}

LabelledMap labelMap(const NamedLabelModel& model, std::size_t number,
                     const std::vector<laser_mapper::MappedSession>& sessions, const ClassImagesOfSessions& classes,
                     MapContext& context, std::vector<double>& milliseconds) {
  const scene_labeler::Parameters& parameters = context.options.parameters.get(scene_labeler::table());
  LaserMap map(context.options.parameters.get(laser_mapper::table()), *context.store, sessions);
  map.load();
  LabelledMap made;
  made.file = "map" + fileSuffix(number) + ".ply";
  const PlannedViews planned = planViews(*context.store, sessions, parameters.spacing);
  MapPointsDigest digest;
  const bool has_side_lasers = hasSideLasers(*context.store, sessions);
  const LabelModel& own = has_side_lasers || !planned.views.empty() ? model.model : modelFor(model.model, "");
  made.threshold_note = scene_labeler::thresholdNote(own.sure, parameters.precision, parameters.model);
  const std::vector<PointLabel> labels =
      labelPoints(own, parameters, map, planned, *context.store, classes, digest, made, milliseconds);
  made.points = labels.size();
  for (const PointLabel& label : labels) {
    if (label.label == SceneClass::None) continue;
    ++made.labelled;
    made.unsure += label.is_unsure ? 1U : 0U;
  }
  storeMapLabels(*context.store, sessions.front().id, digest, labels);
  addLabelsToPly((std::filesystem::path(context.options.out) / made.file).string(), labels);
  if (labels.empty()) return made;
  std::vector<urban_nav_core::Vector3d> path;
  for (const laser_mapper::MappedSession& session : sessions)
    for (const urban_nav_core::StampedPose& pose : *session.T_map_base) path.push_back(pose.pose.t());
  describeLabels(map, labels, path, made);
  made.layer = drawLayer(number, labels);
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
std::size_t LabelsRun::unusable() const { return sumOverMaps(*this, &LabelledMap::unusable); }
std::size_t LabelsRun::upsideDown() const { return sumOverMaps(*this, &LabelledMap::upside_down); }
std::size_t LabelsRun::inNewPlace() const { return sumOverMaps(*this, &LabelledMap::in_new_place); }
std::size_t LabelsRun::classImages() const { return sumOverMaps(*this, &LabelledMap::class_images); }
std::size_t LabelsRun::unsure() const { return sumOverMaps(*this, &LabelledMap::unsure); }

bool hasLaserMeasurements(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  const std::vector<laser_mapper::SensorName> sensors = laser_mapper::storedSensors(store, {session});
  return std::any_of(sensors.begin(), sensors.end(),
                     [](const auto& sensor) { return sensor.id != laser_mapper::kStereoSensor; });
}

LabelsRun runLabels(const NamedLabelModel& model, MapContext& context) {
  const auto begin = LabelsClock::now();
  const std::vector<urban_nav_store::SessionId> ids = context.ids();
  std::map<std::size_t, std::vector<laser_mapper::MappedSession>> sessions_of_map;  // those of stage lasers
  std::set<std::size_t> maps_of_lasers;
  for (std::size_t s = 0; s < context.trajectories.size(); ++s) {
    const SessionTrajectory& session = context.trajectories[s];
    if (!session.written || !laser_mapper::missingMeasurements(*context.store, ids[s]).empty()) continue;
    sessions_of_map[session.map].push_back({ids[s], &session.T_map_base, &session.covariances});
    if (hasLaserMeasurements(*context.store, ids[s])) maps_of_lasers.insert(session.map);
  }
  const scene_labeler::Parameters& parameters = context.options.parameters.get(scene_labeler::table());
  const ClassImagesOfSessions classes = findClassImages(parameters, context);
  LabelsRun run;
  run.model = model.digest;
  run.class_topic = parameters.class_topic;
  Progress bar(context.console, "labels", "maps", static_cast<std::int64_t>(maps_of_lasers.size()));
  for (const auto& [map, sessions] : sessions_of_map) {
    if (maps_of_lasers.count(map) == 0) continue;
    run.maps.push_back(labelMap(model, map, sessions, classes, context, run.milliseconds));
    if (run.threshold_note.empty()) run.threshold_note = run.maps.back().threshold_note;
    bar.update(static_cast<std::int64_t>(run.maps.size()));
  }
  bar.finish(static_cast<std::int64_t>(run.maps.size()));
  run.seconds = 1e-3 * millisecondsSince(begin);
  return run;
}

}  // namespace urban_nav
