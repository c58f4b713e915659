// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace urban_nav {

/// Returns the folder for PYTHONPATH with which `import urban_nav` works, in the devel or install space of `program`.
/// Throws UserError if the Python module is missing.
std::string pythonPath(const std::filesystem::path& program);

/// Returns the PYTHONPATH folder for the running program.
std::string pythonPath();

}  // namespace urban_nav
