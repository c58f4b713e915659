// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/scene_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>

#include "base/matrix_file.hpp"
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
const char* const kSceneRule = "a folder of NAME_points.csv or .ply (also .gz), or one such file";

/// Returns the name of a file of returns without extension; nullopt for other extensions.
std::optional<std::string> withoutCloudExtension(std::string name) {
  if (urban_nav_core::endsWith(name, ".gz")) name.resize(name.size() - 3);
  if (!urban_nav_core::endsWith(name, ".csv") && !urban_nav_core::endsWith(name, ".ply")) return std::nullopt;
  return name.substr(0, name.size() - 4);
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
    if (!name || !urban_nav_core::endsWith(*name, "_points") || !entry.is_regular_file()) continue;
    scenes.push_back(filesOfScene(entry.path(), name->substr(0, name->size() - 7)));
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
  const bool has_suffix = urban_nav_core::endsWith(*name, "_points");
  return {filesOfScene(path, has_suffix ? name->substr(0, name->size() - 7) : *name)};
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

std::vector<std::string> uniqueSceneNames(const std::vector<SceneFiles>& scenes) {
  std::map<std::string, int> counts;
  for (const SceneFiles& files : scenes) ++counts[files.name];
  std::vector<std::string> names;
  for (const SceneFiles& files : scenes) names.push_back(counts[files.name] == 1 ? files.name : files.points);
  return names;
}

scene_labeler::Scene readScene(const SceneFiles& files) {
  const auto columns = urban_nav_core::readCloudColumns(files.points, {"x", "y", "z", "reflectance"});
  if (!columns[0] || !columns[1] || !columns[2])
    throw UserError(files.points, "a column x, y or z is missing", "x,y,z[,reflectance][,label]");
  scene_labeler::Scene scene;
  scene.name = files.name;
  const Eigen::Vector3d offset(offsetAlong(*columns[0]), offsetAlong(*columns[1]), offsetAlong(*columns[2]));
  for (std::size_t i = 0; i < columns[0]->size(); ++i) {
    const Eigen::Vector3d point((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]);
    scene.points.push_back((point - offset).cast<float>());
  }
  if (columns[3]) scene.reflectance.assign(columns[3]->begin(), columns[3]->end());
  if (files.image.empty()) return scene;
  scene.view.image = readColourImage(files.image);
  Eigen::Matrix<double, 3, 4> projection = readProjection(files.projection);
  projection.col(3) += projection.leftCols<3>() * offset;
  scene_labeler::projectScene(projection, scene);
  return scene;
}

std::vector<std::int64_t> readSceneLabels(const SceneFiles& files) {
  const auto columns = urban_nav_core::readCloudColumns(files.points, {"label", "scalar_label"});
  const auto& column = columns[0] ? columns[0] : columns[1];
  if (!column) throw UserError(files.points, "has no column label", "x,y,z[,reflectance],label");
  std::vector<std::int64_t> labels;
  for (const double value : *column) {
    if (!(std::abs(value) <= 1e9) || value != std::floor(value))
      throw UserError(files.points, "label = " + urban_nav_core::printNumber(value), "whole numbers");
    labels.push_back(static_cast<std::int64_t>(value));
  }
  return labels;
}

}  // namespace urban_nav
