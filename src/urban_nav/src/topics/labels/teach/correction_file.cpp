// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/teach/correction_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scene_labeler/class_map.hpp"
#include "topics/labels/label_columns.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;
using urban_nav_core::appendLittleEndian;
using urban_nav_core::PlyType;
using urban_nav_core::UserError;

namespace {

constexpr double kSamePointDistance = 1e-3;  // m, that a program which rewrites the file may round
const std::string kSceneWord = "scene ", kSuperpixelWord = "superpixel ", kCorrectionWord = "correction ";

/// Returns the comments in the header of a PLY file; none for other files.
std::vector<std::string> headerComments(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::string> comments;
  std::string line;
  if (!std::getline(file, line) || line.rfind("ply", 0) != 0) return comments;
  const std::string word = "comment ";
  while (std::getline(file, line) && line.rfind("end_header", 0) != 0)
    if (line.rfind(word, 0) == 0) comments.push_back(line.substr(word.size()));
  return comments;
}

/// Returns a path that a line of the header can hold; else empty.
std::string asLine(const std::string& path) {
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  const bool is_plain = std::none_of(absolute.begin(), absolute.end(),
                                     [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; });
  return is_plain ? absolute : std::string();
}

std::string printCorrection(const LabelCorrection& correction) {
  return kCorrectionWord + std::to_string(correction.point) + " " + urban_nav_core::printNumber(correction.radius) +
         " " + toString(correction.label);
}

/// Reads a line of printCorrection(); nullopt for other text.
std::optional<LabelCorrection> parseCorrection(const std::string& text, std::size_t points) {
  const std::string content = text.substr(kCorrectionWord.size());
  const std::vector<std::string_view> words = urban_nav_core::splitAt(content, ' ');
  if (words.size() != 3) return std::nullopt;
  const auto point = urban_nav_core::parseInteger(words[0]);
  const auto radius = urban_nav_core::parseNumber(words[1]);
  const auto known = scene_labeler::classFromName(words[2]);
  const bool is_class = known || words[2] == toString(SceneClass::None);
  if (!point || *point < 0 || static_cast<std::size_t>(*point) >= points || !radius || !is_class) return std::nullopt;
  return LabelCorrection{static_cast<std::uint32_t>(*point), static_cast<float>(*radius),
                         known ? *known : SceneClass::None};
}

}  // namespace

CorrectionFile::CorrectionFile(std::string path, const SceneFiles& files, const SceneInput& input, int superpixel)
    : path_(std::move(path)),
      scene_path_(asLine(files.points)),
      superpixel_(superpixel),
      offset_(input.offset),
      points_(input.scene.points),
      has_image_(!files.image.empty()),
      is_far_(!input.offset.isZero()),
      has_reflectance_(!input.scene.reflectance.empty()) {
  vertex_bytes_ = 3 * (is_far_ ? sizeof(double) : sizeof(float)) + (has_reflectance_ ? sizeof(float) : 0);
  vertices_.reserve(vertex_bytes_ * points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d place = points_[i].cast<double>() + offset_;
    for (int k = 0; k < 3; ++k) {
      if (is_far_) appendLittleEndian(vertices_, place[k]);
      else appendLittleEndian(vertices_, static_cast<float>(place[k]));
    }
    if (has_reflectance_) appendLittleEndian(vertices_, input.scene.reflectance[i]);
  }
}

bool CorrectionFile::exists() const { return std::filesystem::exists(path_); }

void CorrectionFile::requireSameCloud() const {
  const auto columns = urban_nav_core::readCloudColumns(path_, {"x", "y", "z"});
  if (!columns[0] || !columns[1] || !columns[2]) throw UserError(path_, "has no column x, y or z", "x y z label");
  const std::string expected = "corrections of " + scene_path_ + ", or the name of a new file";
  if (columns[0]->size() != points_.size())
    throw UserError(
        path_,
        "holds another cloud: " + std::to_string(columns[0]->size()) + " points, not " + std::to_string(points_.size()),
        expected);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d place((*columns[0])[i], (*columns[1])[i], (*columns[2])[i]);
    const bool is_same = (place - offset_ - points_[i].cast<double>()).cwiseAbs().maxCoeff() <= kSamePointDistance;
    if (!is_same && points_[i].allFinite())
      throw UserError(path_, "holds another cloud: point " + std::to_string(i) + " is elsewhere", expected);
  }
}

CorrectionList CorrectionFile::read(const TeachUnits& units) const {
  requireSameCloud();
  SceneFiles files;
  files.points = path_;
  std::vector<SceneClass> labels = scene_labeler::ClassMap().toClasses(readSceneLabels(files, false), path_);
  CorrectionList list;
  bool has_units = false;
  for (const std::string& comment : headerComments(path_)) {
    has_units = has_units || comment == kSuperpixelWord + std::to_string(superpixel_);
    if (comment.rfind(kCorrectionWord, 0) != 0) continue;
    if (const auto correction = parseCorrection(comment, points_.size())) list.add(*correction);
  }
  if (has_units && list.labels(units) == labels) return list;
  return CorrectionList(std::move(labels));
}

void CorrectionFile::write(const CorrectionList& corrections, const TeachUnits& units) const {
  urban_nav_core::PlyLayout layout;
  for (const char* axis : {"x", "y", "z"})
    layout.properties.push_back({axis, is_far_ ? PlyType::Double : PlyType::Float});
  if (has_reflectance_) layout.properties.push_back({"reflectance", PlyType::Float});
  layout.properties.push_back({"label", PlyType::UChar});
  layout.comments = labelLayout().comments;
  if (has_image_ && !scene_path_.empty()) layout.comments.push_back(kSceneWord + scene_path_);
  layout.comments.push_back(kSuperpixelWord + std::to_string(superpixel_));
  for (const LabelCorrection& correction : corrections.active()) layout.comments.push_back(printCorrection(correction));
  const std::vector<SceneClass> labels = corrections.labels(units);
  std::string bytes = urban_nav_core::plyHeader(layout, points_.size());
  bytes.reserve(bytes.size() + (vertex_bytes_ + 1) * points_.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    bytes.append(vertices_, i * vertex_bytes_, vertex_bytes_);
    appendLittleEndian(bytes, static_cast<std::uint8_t>(labels[i]));
  }
  urban_nav_core::writeAtomically(path_, bytes);
}

std::string picturedScene(const std::string& path) {
  for (const std::string& comment : headerComments(path))
    if (comment.rfind(kSceneWord, 0) == 0) return comment.substr(kSceneWord.size());
  return "";
}

}  // namespace urban_nav
