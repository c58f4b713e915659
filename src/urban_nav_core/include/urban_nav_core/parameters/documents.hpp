// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// Parameter table for documents (Table::stage, Table::rows).
struct DocumentedTable {
  std::string stage;
  std::vector<RowInfo> rows;
};

/// Returns the name of the file in a package's folder that holds its parameter tables: PARAMETERS.md if it exists,
/// otherwise README.md.
std::string findParameterDocument(const std::string& package);

/// Writes the parameters into a package's documents: the tables between their markers in findParameterDocument(), and
/// config/STAGE.yaml of each stage that has one. Throws UserError naming the file that is missing or has no markers.
void writeDocuments(const std::string& package, const std::vector<DocumentedTable>& tables);

/// Main function of the program that calls writeDocuments(): `--write FOLDER_OF_THE_PACKAGE`, or `--markdown` to print
/// the tables.
int documentParameters(int argc, char** argv, const std::vector<DocumentedTable>& tables);

}  // namespace urban_nav_core
