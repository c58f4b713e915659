// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/page.hpp"
#include "map/context.hpp"
#include "scene_labeler/instances/instance_finder.hpp"
#include "scene_labeler/labelling/map_labeler.hpp"
#include "topics/labels/label_model_file.hpp"

namespace urban_nav {

/// Extent of a class in a map.
struct ClassExtent {
  std::size_t points = 0;
  double area = 0.0;             ///< m2: of ground seen from above, of other surfaces by cubes of 0.2 m
  double length = 0.0;           ///< m: of walls, seen from above
  double probability_sum = 0.0;  ///< of the points
};

/// Labels of a map of one or several sessions.
struct LabelledMap {
  std::string file;  ///< "map.ply", in the output folder
  std::size_t points = 0, labelled = 0, unsure = 0;
  std::size_t views = 0, shown = 0;  ///< images, and points visible in them
  std::size_t unusable = 0;          ///< images that show no point, or are black or saturated
  std::size_t upside_down = 0;       ///< images whose camera seems to be mounted upside down
  std::size_t in_new_place = 0;      ///< images of kinds of places without training data
  std::size_t class_images = 0;      ///< images with a class image from another source
  std::array<ClassExtent, scene_labeler::kClassCount> extents;
  std::vector<scene_labeler::Instance> instances;  ///< vehicles, people and poles
  std::vector<PagePicture> pictures;
  std::string layer;           ///< markup of the classes in the view of the map; empty without points
  std::string threshold_note;  ///< of thresholdNote() of the model that labelled it
};

/// Result of stage labels.
struct LabelsRun {
  std::vector<LabelledMap> maps;
  std::vector<double> milliseconds;  ///< of each image
  std::string model;                 ///< digest
  std::string threshold_note;        ///< the first one of the maps
  std::string class_topic;           ///< of class images from another source; empty: none
  double seconds = 0.0;

  std::size_t points() const;
  std::size_t labelled() const;
  std::size_t unsure() const;
  std::size_t views() const { return milliseconds.size(); }
  std::size_t unusable() const;
  std::size_t upsideDown() const;
  std::size_t inNewPlace() const;
  std::size_t classImages() const;
};

/// Returns whether a session has scans of planar lasers or sweeps of 3D LiDARs.
bool hasLaserMeasurements(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Labels the maps of stage lasers that have such measurements, in the store and the output folder, and adds the labels
/// to map.ply.
LabelsRun runLabels(const NamedLabelModel& model, MapContext& context);

}  // namespace urban_nav
