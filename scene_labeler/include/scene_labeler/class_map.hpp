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

/// Map from the labels of a source to classes. Without a file, labels are the numbers of classes.
class ClassMap {
 public:
  ClassMap() = default;
  /// Reads `id,class`; class `ignore` gives None. Throws UserError for an unknown class or an id that is listed twice.
  explicit ClassMap(const std::string& path);

  /// Returns the class of each label. Throws UserError naming `where` for a label that is not in the file.
  std::vector<SceneClass> toClasses(const std::vector<std::int64_t>& labels, const std::string& where) const;
  /// Returns the class of a label; nullopt if it is not in the file, or without a file if it is not a class.
  std::optional<SceneClass> classOf(std::int64_t label) const;

 private:
  std::string path_;
  std::map<std::int64_t, SceneClass> classes_;
};

/// Returns the classes of an image of labels (CV_8U), None for labels that are not in the map; empty for another pixel
/// type.
cv::Mat toClassImage(const cv::Mat& ids, const ClassMap& map);

}  // namespace scene_labeler
