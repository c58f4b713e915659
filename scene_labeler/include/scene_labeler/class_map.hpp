// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene_labeler/classes.hpp"

namespace urban_nav {

/// Classes of the labels of a source. Without a file the labels are the classes' own numbers.
class ClassMap {
 public:
  ClassMap() = default;
  /// Reads `id,class`; class `ignore` gives None. Throws UserError for an unknown class or an id that is listed twice.
  explicit ClassMap(const std::string& path);

  /// Returns the class of each label. Throws UserError naming `where` for a label that the file does not list.
  std::vector<scene_labeler::SceneClass> toClasses(const std::vector<std::int64_t>& labels,
                                                   const std::string& where) const;

 private:
  std::string path_;
  std::map<std::int64_t, scene_labeler::SceneClass> classes_;
};

}  // namespace urban_nav
