// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "topics/labels/teach/correction_list.hpp"

namespace urban_nav {

/// Request of a page.
struct TeachWords {
  enum class Action { Correct, Undo, Redo };
  Action action = Action::Correct;
  LabelCorrection correction;  ///< of Correct
};

/// Reads {"action": "correct", "point": 12, "radius": 0.5, "class": "paved"} (radius may be absent; class `none` takes
/// a class back), {"action": "undo"} or {"action": "redo"}. Throws UserError for other content.
TeachWords parseTeachWords(std::string_view json);

}  // namespace urban_nav
