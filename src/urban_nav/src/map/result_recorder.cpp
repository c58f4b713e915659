// SPDX-License-Identifier: BSD-3-Clause
#include "map/result_recorder.hpp"

#include <filesystem>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

void checkResultPath(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".mcap")
    throw urban_nav_core::UserError("--mcap", path, "a name that ends in .mcap");
}

}  // namespace urban_nav
