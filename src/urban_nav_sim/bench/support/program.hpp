// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

#include "urban_nav_core/testing/bench_table.hpp"
#include "world/world.hpp"

namespace urban_nav_sim::bench {

/// Options with a value, `--duration 20`.
class Options {
 public:
  Options(int argc, char** argv) : argc_(argc), argv_(argv) {}
  std::string text(const std::string& name, const std::string& otherwise) const;
  double number(const std::string& name, double otherwise) const;

 private:
  int argc_;
  char** argv_;
};

/// Returns the route of that name. Throws std::invalid_argument for an unknown name.
Route makeRoute(const std::string& world, std::uint32_t seed, const std::string& name);

/// Returns a folder below URBAN_NAV_DATA; empty if missing, with a message on stderr.
std::string realData(const std::string& folder);

/// Prints the table and writes it to the file of `-o FILE`. Returns the exit status of main().
int show(const urban_nav_core::testing::BenchTable& table, const Options& options);
int complain(const std::exception& error);

}  // namespace urban_nav_sim::bench
