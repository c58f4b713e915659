// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/class_map.hpp"

#include <filesystem>

#include "class_tables.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {

using urban_nav_core::UserError;

ClassMap::ClassMap(const std::string& name_or_path) {
  const ClassTable* known = findClassTable(name_or_path);
  if (known == nullptr) {
    readTable(name_or_path);
    return;
  }
  expected_ids_ = std::string("the ids of ") + known->data_set;
  id_bits_ = known->id_bits;
  for (const PublicLabel& label : known->labels) classes_.emplace(label.id, label.scene_class);
}

void ClassMap::readTable(const std::string& path) {
  if (!std::filesystem::exists(path))
    throw UserError(path, "is neither a file nor a known set of labels", classTableNames() + ", or a file id,class");
  expected_ids_ = "the ids in " + path;
  const auto table = urban_nav_core::CsvTable::read(path);
  const std::size_t id_column = table.column("id"), class_column = table.column("class");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::int64_t id = table.integer(row, id_column);
    const std::string& name = table.text(row, class_column);
    const auto known = classFromName(name);
    if (!known && name != "ignore") throw UserError(table.where(row), "class = " + name, classNames() + ", ignore");
    if (!classes_.emplace(id, known.value_or(SceneClass::None)).second)
      throw UserError(table.where(row), "id = " + std::to_string(id) + " again", "each id once");
  }
}

std::optional<SceneClass> ClassMap::classOf(std::int64_t label) const {
  if (isOwnNumbers()) {
    const bool is_known = (label >= 0 && label < static_cast<std::int64_t>(kClassCount)) || label == 255;
    return is_known ? std::optional(static_cast<SceneClass>(label)) : std::nullopt;
  }
  const auto found = classes_.find(label & id_bits_);
  return found == classes_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<SceneClass> ClassMap::toClasses(const std::vector<std::int64_t>& labels, const std::string& where) const {
  std::vector<SceneClass> classes;
  classes.reserve(labels.size());
  for (const std::int64_t label : labels) {
    const auto known = classOf(label);
    if (!known)
      throw UserError(where, "label = " + std::to_string(label),
                      isOwnNumbers() ? "0...8 and 255, or --classes for other numbers" : expected_ids_);
    classes.push_back(*known);
  }
  return classes;
}

cv::Mat toClassImage(const cv::Mat& ids, const ClassMap& map) {
  if (ids.empty() || ids.type() != CV_8U) return {};
  cv::Mat table(1, 256, CV_8U), classes;
  for (int id = 0; id < 256; ++id)
    table.at<std::uint8_t>(id) = static_cast<std::uint8_t>(map.classOf(id).value_or(SceneClass::None));
  cv::LUT(ids, table, classes);
  return classes;
}

}  // namespace scene_labeler
