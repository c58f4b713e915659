// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene_labeler/classes.hpp"

namespace scene_labeler {

/// Label of a public data set and its class; None: without information, or of the recording vehicle.
struct PublicLabel {
  std::int64_t id = 0;
  const char* name = "";  ///< in the data set
  SceneClass scene_class = SceneClass::None;
};

/// Labels of a public data set.
struct ClassTable {
  const char* name = "";           ///< as in --classes
  const char* data_set = "";       ///< for messages
  std::int64_t id_bits = ~0;       ///< bits of a label that are its id
  std::vector<PublicLabel> labels;  ///< ascending by id
};

/// Returns the table of a name; nullptr for another name.
const ClassTable* findClassTable(std::string_view name);

/// Returns the names of all tables, separated by ", ".
std::string classTableNames();

}  // namespace scene_labeler
