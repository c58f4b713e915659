// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene_labeler/classes.hpp"

namespace scene_labeler {

/// Map from the labels of a source to classes. The default map takes labels as the numbers of classes.
class ClassMap {
 public:
  ClassMap() = default;
  /// Takes the labels of a public data set (`kitti`, `semantickitti`, `nuscenes`; class_tables.cpp), or reads a file
  /// `id,class`; class `ignore` gives None. Throws UserError for a file that does not exist, an unknown class or an id
  /// that is listed twice.
  explicit ClassMap(const std::string& name_or_path);

  /// Returns the class of each label. Throws UserError naming `where` for a label that is not in the map.
  std::vector<SceneClass> toClasses(const std::vector<std::int64_t>& labels, const std::string& where) const;
  /// Returns the class of a label; nullopt if it is not in the map.
  std::optional<SceneClass> classOf(std::int64_t label) const;
  /// Returns whether this is the default map.
  bool isOwnNumbers() const { return expected_ids_.empty(); }

 private:
  void readTable(const std::string& path);

  std::string expected_ids_;  // for errors; empty: the numbers of classes
  std::int64_t id_bits_ = ~0;
  std::map<std::int64_t, SceneClass> classes_;
};

/// Returns the classes of an image of labels (CV_8U), None for labels that are not in the map; empty for another pixel
/// type.
cv::Mat toClassImage(const cv::Mat& ids, const ClassMap& map);

}  // namespace scene_labeler
