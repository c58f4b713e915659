// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// A table of parameters as texts show it (Table::stage, Table::rows).
struct DocumentedTable {
  std::string stage;
  std::vector<RowInfo> rows;
};

/// Returns the name of the file in a package's folder that holds the tables of its parameters: PARAMETERS.md if there
/// is one, otherwise README.md.
std::string findParameterDocument(const std::string& package);

/// Writes the documents of a package's parameters: the tables between their markers in findParameterDocument(), and
/// config/STAGE.yaml for each stage that has such a file. Throws UserError naming the text that is missing, or lacks
/// its markers.
void writeDocuments(const std::string& package, const std::vector<DocumentedTable>& tables);

/// The main function of a package's program for that: `--write FOLDER_OF_THE_PACKAGE`, or `--markdown` to print the
/// tables.
int documentParameters(int argc, char** argv, const std::vector<DocumentedTable>& tables);

}  // namespace urban_nav_core
