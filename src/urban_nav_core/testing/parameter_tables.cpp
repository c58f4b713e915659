// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_tables.hpp"

#include <algorithm>

#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/documents.hpp"
#include "urban_nav_core/parameters/print.hpp"

namespace urban_nav_core::testing {

std::string findFaults(const std::string& stage, const std::vector<RowInfo>& of_stage,
                       const std::vector<RowInfo>& of_nodelet) {
  std::string faults;
  const auto demand = [&](bool so, const std::string& fault) {
    if (!so) faults += fault + "\n";
  };
  const std::string yaml = "config/" + stage + ".yaml", document = findParameterDocument(".");
  const std::string text = readTextFile(document);
  const std::string instruction = ": regenerate it with the target *_documents of the package";
  demand(readTextFile(yaml) == printYaml(stage, of_stage), yaml + instruction);
  demand(text == insertMarkdown(text, document, stage, of_stage), document + ", the stage" + instruction);
  demand(of_nodelet.empty() || text == insertMarkdown(text, document, "", of_nodelet),
         document + ", the nodelet" + instruction);
  for (const RowInfo& row : of_stage) {
    demand(!row.source.empty(), row.name + " has no source");
    demand(std::none_of(of_nodelet.begin(), of_nodelet.end(), [&](const RowInfo& own) { return own.name == row.name; }),
           row.name + " is hidden by one of the nodelet");
  }
  for (const auto* rows : {&of_stage, &of_nodelet})
    for (const RowInfo& row : *rows) {
      demand(!row.sentence.empty(), row.name + " has no description");
      demand(isAllowed(row, row.standard), row.name + " has a default that is not allowed");
    }
  return faults;
}

}  // namespace urban_nav_core::testing
