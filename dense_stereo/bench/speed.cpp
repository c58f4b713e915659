// SPDX-License-Identifier: BSD-3-Clause
// Processor time of one pair of 512x384 px at 64 disparities on one core, with OpenCV's matchers in the same run.
//
//   dense_stereo-bench-speed [-o FILE.json]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "support/peers.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"

using urban_nav_core::testing::threadMs;

int main(int argc, char** argv) {
  constexpr int kRuns = 15;
  cv::setNumThreads(1);
  urban_nav_core::testing::BenchTable table({"method", "median, ms", "least, ms"}, argc, argv);
  const char* data = std::getenv("URBAN_NAV_DATA");
  const auto pairs = dense_stereo::bench::middleburyPairs(data == nullptr ? "" : data);
  if (pairs.empty()) {
    std::fputs("URBAN_NAV_DATA names no folder with Middlebury pairs\n", stderr);
    return 1;
  }
  cv::Mat left, right;
  cv::resize(pairs.front().left, left, {512, 384});
  cv::resize(pairs.front().right, right, {512, 384});
  for (const auto& peer : dense_stereo::bench::allPeers()) {
    std::vector<double> times;
    for (int i = 0; i <= kRuns; ++i) {
      const double begin = threadMs();
      peer->match(left, right, 64);
      if (i > 0) times.push_back(threadMs() - begin);
    }
    std::sort(times.begin(), times.end());
    table.add({peer->name(), urban_nav_core::testing::cell(times[times.size() / 2], 1),
               urban_nav_core::testing::cell(times.front(), 1)});
  }
  table.note(
      "teddy, resized to 512x384 px; 64 disparities; one core, processor time, all checks and variances included.");
  std::fputs(table.text().c_str(), stdout);
  if (argc == 3 && std::string(argv[1]) == "-o") table.write(argv[2]);
  return 0;
}
