// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Returns all rows of all tables as text, in the order of their keys, binary columns by digest. Two stores have the
/// same content if and only if their dumps are equal. Reads and verifies the whole file. Throws DataError if it is
/// damaged.
std::string dump(Store& store);

}  // namespace urban_nav_store
