// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/assignment.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// Rows of one stage, independent of the type of its parameters.
struct StageRows {
  std::string stage;
  std::vector<RowInfo> rows;
};

/// Assignments to present names, and a warning for each old name that was used.
struct RenamedAssignments {
  std::vector<Assignment> assignments;
  std::vector<std::string> warnings;
};

/// Replaces old names (Row::old_names) in the assignments by present ones, keeping their order. An old name without a
/// dot belongs to the row's own stage; one with a dot may name another stage from which the row was moved. Old values
/// follow a colon, `"forget: delete = none"`, and are replaced only where the old name is used.
///
/// A warning states the location and the present name. If several old names of one parameter are assigned different
/// values, as after merging a parameter of two stages, a further warning names both locations; the last one is used.
RenamedAssignments replaceOldNames(std::vector<Assignment> assignments, const std::vector<StageRows>& tables);

/// Returns whether `name` is the row's name, or one of its old names without their stage; for namespaces that do not
/// distinguish stages, such as a nodelet's private one.
bool isCalled(const RowInfo& row, const std::string& name);

}  // namespace urban_nav_core
