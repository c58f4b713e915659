// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "urban_nav_core/testing/bench_table.hpp"

namespace swf_vo::bench {

/// Folders in KITTI's layout as they were named; where none was, those of the real sequences that are there.
std::vector<std::string> orRealSequences(std::vector<std::string> folders);

/// Name under which sequences that differ in up to three last digits are counted together.
std::string poolName(const std::string& sequence);

/// The command line `[FOLDER...] [-o FILE]`, with orRealSequences.
struct FoldersAndOutput {
  std::vector<std::string> folders;
  std::string output;
};
FoldersAndOutput foldersAndOutput(int argc, char** argv);

/// What main returns: prints the table, and writes it unless `output` is empty.
int show(const urban_nav_core::testing::BenchTable& table, const std::string& output);
/// What main returns where it was stopped: says why on stderr.
int complain(const std::exception& error);

}  // namespace swf_vo::bench
