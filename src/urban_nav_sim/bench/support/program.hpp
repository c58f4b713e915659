// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

#include "urban_nav_core/testing/bench_table.hpp"
#include "world/world.hpp"

namespace urban_nav_sim::bench {

/// Words that follow an option, `--duration 20`: all that these programs understand.
class Options {
 public:
  Options(int argc, char** argv) : argc_(argc), argv_(argv) {}
  std::string text(const std::string& name, const std::string& otherwise) const;
  double number(const std::string& name, double otherwise) const;

 private:
  int argc_;
  char** argv_;
};

/// The route of that name. Throws std::invalid_argument if there is none.
Route makeRoute(const std::string& world, std::uint32_t seed, const std::string& name);

/// A folder below URBAN_NAV_DATA; empty, with a word on stderr about what is left out, where it is not there.
std::string realData(const std::string& folder);

/// What main returns: prints the table, and writes it where `-o FILE` says.
int show(const urban_nav_core::testing::BenchTable& table, const Options& options);
int complain(const std::exception& error);

}  // namespace urban_nav_sim::bench
