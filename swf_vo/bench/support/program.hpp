// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "urban_nav_core/testing/bench_table.hpp"

namespace swf_vo::bench {

/// Returns the given folders in KITTI's layout; if none is given, those of the real sequences that exist.
std::vector<std::string> orRealSequences(std::vector<std::string> folders);

/// Returns the name for pooling of sequences that differ in up to three last digits.
std::string poolName(const std::string& sequence);

/// The command line `[FOLDER...] [-o FILE]`, with orRealSequences.
struct FoldersAndOutput {
  std::vector<std::string> folders;
  std::string output;
};
FoldersAndOutput foldersAndOutput(int argc, char** argv);

/// Prints the table, and writes it unless `output` is empty. Returns the exit status.
int show(const urban_nav_core::testing::BenchTable& table, const std::string& output);
/// Prints an exception on stderr. Returns the exit status.
int complain(const std::exception& error);

}  // namespace swf_vo::bench
