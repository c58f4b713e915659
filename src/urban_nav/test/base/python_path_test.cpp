// SPDX-License-Identifier: BSD-3-Clause
#include "base/python_path.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;

TEST(PythonPath, IsThatOfTheSpaceOfTheProgram) {
  const fs::path space = fs::path(::testing::TempDir()) / "python_path";
  fs::remove_all(space);
  const fs::path packages = space / "lib/python3/dist-packages";
  for (const char* program : {"lib/urban_nav/urban_nav", "bin/urban_nav"})
    EXPECT_THROW(pythonPath(space / program), urban_nav_core::UserError);
  fs::create_directories(packages / "urban_nav");
  std::ofstream(packages / "urban_nav/__init__.py") << "";
  for (const char* program : {"lib/urban_nav/urban_nav", "bin/urban_nav"})
    EXPECT_EQ(pythonPath(space / program), packages.string());
}

}  // namespace
}  // namespace urban_nav
