// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// All rows of all tables as text, in the order of their keys, binary columns by digest: two stores hold the same if and only
/// if their dumps are equal, whatever the bytes of their files. Reads and verifies the whole file: DataError where it is
/// damaged.
std::string dump(Store& store);

}  // namespace urban_nav_store
