// SPDX-License-Identifier: BSD-3-Clause
#include "labels/class_map.hpp"

#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;
using urban_nav_core::UserError;

ClassMap::ClassMap(const std::string& path) : path_(path) {
  const auto table = urban_nav_core::CsvTable::read(path);
  const std::size_t id_column = table.column("id"), class_column = table.column("class");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::int64_t id = table.integer(row, id_column);
    const std::string& name = table.text(row, class_column);
    const auto known = scene_labeler::classFromName(name);
    if (!known && name != "ignore")
      throw UserError(table.where(row), "class = " + name, scene_labeler::classNames() + ", ignore");
    if (!classes_.emplace(id, known.value_or(SceneClass::None)).second)
      throw UserError(table.where(row), "id = " + std::to_string(id) + " again", "each id once");
  }
}

std::vector<SceneClass> ClassMap::toClasses(const std::vector<std::int64_t>& labels, const std::string& where) const {
  std::vector<SceneClass> classes;
  classes.reserve(labels.size());
  for (const std::int64_t label : labels) {
    if (path_.empty()) {
      const bool is_known =
          (label >= 0 && label < static_cast<std::int64_t>(scene_labeler::class_count)) || label == 255;
      if (!is_known)
        throw UserError(where, "label = " + std::to_string(label),
                        "0...8 and 255, or --classes FILE for other numbers");
      classes.push_back(static_cast<SceneClass>(label));
      continue;
    }
    const auto found = classes_.find(label);
    if (found == classes_.end()) throw UserError(where, "label = " + std::to_string(label), "the ids in " + path_);
    classes.push_back(found->second);
  }
  return classes;
}

}  // namespace urban_nav
