// SPDX-License-Identifier: BSD-3-Clause
// Prints what the tables of parameters say, or writes it to where it belongs: config/swf_vo.yaml and the two tables of
// README.md. The build target swf_vo_documents runs it; test/parameters_test.cpp holds file and table equal.

#include <iostream>
#include <string>

#include "nodelet_parameters.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"

namespace {

using urban_nav_core::insertMarkdown;

int write(const std::string& package) {
  const auto& rows = swf_vo::table();
  const auto& nodelet = swf_vo::nodeletTable();
  urban_nav_core::writeAtomically(package + "/config/swf_vo.yaml", printYaml(rows.stage(), rows.rows()));
  const std::string path = package + "/README.md";
  std::string readme = insertMarkdown(urban_nav_core::readTextFile(path), path, rows.stage(), rows.rows());
  readme = insertMarkdown(readme, path, nodelet.stage(), nodelet.rows());
  urban_nav_core::writeAtomically(path, readme);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto& rows = swf_vo::table();
  const auto& nodelet = swf_vo::nodeletTable();
  try {
    if (what == "--yaml") std::cout << printYaml(rows.stage(), rows.rows());
    else if (what == "--markdown")
      std::cout << printMarkdown(rows.stage(), rows.rows()) << "\n" << printMarkdown(nodelet.stage(), nodelet.rows());
    else if (what == "--write" && argc == 3) return write(argv[2]);
    else {
      std::cerr << "swf_vo_parameters --yaml | --markdown | --write FOLDER_OF_THE_PACKAGE\n";
      return 2;
    }
  } catch (const urban_nav_core::UserError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 0;
}
