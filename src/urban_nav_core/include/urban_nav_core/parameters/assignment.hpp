// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// Value that the user assigns to a key. Text (YAML, --set) is parsed by the type of its row; values of the parameter
/// server are typed.
struct Assignment {
  std::string stage;  ///< "swf_vo"; "" for keys without a stage
  std::string name;   ///< "window"
  ParameterValue value;
  bool is_text = true;  ///< `value` is a string that is still to be parsed by the row's type
  std::string where;    ///< "config.yaml:12", "--set swf_vo.window=25", "/swf_vo/window"
};

}  // namespace urban_nav_core
