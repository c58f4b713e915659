// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/assignment.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// The rows of one stage, without the type of its struct.
struct StageRows {
  std::string stage;
  std::vector<RowInfo> rows;
};

/// Assignments under present names, and a sentence for each old name that was used.
struct RenamedAssignments {
  std::vector<Assignment> assignments;
  std::vector<std::string> warnings;
};

/// Returns the assignments with old names (Row::old_names) replaced by present ones, in the same order. An old name
/// without a dot belongs to the row's own stage; one with a dot may name another stage, whose rows have moved. Old
/// words follow a colon, `"forget: delete = none"`: they are replaced where the old name is used, and no other words.
///
/// A warning names the place and the present name. Where several old names of one parameter are assigned different
/// values, as when two stages had a copy each, a further warning names both places; the last one counts.
RenamedAssignments replaceOldNames(std::vector<Assignment> assignments, const std::vector<StageRows>& tables);

/// Returns whether `name` is the row's name, or one of its old names without their stage: for name spaces that do not
/// tell stages apart, such as a nodelet's private one.
bool isCalled(const RowInfo& row, const std::string& name);

}  // namespace urban_nav_core
