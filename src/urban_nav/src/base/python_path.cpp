// SPDX-License-Identifier: BSD-3-Clause
#include "base/python_path.hpp"

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

std::string pythonPath(const fs::path& program) {
  const fs::path folder = program.parent_path();
  // lib/urban_nav of a catkin space, and bin.
  for (const char* libraries : {"..", "../lib"})
    for (const char* packages : {"python3/dist-packages", "python3/site-packages"}) {
      const fs::path found = (folder / libraries / packages).lexically_normal();
      if (fs::exists(found / "urban_nav" / "__init__.py")) return found.string();
    }
  throw urban_nav_core::UserError(program.string(), "the Python module urban_nav is not installed with it",
                                  "a build of the package urban_nav_python");
}

std::string pythonPath() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return pythonPath(error ? fs::path("urban_nav") : program);
}

}  // namespace urban_nav
