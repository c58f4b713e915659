// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core::testing {

/// What is wrong with the tables of a package that has a nodelet, one line each; empty: nothing. config/STAGE.yaml and
/// the two tables in README.md are as printed from the rows; each row of the stage says where it comes from; no row of
/// the nodelet hides one of the stage. Without `of_nodelet` the one table is all there is. For tests, which run in the
/// folder of the package. Throws UserError where a file is not there or has no markers.
std::string findFaults(const std::string& stage, const std::vector<RowInfo>& of_stage,
                       const std::vector<RowInfo>& of_nodelet = {});

}  // namespace urban_nav_core::testing
