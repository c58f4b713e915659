// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "scene_labeler/drive/drive_scene.hpp"
#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/sweep/sweep_labeler.hpp"
#include "topics/labels/scene_files.hpp"
#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav {

/// Formats of the labels of points, of the option --formats; all by default.
struct LabelFormats {
  bool csv = true, ply = true, las = true;
};

/// Returns the option --formats, and its value. Throws UserError for another format.
Option labelFormatsOption();
LabelFormats readLabelFormats(const Arguments& arguments);

/// Point with its label.
struct LabelledPoint {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< m
  float reflectance = 0.0F;                     ///< in units of the source
  urban_nav_core::StampNs stamp = 0;
  scene_labeler::SceneClass label = scene_labeler::SceneClass::None;
  float probability = 0.0F;
  bool is_unsure = false;
};

/// Writes labelled points as PLY and LAS, in the order of append(). Columns: x, y, z, [reflectance], [stamp in s],
/// label, label_probability, unsure; in LAS these are attributes, with the classification of lasClassification(). The
/// files appear with commit(). Not thread-safe. Throws UserError or DataError naming the path.
class LabelledCloudFiles {
 public:
  struct Columns {
    bool is_far = false;  ///< coordinates in double precision
    bool has_reflectance = false;
    bool has_stamps = false;
  };
  /// `base`: path without extension.
  LabelledCloudFiles(const std::string& base, const LabelFormats& formats, const Columns& columns);

  void append(const LabelledPoint& point);
  void commit();
  /// Returns the number of points that LAS cannot hold: not finite, or more than 200 km from the first one. They are
  /// in the PLY file.
  std::size_t leftOut() const { return left_out_; }

 private:
  void appendPly(const LabelledPoint& point);
  void appendLas(const LabelledPoint& point);

  const Columns columns_;
  std::optional<urban_nav_core::PlyWriter> ply_;
  std::optional<urban_nav_core::LasWriter> las_;
  std::optional<Eigen::Vector3d> first_;
  std::size_t left_out_ = 0;
  std::string bytes_;
};

/// Appends the returns of a drive. Requires columns with reflectance and stamps.
void appendDrive(const std::vector<scene_labeler::DriveReturn>& returns, const scene_labeler::SceneLabels& labels,
                 LabelledCloudFiles& files);
/// Appends the returns of a sweep. Requires columns with reflectance and stamps.
void appendSweep(const std::vector<urban_nav_core::LaserPoint>& returns, const scene_labeler::SweepLabels& labels,
                 LabelledCloudFiles& files);
/// Writes the points of a scene. Returns the number of points that the LAS file lacks.
std::size_t writeSceneCloud(const std::string& base, const LabelFormats& formats, const SceneInput& input,
                            const scene_labeler::SceneLabels& labels);

}  // namespace urban_nav
