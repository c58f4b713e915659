// SPDX-License-Identifier: BSD-3-Clause
// Time per frame on one core over rendered images: default parameters, other windows, and the loss of accuracy with
// less work. Processor time, independent of other processes; ratios between rows of one run depend least on the
// machine.
//   swf_vo-bench-speed [FOLDER...] [--frames N] [--peer NAME=SEQUENCE=MS]... [-o results/speed.json]
// FOLDER: a sequence in KITTI's layout instead of the rendered ones, for the comparison with a peer on the same images.
#include <memory>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;

struct Variant {
  const char* name;
  std::vector<std::string> sets;
  swf_vo::Ablation ablation = {};
};

struct Options {
  std::size_t frames = 400;
  std::vector<std::string> folders, peers;
  std::string output;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--frames" && i + 1 < argc) options.frames = static_cast<std::size_t>(std::stoi(argv[++i]));
    else if (word == "--peer" && i + 1 < argc) options.peers.push_back(argv[++i]);
    else if (word == "-o" && i + 1 < argc) options.output = argv[++i];
    else options.folders.push_back(word);
  }
  return options;
}

std::vector<Sequence> sequences(const Options& options) {
  std::vector<Sequence> made;
  for (const std::string& folder : options.folders) made.push_back(kittiFolder(folder, options.frames));
  if (!made.empty()) return made;
  RenderedOptions room;
  room.motion = "loop";
  room.frames = options.frames;
  made.push_back(rendered(room));
  made.back().name = "room";
  RenderedOptions street;
  street.scene = "street";
  street.motion = "straight";
  street.rate = 10.0;
  street.frames = std::min<std::size_t>(options.frames, 200);
  street.camera = {718.9, 718.9, 607.2, 185.2, 1241, 376, 0.537, 0.5};
  made.push_back(rendered(street));
  made.back().name = "street";
  return made;
}

/// Loads all images, so that every variant uses the same pixels.
Sequence inMemory(const Sequence& sequence) {
  const std::size_t count = sequence.stamps.size();
  const auto left = std::make_shared<std::vector<cv::Mat>>(count),
             right = std::make_shared<std::vector<cv::Mat>>(count);
  for (std::size_t i = 0; i < count; ++i) sequence.read(i, (*left)[i], (*right)[i]);
  Sequence made = sequence;
  made.read = [left, right](std::size_t i, cv::Mat& l, cv::Mat& r) { l = (*left)[i], r = (*right)[i]; };
  return made;
}

double meanFeatures(const Run& run) {
  double sum = 0.0;
  for (const auto& statistics : run.statistics) sum += statistics.features;
  return sum / static_cast<double>(run.statistics.size());
}

std::string title(const Sequence& sequence) {
  return std::to_string(sequence.camera.left.width) + "x" + std::to_string(sequence.camera.left.height) + ", " +
         sequence.name;
}

void addPeers(BenchTable& table, const Sequence& sequence, const std::vector<std::string>& peers) {
  for (const std::string& peer : peers) {
    const auto first = peer.find('='), second = peer.find('=', first + 1);
    if (second == std::string::npos || peer.substr(first + 1, second - first - 1) != sequence.name) continue;
    const double ms = std::stod(peer.substr(second + 1));
    table.add({title(sequence), peer.substr(0, first), cell(ms, 2), "", cell(1000.0 / ms, 0), "", ""});
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parse(argc, argv);
  swf_vo::Ablation prior_dropped;
  prior_dropped.delete_departed = true;
  const std::vector<Variant> variants = {{"defaults (window 10)", {}},
                                         {"window 1", {"swf_vo.window=1"}},
                                         {"window 25", {"swf_vo.window=25"}},
                                         {"one iteration", {"swf_vo.iterations=1"}},
                                         {"prior dropped", {}, prior_dropped}};
  BenchTable table({"images", "variant", "ms a frame, median", "99 %", "frames/s", "features", "10-frame spans"}, argc,
                   argv);
  for (const Sequence& drawn : sequences(options)) {
    const Sequence sequence = inMemory(drawn);
    for (const Variant& variant : variants) {
      const Run result = run(sequence, parametersFrom(variant.sets), variant.ablation);
      const std::ptrdiff_t settled = std::min<std::ptrdiff_t>(50, static_cast<std::ptrdiff_t>(result.ms.size()) / 2);
      const std::vector<double> steady(result.ms.begin() + settled, result.ms.end());
      const SpanErrors error = spanErrors(sequence.truth, result.settled, 10);
      table.add({title(sequence), variant.name, cell(quantile(steady, 0.5), 2), cell(quantile(steady, 0.99), 2),
                 cell(1000.0 / quantile(steady, 0.5), 0), cell(meanFeatures(result), 0),
                 cell(error.percent, 3) + " %, " + cell(error.deg_per_m, 4) + " deg/m"});
    }
    addPeers(table, sequence, options.peers);
  }
  return show(table, options.output);
} catch (const std::exception& error) {
  return complain(error);
}
