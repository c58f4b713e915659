// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"

#include <algorithm>
#include <cstdlib>

namespace dense_stereo::bench {

BenchArguments readBenchArguments(int argc, char** argv, int default_step) {
  BenchArguments arguments{"", default_step, false, {argv + 1, argv + argc}};
  std::vector<std::string>& words = arguments.words;
  if (words.size() >= 2 && words[0] == "-o") {
    arguments.output = words[1];
    words.erase(words.begin(), words.begin() + 2);
  }
  if (!words.empty() && words[0] == "--own") {
    arguments.own = true;
    words.erase(words.begin());
  }
  if (words.size() >= 2 && words[0] == "--step") {
    arguments.step = std::max(std::atoi(words[1].c_str()), 1);
    words.erase(words.begin(), words.begin() + 2);
  }
  return arguments;
}

}  // namespace dense_stereo::bench
