// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labels_report.hpp"

#include <algorithm>
#include <cmath>

#include "base/plot.hpp"
#include "scene_labeler/model/place_novelty.hpp"
#include "topics/labels/instances_report.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using scene_labeler::kClassCount;
using scene_labeler::SceneClass;

namespace {

constexpr double kManyUnsure = 0.3;  // share worth a warning

double labelShare(std::size_t part, std::size_t all) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
}

std::array<ClassExtent, kClassCount> extentsOverMaps(const LabelsRun& run) {
  std::array<ClassExtent, kClassCount> all;
  for (const LabelledMap& map : run.maps)
    for (std::size_t k = 0; k < kClassCount; ++k) {
      all[k].points += map.extents[k].points;
      all[k].area += map.extents[k].area;
      all[k].length += map.extents[k].length;
      all[k].probability_sum += map.extents[k].probability_sum;
    }
  return all;
}

double meanProbability(const ClassExtent& extent) {
  return extent.probability_sum / static_cast<double>(std::max<std::size_t>(extent.points, 1));
}

std::string rounded(double value, double steps) {
  return urban_nav_core::printNumber(std::round(value * steps) / steps);
}

PageTable classesTable(const LabelsRun& run) {
  PageTable table{"Classes", {"class", "points", "area, m2", "length, m", "mean probability"}, {}, ""};
  const auto extents = extentsOverMaps(run);
  for (std::size_t k = 0; k < kClassCount; ++k) {
    if (extents[k].points == 0) continue;
    table.rows.push_back({toString(static_cast<SceneClass>(k)), std::to_string(extents[k].points),
                          urban_nav_core::formatNumber(extents[k].area),
                          extents[k].length > 0.0 ? urban_nav_core::formatNumber(extents[k].length) : "",
                          urban_nav_core::formatNumber(meanProbability(extents[k]), 2)});
  }
  table.caption =
      "Area: of the ground in plan view; of other surfaces by cubes of 0.2 m. Length: of walls in plan view.";
  return table;
}

}  // namespace

std::vector<std::string> labelsWarnings(const LabelsRun& run) {
  std::vector<std::string> warnings;
  if (!run.threshold_note.empty()) warnings.push_back(run.threshold_note);
  if (run.points() > 0 && run.views() == 0)
    warnings.emplace_back("no image of a side camera: the map is labelled by shape only");
  if (run.unusable() > 0)
    warnings.push_back(std::to_string(run.unusable()) + " of " + std::to_string(run.views()) +
                       " images of the side cameras show no point of the map, or are black or saturated: not used");
  if (run.upsideDown() > 0)
    warnings.push_back("a side camera seems to be mounted upside down, or to have the calibration of one that is: " +
                       std::to_string(run.upsideDown()) + " of " + std::to_string(run.views()) +
                       " images of the side cameras are not used");
  const std::string new_place = scene_labeler::newPlaceWarning(run.inNewPlace(), run.views());
  if (!new_place.empty()) warnings.push_back(new_place);
  if (!run.class_topic.empty() && run.classImages() == 0)
    warnings.push_back("no class image is used: " + run.class_topic +
                       " has none in mono8 with the frame, stamp and size of an image that is labelled, or there is no "
                       "such topic in the bags of this run");
  const double unsure = labelShare(run.unsure(), run.labelled());
  if (unsure > kManyUnsure && new_place.empty())
    warnings.push_back(urban_nav_core::formatNumber(100.0 * unsure, 3) +
                       " % of the labels are unsure; `urban_nav labels teach` trains a model for this place");
  return warnings;
}

Section labelsSection(const LabelsRun& run) {
  Section section;
  section.id = "labels";
  section.title = "Classes of the map";
  section.introduction = "Classes of the points of the map, with probabilities, from shape and images: " +
                         urban_nav_core::formatNumber(100.0 * labelShare(run.unsure(), run.labelled()), 3) +
                         " % of them are unsure. They are in map.ply and labels.csv.";
  const std::string new_place = scene_labeler::newPlaceWarning(run.inNewPlace(), run.views());
  if (!new_place.empty()) section.introduction += " " + new_place + ".";
  for (const LabelledMap& map : run.maps)
    section.pictures.insert(section.pictures.end(), map.pictures.begin(), map.pictures.end());
  for (const LabelledMap& map : run.maps)
    if (!map.layer.empty())
      section.figures.push_back(
          {"In three dimensions", map.layer, "Choose `class` as colour to show the classes.", true});
  section.tables.push_back(classesTable(run));
  section.tables.push_back(instancesTable(run));
  return section;
}

std::string printLabelsCsv(const LabelsRun& run) {
  std::string text = "class,points,area_m2,length_m,probability_mean\n";
  const auto extents = extentsOverMaps(run);
  for (std::size_t k = 0; k < kClassCount; ++k) {
    if (extents[k].points == 0) continue;
    text += std::string(toString(static_cast<SceneClass>(k))) + "," + std::to_string(extents[k].points) + "," +
            rounded(extents[k].area, 100.0) + "," + rounded(extents[k].length, 100.0) + "," +
            rounded(meanProbability(extents[k]), 1e4) + "\n";
  }
  return text;
}

Json toJson(const LabelsRun& run) {
  Json json = Json::object();
  json["frames"] = run.views();
  if (!run.class_topic.empty()) json["class_frames"] = run.classImages();
  std::vector<double> sorted = run.milliseconds;
  std::sort(sorted.begin(), sorted.end());
  json["ms_median"] = sorted.empty() ? Json() : Json(sorted[sorted.size() / 2]);
  json["new_place_frames"] = run.inNewPlace();
  json["points_labelled"] = run.labelled();
  json["unsure_share"] = labelShare(run.unsure(), run.labelled());
  json["model"] = run.model;
  json["instances"] = instancesJson(run);
  json["seconds"] = run.seconds;
  return json;
}

}  // namespace urban_nav
