// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "urban_nav_core/testing/bench_table.hpp"

namespace pose_graph::bench {

/// The command line `[NAME...] [--OPTION VALUE]... [-o FILE]`; a value where none is due ends the program with
/// UserError, which names the options allowed.
struct Arguments {
  std::vector<std::string> names;
  std::map<std::string, std::string> options;
  std::string output;

  std::string text(const std::string& option, const std::string& otherwise) const;
  /// A whole number above zero.
  int number(const std::string& option, int otherwise) const;
};
Arguments parseArguments(int argc, char** argv, const std::vector<std::string>& options);

/// What main returns: prints the table, and writes it unless `output` is empty.
int show(const urban_nav_core::testing::BenchTable& table, const std::string& output);
/// What main returns where it was stopped: says why on stderr.
int complain(const std::exception& error);

/// Time of the processor (s) that `work` takes, all its threads together, so that what else runs does not count: the
/// median of `runs`.
double measureSeconds(int runs, const std::function<void()>& work);

}  // namespace pose_graph::bench
