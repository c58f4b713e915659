// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <iostream>

#include "run.hpp"

namespace swf_vo::bench {

std::vector<std::string> orRealSequences(std::vector<std::string> folders) {
  if (!folders.empty()) return folders;
  for (const char* name : {"kitti06_000_050", "kitti_raw_0926_0005"})
    if (const std::string folder = dataFolder(name); !folder.empty()) folders.push_back(folder);
  return folders;
}

std::string poolName(const std::string& sequence) {
  const auto last = sequence.find_last_not_of("0123456789_");
  const std::string name = sequence.substr(0, last == std::string::npos ? 0 : last + 1);
  return name.size() + 3 < sequence.size() || name.empty() ? sequence : name;
}

FoldersAndOutput foldersAndOutput(int argc, char** argv) {
  FoldersAndOutput asked;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "-o" && i + 1 < argc) asked.output = argv[++i];
    else asked.folders.emplace_back(argv[i]);
  }
  asked.folders = orRealSequences(asked.folders);
  return asked;
}

int show(const urban_nav_core::testing::BenchTable& table, const std::string& output) {
  std::cout << table.text();
  if (!output.empty()) table.write(output);
  return 0;
}

int complain(const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}

}  // namespace swf_vo::bench
