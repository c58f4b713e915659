// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/documents.hpp"

#include <filesystem>
#include <iostream>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

std::string findParameterDocument(const std::string& package) {
  return std::filesystem::exists(package + "/PARAMETERS.md") ? "PARAMETERS.md" : "README.md";
}

void writeDocuments(const std::string& package, const std::vector<DocumentedTable>& tables) {
  const std::string path = package + "/" + findParameterDocument(package);
  std::string text = readTextFile(path);
  for (const DocumentedTable& table : tables) text = insertMarkdown(text, path, table.stage, table.rows);
  for (const DocumentedTable& table : tables) {
    const std::string yaml = package + "/config/" + table.stage + ".yaml";
    if (std::filesystem::exists(yaml)) writeAtomically(yaml, printYaml(table.stage, table.rows));
  }
  writeAtomically(path, text);
}

int documentParameters(int argc, char** argv, const std::vector<DocumentedTable>& tables) {
  const std::string what = argc > 1 ? argv[1] : "";
  try {
    if (what == "--markdown" && argc == 2) {
      for (const DocumentedTable& table : tables) std::cout << printMarkdown(table.stage, table.rows) << "\n";
    } else if (what == "--write" && argc == 3) {
      writeDocuments(argv[2], tables);
    } else {
      std::cerr << "usage: " << std::filesystem::path(argv[0]).filename().string()
                << " --markdown | --write FOLDER_OF_THE_PACKAGE\n";
      return 2;
    }
  } catch (const UserError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  } catch (const DataError& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}

}  // namespace urban_nav_core
