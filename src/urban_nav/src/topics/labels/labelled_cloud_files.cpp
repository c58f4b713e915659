// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labelled_cloud_files.hpp"

#include <cmath>

#include "topics/labels/label_columns.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;
using urban_nav_core::appendLittleEndian;
using urban_nav_core::LasAttribute;
using urban_nav_core::PlyType;

namespace {

constexpr double kLasReach = 200'000.0;  // m from the first point, along an axis (LasWriter)
constexpr const char* kSourceSystem =
    R"(LOCAL_CS["coordinates of the source",LOCAL_DATUM["source",0],UNIT["metre",1],AXIS["x",OTHER],AXIS["y",OTHER],AXIS["z",UP]])";

urban_nav_core::PlyLayout cloudLayout(const LabelledCloudFiles::Columns& columns) {
  const PlyType coordinate = columns.is_far ? PlyType::Double : PlyType::Float;
  urban_nav_core::PlyLayout layout;
  for (const char* axis : {"x", "y", "z"}) layout.properties.push_back({axis, coordinate});
  if (columns.has_reflectance) layout.properties.push_back({"reflectance", PlyType::Float});
  if (columns.has_stamps) layout.properties.push_back({"stamp", PlyType::Double});
  const urban_nav_core::PlyLayout labels = labelLayout();
  layout.properties.insert(layout.properties.end(), labels.properties.begin(), labels.properties.end());
  layout.comments = labels.comments;
  return layout;
}

std::vector<LasAttribute> cloudAttributes(const LabelledCloudFiles::Columns& columns) {
  std::vector<LasAttribute> attributes;
  if (columns.has_reflectance) attributes.push_back({"reflectance", LasAttribute::Type::Float, "units of the source"});
  attributes.push_back({"label", LasAttribute::Type::UChar, "class of scene_labeler"});
  attributes.push_back({"label_probability", LasAttribute::Type::Float, "of the label"});
  attributes.push_back({"unsure", LasAttribute::Type::UChar, "1: the label is unsure"});
  return attributes;
}

void appendLabelBytes(std::string& bytes, const LabelledPoint& point) {
  appendLittleEndian(bytes, static_cast<std::uint8_t>(point.label));
  appendLittleEndian(bytes, point.probability);
  appendLittleEndian(bytes, static_cast<std::uint8_t>(point.is_unsure ? 1 : 0));
}

LabelledPoint withLabel(LabelledPoint point, const scene_labeler::SceneLabels& labels, std::size_t i) {
  point.label = labels.labels[i];
  if (point.label == SceneClass::None) return point;
  point.probability = labels.probability(i);
  point.is_unsure = labels.unsure[i] != 0;
  return point;
}

}  // namespace

Option labelFormatsOption() {
  return {"--formats", "csv,ply,las", "formats of the labels of points (default: all)", false, false, {}};
}

LabelFormats readLabelFormats(const Arguments& arguments) {
  if (!arguments.has("formats")) return {};
  LabelFormats formats{false, false, false};
  for (const std::string& name : arguments.list("formats")) {
    if (name == "csv") formats.csv = true;
    else if (name == "ply") formats.ply = true;
    else if (name == "las") formats.las = true;
    else throw urban_nav_core::UserError("--formats", name, "csv, ply, las");
  }
  return formats;
}

LabelledCloudFiles::LabelledCloudFiles(const std::string& base, const LabelFormats& formats, const Columns& columns)
    : columns_(columns) {
  if (formats.ply) ply_.emplace(base + ".ply", cloudLayout(columns));
  if (formats.las) las_.emplace(base + ".las", cloudAttributes(columns), kSourceSystem);
}

void LabelledCloudFiles::append(const LabelledPoint& point) {
  if (ply_) appendPly(point);
  if (las_) appendLas(point);
}

void LabelledCloudFiles::appendPly(const LabelledPoint& point) {
  bytes_.clear();
  for (const double value : {point.p.x(), point.p.y(), point.p.z()}) {
    if (columns_.is_far) appendLittleEndian(bytes_, value);
    else appendLittleEndian(bytes_, static_cast<float>(value));
  }
  if (columns_.has_reflectance) appendLittleEndian(bytes_, point.reflectance);
  if (columns_.has_stamps) appendLittleEndian(bytes_, 1e-9 * static_cast<double>(point.stamp));
  appendLabelBytes(bytes_, point);
  ply_->append(bytes_);
}

void LabelledCloudFiles::appendLas(const LabelledPoint& point) {
  if (!first_ && point.p.allFinite()) first_ = point.p;
  if (!point.p.allFinite() || (point.p - *first_).cwiseAbs().maxCoeff() > kLasReach) {
    ++left_out_;
    return;
  }
  urban_nav_core::LasPoint las;
  las.p = point.p;
  las.classification = lasClassification(point.label);
  las.stamp = point.stamp;
  bytes_.clear();
  if (columns_.has_reflectance) appendLittleEndian(bytes_, point.reflectance);
  appendLabelBytes(bytes_, point);
  las_->append(las, bytes_);
}

void LabelledCloudFiles::commit() {
  if (ply_) ply_->commit();
  if (las_) las_->commit();
}

void appendDrive(const std::vector<scene_labeler::DriveReturn>& returns, const scene_labeler::SceneLabels& labels,
                 LabelledCloudFiles& files) {
  for (std::size_t i = 0; i < returns.size(); ++i) {
    LabelledPoint point;
    point.p = returns[i].point.cast<double>();
    point.reflectance = returns[i].reflectance;
    point.stamp = returns[i].scan;
    files.append(withLabel(point, labels, i));
  }
}

void appendSweep(const std::vector<urban_nav_core::LaserPoint>& returns, const scene_labeler::SweepLabels& labels,
                 LabelledCloudFiles& files) {
  for (std::size_t i = 0; i < returns.size(); ++i) {
    LabelledPoint point;
    point.p = returns[i].p.cast<double>();
    point.reflectance = returns[i].intensity;
    point.stamp = returns[i].stamp;
    const std::uint32_t row = labels.answer_of_return[i];
    files.append(row == scene_labeler::SweepLabels::kNoAnswer ? point : withLabel(point, labels.answers, row));
  }
}

std::size_t writeSceneCloud(const std::string& base, const LabelFormats& formats, const SceneInput& input,
                            const scene_labeler::SceneLabels& labels) {
  if (!formats.ply && !formats.las) return 0;
  const scene_labeler::Scene& scene = input.scene;
  LabelledCloudFiles files(base, formats, {!input.offset.isZero(), !scene.reflectance.empty(), false});
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    LabelledPoint point;
    point.p = scene.points[i].cast<double>() + input.offset;
    if (!scene.reflectance.empty()) point.reflectance = scene.reflectance[i];
    files.append(withLabel(point, labels, i));
  }
  files.commit();
  return files.leftOut();
}

}  // namespace urban_nav
