// SPDX-License-Identifier: BSD-3-Clause
// Prints what the table of parameters says, or writes it into README.md. The build target urban_nav_sim_documents runs it;
// test/parameters_test.cpp holds text and table equal.

#include <iostream>
#include <string>

#include "simulator_parameters.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto& table = urban_nav_sim::simulatorTable();
  try {
    if (what == "--markdown") {
      std::cout << printMarkdown(table.stage(), table.rows());
    } else if (what == "--write" && argc == 3) {
      const std::string path = std::string(argv[2]) + "/README.md";
      const std::string readme = urban_nav_core::readTextFile(path);
      urban_nav_core::writeAtomically(path, insertMarkdown(readme, path, table.stage(), table.rows()));
    } else {
      std::cerr << "urban_nav_sim_parameters --markdown | --write FOLDER_OF_THE_PACKAGE\n";
      return 2;
    }
  } catch (const urban_nav_core::UserError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 0;
}
