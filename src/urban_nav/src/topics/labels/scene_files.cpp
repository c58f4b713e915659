// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/scene_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>

#include "base/matrix_file.hpp"
#include "laser_mapper/sensors.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr double kFarCoordinate = 1000.0;  // m, where a float resolves 0.06 mm
const char* const kSceneRule = "a folder of NAME_points.csv, NAME_points.ply or .las (also .gz), or one such file";
/// Columns of labels, the first one present counts: ours, CloudCompare's, KITTI-360's.
const std::vector<std::string> kLabelColumns = {"label", "scalar_label", "semantic", "classification"};
constexpr double kLargestLabel = 4294967295.0;  // SemanticKITTI: instance and class in 32 bits

/// Returns the name of a file of returns without extension; nullopt for other extensions.
std::optional<std::string> withoutCloudExtension(std::string name) {
  if (urban_nav_core::endsWith(name, ".gz")) name.resize(name.size() - 3);
  for (const char* extension : {".csv", ".ply", ".las"})
    if (urban_nav_core::endsWith(name, extension)) return name.substr(0, name.size() - 4);
  return std::nullopt;
}

std::string withoutPoints(const std::string& name) {
  return urban_nav_core::endsWith(name, "_points") ? name.substr(0, name.size() - 7) : name;
}

/// Returns whether a file of a folder is a scene: NAME_points, or a LAS tile whose name is not that of a result of
/// `apply`.
bool isSceneOfFolder(const std::filesystem::path& file, const std::string& name) {
  const std::string path = file.filename().string();
  const bool is_las = urban_nav_core::endsWith(path, ".las") || urban_nav_core::endsWith(path, ".las.gz");
  return urban_nav_core::endsWith(name, "_points") || (is_las && !urban_nav_core::endsWith(name, "_labels"));
}

SceneFiles filesOfScene(const std::filesystem::path& points, const std::string& name) {
  SceneFiles files{name, points.string(), "", ""};
  for (const char* extension : {".jpg", ".png"}) {
    const std::filesystem::path image = points.parent_path() / (name + extension);
    if (files.image.empty() && std::filesystem::is_regular_file(image)) files.image = image.string();
  }
  if (files.image.empty()) return files;
  files.projection = (points.parent_path() / "projection.txt").string();
  if (!std::filesystem::is_regular_file(files.projection))
    throw UserError(files.projection, "does not exist", "a 3x4 matrix in the folder of " + files.image);
  return files;
}

std::vector<SceneFiles> scenesOfFolder(const std::string& folder) {
  std::vector<SceneFiles> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = withoutCloudExtension(entry.path().filename().string());
    if (name && entry.is_regular_file() && isSceneOfFolder(entry.path(), *name))
      scenes.push_back(filesOfScene(entry.path(), withoutPoints(*name)));
  }
  if (scenes.empty()) throw UserError(folder, "holds no scene", kSceneRule);
  return scenes;
}

std::vector<SceneFiles> scenesOfSource(const std::string& source) {
  if (std::filesystem::is_directory(source)) return scenesOfFolder(source);
  if (!std::filesystem::exists(source)) throw UserError(source, "does not exist", kSceneRule);
  const std::filesystem::path path(source);
  const auto name = withoutCloudExtension(path.filename().string());
  if (!name)
    throw UserError(source, urban_nav_input::isRecording(source) ? "is a recording, not a scene" : "is not a scene",
                    kSceneRule);
  return {filesOfScene(path, withoutPoints(*name))};
}

Eigen::Matrix<double, 3, 4> readProjection(const std::string& path) {
  const std::vector<double> numbers = readMatrixFile(path);
  if (numbers.size() != 12)
    throw UserError(path, std::to_string(numbers.size()) + " numbers", "12: a 3x4 matrix, row by row");
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
}

cv::Mat readColourImage(const std::string& path) {
  const urban_nav_ros::GreyImage file = urban_nav_input::readPixels(path);
  if (!file.fault.empty()) throw urban_nav_core::DataError(file.fault, "", "");
  cv::Mat pixels = file.pixels, colour;
  if (pixels.depth() != CV_8U) pixels.convertTo(pixels, CV_8U, 1.0 / 256.0);
  if (pixels.channels() == 3) return pixels;
  cv::cvtColor(pixels, colour, pixels.channels() == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_BGRA2BGR);
  return colour;
}

/// Returns the centre of coordinates far from zero, in whole metres; else 0.
double offsetAlong(const std::vector<double>& values) {
  for (const double value : values)
    if (std::isfinite(value)) return std::abs(value) > kFarCoordinate ? std::round(value) : 0.0;
  return 0.0;
}

}  // namespace

std::vector<SceneFiles> findScenes(const std::vector<std::string>& sources) {
  std::vector<SceneFiles> scenes;
  for (const std::string& source : sources)
    for (SceneFiles& files : scenesOfSource(source)) scenes.push_back(std::move(files));
  std::sort(scenes.begin(), scenes.end(), [](const SceneFiles& a, const SceneFiles& b) {
    return a.name != b.name ? a.name < b.name : a.points < b.points;
  });
  for (std::size_t i = 1; i < scenes.size(); ++i)
    if (std::filesystem::equivalent(scenes[i].points, scenes[i - 1].points))
      throw UserError(scenes[i].points, "is given twice", "each scene once");
  return scenes;
}

std::string sceneName(const std::string& path) {
  const std::string file = std::filesystem::path(path).filename().string();
  return withoutPoints(withoutCloudExtension(file).value_or(file));
}

std::vector<std::string> uniqueSceneNames(const std::vector<SceneFiles>& scenes) {
  std::map<std::string, int> counts;
  for (const SceneFiles& files : scenes) ++counts[files.name];
  std::vector<std::string> names;
  for (const SceneFiles& files : scenes) names.push_back(counts[files.name] == 1 ? files.name : files.points);
  return names;
}

SceneInput readScene(const SceneFiles& files) {
  const auto columns =
      urban_nav_core::readCloudColumns(files.points, {"x", "y", "z", "reflectance", "laser", "coloured"});
  if (!columns[0] || !columns[1] || !columns[2])
    throw UserError(files.points, "a column x, y or z is missing", "x,y,z[,reflectance][,label]");
  SceneInput input;
  scene_labeler::Scene& scene = input.scene;
  scene.name = files.name;
  input.offset = {offsetAlong(*columns[0]), offsetAlong(*columns[1]), offsetAlong(*columns[2])};
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    const Eigen::Vector3d point((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]);
    scene.points.push_back((point - input.offset).cast<float>());
  }
  if (columns[3]) scene.reflectance.assign(columns[3]->begin(), columns[3]->end());
  if (columns[4] && columns[5])  // a map of urban_nav
    input.is_of_side_lasers = std::any_of(columns[4]->begin(), columns[4]->end(), [](double sensor) {
      return sensor < static_cast<double>(laser_mapper::kFirstLidar);
    });
  if (files.image.empty()) return input;
  scene.view.image = readColourImage(files.image);
  Eigen::Matrix<double, 3, 4> projection = readProjection(files.projection);
  projection.col(3) += projection.leftCols<3>() * input.offset;
  scene_labeler::projectScene(projection, scene);
  return input;
}

const scene_labeler::LabelModel& chooseModel(const SceneInput& input, const scene_labeler::LabelModel& model) {
  return input.is_of_side_lasers ? model : scene_labeler::modelFor(model, input.scene.device);
}

std::vector<std::int64_t> readSceneLabels(const SceneFiles& files, bool has_class_map) {
  auto columns = urban_nav_core::readCloudColumns(files.points, kLabelColumns);
  if (!has_class_map && columns[3] && !columns[0] && !columns[1] && !columns[2])
    throw UserError(files.points, "has no column label; its classification has other numbers than the classes",
                    "--classes FILE with the classes of its codes");
  const auto column = std::find_if(columns.begin(), columns.end(), [](const auto& one) { return one.has_value(); });
  if (column == columns.end()) throw UserError(files.points, "has no column label", "x,y,z[,reflectance],label");
  std::vector<std::int64_t> labels;
  for (const double value : **column) {
    if (!(std::abs(value) <= kLargestLabel) || value != std::floor(value))
      throw UserError(files.points, "label = " + urban_nav_core::printNumber(value), "whole numbers");
    labels.push_back(static_cast<std::int64_t>(value));
  }
  return labels;
}

}  // namespace urban_nav
