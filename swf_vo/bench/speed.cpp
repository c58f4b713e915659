// SPDX-License-Identifier: BSD-3-Clause
// Time of a frame on one core over rendered images: the defaults, other windows, and what less work costs in accuracy. Absolute times
// depend on the machine and its load; the ratios between the rows of one run do not.
//   swf_vo-bench-speed [--frames N] [-o results/speed.json]
#include <iostream>
#include <string>

#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

struct Variant {
  const char* name;
  std::vector<std::string> sets;
};

double meanFeatures(const Run& run) {
  double sum = 0.0;
  for (const auto& statistics : run.statistics) sum += statistics.features;
  return sum / static_cast<double>(run.statistics.size());
}

}  // namespace

int main(int argc, char** argv) try {
  std::size_t frames = 400;
  std::string output;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string(argv[i]) == "--frames") frames = static_cast<std::size_t>(std::stoi(argv[++i]));
    else if (std::string(argv[i]) == "-o") output = argv[++i];
  }
  RenderedOptions room;
  room.motion = "loop";
  room.frames = frames;
  RenderedOptions street;
  street.scene = "street";
  street.motion = "straight";
  street.rate = 10.0;
  street.frames = std::min<std::size_t>(frames, 200);
  street.camera = {718.9, 718.9, 607.2, 185.2, 1241, 376, 0.537, 0.5};

  const std::vector<Variant> variants = {{"defaults (window 10)", {}},
                                         {"window 1", {"swf_vo.window=1"}},
                                         {"window 25", {"swf_vo.window=25"}},
                                         {"one iteration", {"swf_vo.iterations=1"}},
                                         {"prior dropped (forget: delete)", {"swf_vo.forget=delete"}}};
  BenchTable table({"images", "variant", "ms a frame, median", "99 %", "frames/s", "features", "10-frame spans"}, argc, argv);
  for (const RenderedOptions& options : {room, street}) {
    const Sequence drawn = rendered(options);
    // Drawn once: every variant sees the same pixels.
    std::vector<cv::Mat> left(drawn.stamps.size()), right(drawn.stamps.size());
    for (std::size_t i = 0; i < drawn.stamps.size(); ++i) drawn.read(i, left[i], right[i]);
    Sequence sequence = drawn;
    sequence.read = [&](std::size_t i, cv::Mat& l, cv::Mat& r) { l = left[i], r = right[i]; };
    for (const Variant& variant : variants) {
      const Run result = run(sequence, parametersFrom(variant.sets));
      const std::vector<double> steady(result.ms.begin() + std::min<std::ptrdiff_t>(50, static_cast<std::ptrdiff_t>(result.ms.size()) / 2), result.ms.end());
      const SpanErrors error = spanErrors(sequence.truth, result.settled, 10);
      table.add({std::to_string(options.camera.width) + "x" + std::to_string(options.camera.height) + ", " + options.scene, variant.name,
                 cell(quantile(steady, 0.5), 2), cell(quantile(steady, 0.99), 2), cell(1000.0 / quantile(steady, 0.5), 0),
                 cell(meanFeatures(result), 0), cell(error.percent, 3) + " %, " + cell(error.deg_per_m, 4) + " deg/m"});
    }
  }
  std::cout << table.text();
  if (!output.empty()) table.write(output);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
