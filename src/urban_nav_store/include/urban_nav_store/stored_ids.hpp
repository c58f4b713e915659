// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Returns whether a text can be the id of a session or the hash of a model: 16 to 64 hexadecimal digits in lower case.
/// Another text could name a file elsewhere ("../x") once it becomes part of a path.
bool isStoredId(std::string_view text);

/// Opens a store of any origin for reading: ids of sessions and hashes of models are checked
/// before anything is made of them. Throws what Store throws, and DataError that names the table and the id.
Store openForReading(const std::string& path, Access access = Access::Snapshot);

}  // namespace urban_nav_store
