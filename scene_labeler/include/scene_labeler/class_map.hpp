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

/// Classes of the labels of a source. Without a file the labels are the classes' own numbers.
class ClassMap {
 public:
  ClassMap() = default;
  /// Reads `id,class`; class `ignore` gives None. Throws UserError for an unknown class or an id that is listed twice.
  explicit ClassMap(const std::string& path);

  /// Returns the class of each label. Throws UserError naming `where` for a label that the file does not list.
  std::vector<SceneClass> toClasses(const std::vector<std::int64_t>& labels, const std::string& where) const;
  /// Returns the class of a label; nullopt if the file does not list it, or without a file if it is no class.
  std::optional<SceneClass> classOf(std::int64_t label) const;

 private:
  std::string path_;
  std::map<std::int64_t, SceneClass> classes_;
};

/// Returns the classes of an image of ids (CV_8U), None for ids that the map does not list; empty if it is of another
/// type.
cv::Mat toClassImage(const cv::Mat& ids, const ClassMap& map);

}  // namespace scene_labeler
