// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace dense_stereo::bench {

/// Command line of a bench: [-o FILE.json] [--own] [--step N] WORD...
struct BenchArguments {
  std::string output;              ///< "" if none is given
  int step = 1;                    ///< interval of frames, at least 1
  bool own = false;                ///< only the package's methods, not its peers
  std::vector<std::string> words;  ///< remaining arguments
};

BenchArguments readBenchArguments(int argc, char** argv, int default_step);

}  // namespace dense_stereo::bench
