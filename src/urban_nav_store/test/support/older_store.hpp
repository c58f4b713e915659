// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/folder.hpp"

namespace urban_nav_store::testing {

/// Converts a store to an earlier schema. Rows of tables that the schema lacks, or has with fewer columns or in
/// another layout, are lost.
void makeOlder(const std::string& path, const Folder& folder, int version);

}  // namespace urban_nav_store::testing
