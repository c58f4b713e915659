// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Returns whether a text can be the id of a session or the hash of a model: 16 to 64 hexadecimal digits in lower case.
/// Any other text ("../x") could refer to another file if used in a path.
bool isStoredId(std::string_view text);

/// Opens a store of unknown origin for reading, and checks the ids of sessions and the hashes of models. Throws the
/// errors of Store, and DataError naming the table and the invalid id.
Store openForReading(const std::string& path, Access access = Access::Snapshot);

}  // namespace urban_nav_store
