// SPDX-License-Identifier: BSD-3-Clause
#include "base/scratch_folder.hpp"

#include <stdlib.h>

#include <filesystem>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() : path_((fs::temp_directory_path() / "urban_nav-XXXXXX").string()) {
  if (::mkdtemp(path_.data()) == nullptr)
    throw urban_nav_core::UserError(path_, "cannot be made",
                                    "a folder for temporary files (TMPDIR) that can be written");
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace urban_nav
