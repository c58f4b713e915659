// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core::testing {

/// Returns the faults of the parameter tables of a package, one per line; empty: none. config/STAGE.yaml and the tables
/// in README.md must be as printed from the rows, each row of the stage must state its source, and no row of the
/// nodelet may hide one of the stage. Without `of_nodelet` the package has one table. For tests, which run in the
/// folder of the package. Throws UserError if a file is missing or has no markers.
std::string findFaults(const std::string& stage, const std::vector<RowInfo>& of_stage,
                       const std::vector<RowInfo>& of_nodelet = {});

}  // namespace urban_nav_core::testing
