// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace urban_nav {

/// Returns the folder for PYTHONPATH with which `import urban_nav` works: that of the space, devel or install, which
/// holds `program`. Throws UserError if the Python module is not there.
std::string pythonPath(const std::filesystem::path& program);

/// The same for this program.
std::string pythonPath();

}  // namespace urban_nav
