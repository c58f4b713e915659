// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/numbered_path.hpp"

#include <filesystem>

namespace urban_nav {

std::string numberedPath(const std::string& path, std::size_t map) {
  if (map == 0) return path;
  const std::filesystem::path given(path);
  return (given.parent_path() / (given.stem().string() + "_" + std::to_string(map + 1) + given.extension().string()))
      .string();
}

}  // namespace urban_nav
