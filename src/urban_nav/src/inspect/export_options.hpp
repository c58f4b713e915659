// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/command.hpp"

namespace urban_nav {

/// Returns the options of `export`.
std::vector<Option> exportOptions();

}  // namespace urban_nav
