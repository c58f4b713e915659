// SPDX-License-Identifier: BSD-3-Clause
#include "support/public_graphs.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "urban_nav_core/io/csv.hpp"

namespace pose_graph::test {

namespace {

std::string folder() {
  const char* data = std::getenv("URBAN_NAV_DATA");
  return data == nullptr ? "" : std::string(data) + "/graphs";
}

}  // namespace

std::vector<PublicGraph> publicGraphs() {
  std::vector<PublicGraph> made;
  const std::string path = folder() + "/optima.csv";
  if (!std::filesystem::exists(path)) return made;
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::read(path);
  for (std::size_t row = 0; row < table.rows(); ++row)
    made.push_back({table.text(row, table.column("name")), static_cast<int>(table.integer(row, table.column("dim"))),
                    table.number(row, table.column("F_certified")),
                    table.number(row, table.column("chi2_g2o_optimum"))});
  return made;
}

std::optional<urban_nav_core::G2oGraph> readPublic(const std::string& name) {
  const std::string command = "xz -dc '" + folder() + "/" + name + ".g2o.xz'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) return std::nullopt;
  std::string text;
  char piece[65536];
  for (std::size_t read = 0; (read = std::fread(piece, 1, sizeof piece, pipe.get())) > 0;) text.append(piece, read);
  if (text.empty()) return std::nullopt;
  return urban_nav_core::parseG2o(text, name);
}

}  // namespace pose_graph::test
