// SPDX-License-Identifier: BSD-3-Clause
#include "program.hpp"

#include <algorithm>
#include <iostream>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph::bench {

using urban_nav_core::UserError;
using urban_nav_core::testing::processMs;

std::string Arguments::text(const std::string& option, const std::string& otherwise) const {
  const auto found = options.find(option);
  return found == options.end() ? otherwise : found->second;
}

int Arguments::number(const std::string& option, int otherwise) const {
  const auto found = options.find(option);
  if (found == options.end()) return otherwise;
  const auto value = urban_nav_core::parseInteger(found->second);
  if (!value || *value < 1 || *value > 1000000000) throw UserError(option, found->second, "a whole number above zero");
  return static_cast<int>(*value);
}

Arguments parseArguments(int argc, char** argv, const std::vector<std::string>& options) {
  Arguments asked;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind('-', 0) != 0) {
      asked.names.push_back(word);
      continue;
    }
    const bool known = word == "-o" || std::find(options.begin(), options.end(), word) != options.end();
    if (!known || i + 1 == argc) {
      std::string allowed = "-o FILE";
      for (const std::string& option : options) allowed += ", " + option + " VALUE";
      throw UserError("", word, allowed);
    }
    (word == "-o" ? asked.output : asked.options[word]) = argv[++i];
  }
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

double measureSeconds(int runs, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    const double begin = processMs();
    work();
    seconds.push_back(1e-3 * (processMs() - begin));
  }
  std::nth_element(seconds.begin(), seconds.begin() + runs / 2, seconds.end());
  return seconds[static_cast<std::size_t>(runs / 2)];
}

}  // namespace pose_graph::bench
