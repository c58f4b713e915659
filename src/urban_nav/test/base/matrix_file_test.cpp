// SPDX-License-Identifier: BSD-3-Clause
#include "base/matrix_file.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

std::vector<double> readText(const std::string& text) {
  const urban_nav_input::testing::TemporaryFolder folder;
  urban_nav_input::testing::writeFile(folder.file("m.txt"), text);
  return readMatrixFile(folder.file("m.txt"));
}

TEST(MatrixFile, IsReadInEveryFormOfATable) {
  const std::vector<double> numbers = {1.0, 0.5, -2.25, 0.0, 1.0, 3.5};
  for (const char* text : {"1 0.5 -2.25\n0 1 3.5\n", "1,0.5,-2.25\r\n0,1,3.5", "1;0,5;-2,25\n0;1;3,5\n",
                           "# T_target_source\n1 0.5 -2.25 0 1 3.5\n",
                           "\xEF\xBB\xBF"
                           "1\t0.5\t-2.25\n0\t1\t3.5\n"})
    EXPECT_EQ(readText(text), numbers) << text;
}

TEST(MatrixFile, NamesTheLineOfWhatIsNoNumber) {
  try {
    readText("1 0.5 2\n0 nan 3\n");
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("m.txt:2: `nan`"), std::string::npos) << error.what();
  }
  EXPECT_THROW(readText("r1 r2 r3\n1 2 3\n"), urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav
