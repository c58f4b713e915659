// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "urban_nav_core/testing/bench_table.hpp"

namespace pose_graph::bench {

/// The command line `[NAME...] [--OPTION VALUE]... [-o FILE]`. parseArguments() throws UserError, with the allowed
/// options, for an unknown option or a missing value.
struct Arguments {
  std::vector<std::string> names;
  std::map<std::string, std::string> options;
  std::string output;

  std::string text(const std::string& option, const std::string& otherwise) const;
  /// Returns a positive integer.
  int number(const std::string& option, int otherwise) const;
};
Arguments parseArguments(int argc, char** argv, const std::vector<std::string>& options);

/// Prints the table, and writes it unless `output` is empty. Returns main's exit status.
int show(const urban_nav_core::testing::BenchTable& table, const std::string& output);
/// Prints an error on stderr. Returns main's exit status.
int complain(const std::exception& error);

/// Returns the processor time (s) of `work`, summed over its threads and independent of other processes: the median of
/// `runs`.
double measureSeconds(int runs, const std::function<void()>& work);

}  // namespace pose_graph::bench
