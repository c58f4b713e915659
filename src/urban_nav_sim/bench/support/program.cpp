// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace urban_nav_sim::bench {

std::string Options::text(const std::string& name, const std::string& otherwise) const {
  for (int i = 1; i + 1 < argc_; ++i) {
    if (name == argv_[i]) return argv_[i + 1];
  }
  return otherwise;
}

double Options::number(const std::string& name, double otherwise) const {
  const std::string word = text(name, "");
  return word.empty() ? otherwise : std::stod(word);
}

Route makeRoute(const std::string& world, std::uint32_t seed, const std::string& name) {
  for (Route& route : worldRoutes(world, seed)) {
    if (route.name == name) return std::move(route);
  }
  throw std::invalid_argument("no route " + name + " in " + world);
}

std::string realData(const std::string& folder) {
  const char* root = std::getenv("URBAN_NAV_DATA");
  const std::filesystem::path path = std::filesystem::path(root != nullptr ? root : "") / folder;
  if (root != nullptr && std::filesystem::exists(path)) return path.string();
  std::cerr << "left out: " << folder << " (not below URBAN_NAV_DATA)\n";
  return "";
}

int show(const urban_nav_core::testing::BenchTable& table, const Options& options) {
  std::cout << table.text();
  const std::string output = options.text("-o", "");
  if (!output.empty()) table.write(output);
  return 0;
}

int complain(const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

}  // namespace urban_nav_sim::bench
