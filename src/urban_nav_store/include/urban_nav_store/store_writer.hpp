// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// Returns whether any program, including this one, has a store open for writing. False if there is no store.
bool isBeingWritten(const std::string& path);

}  // namespace urban_nav_store
