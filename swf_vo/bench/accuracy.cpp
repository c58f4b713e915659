// SPDX-License-Identifier: BSD-3-Clause
// Accuracy on the real sequences with the shipped defaults, now and settled, beside other systems on the same frames.
//   swf_vo-bench-accuracy [--peer NAME=SEQUENCE=TRAJECTORY.kitti]... [--set swf_vo.NAME=VALUE]... [-o results/accuracy.json]
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>

#include "support/run.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::Pose;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

struct Options {
  std::vector<std::string> peers, sets, folders;
  std::string output;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--peer" && i + 1 < argc) options.peers.push_back(argv[++i]);
    else if (word == "--set" && i + 1 < argc) options.sets.push_back(argv[++i]);
    else if (word == "-o" && i + 1 < argc) options.output = argv[++i];
    else options.folders.push_back(word);
  }
  return options;
}

void add(BenchTable& table, const std::string& sequence, const std::string& system, const std::vector<Pose>& truth,
         const std::vector<Pose>& estimate, const std::string& ms) {
  const SpanErrors ten = spanErrors(truth, estimate, 10), fifty = spanErrors(truth, estimate, 50),
                   hundred = spanErrors(truth, estimate, 100);
  const auto pair = [](const SpanErrors& e) {
    return e.percent > 0.0 ? cell(e.percent, 3) + " %, " + cell(e.deg_per_m, 4) + " deg/m" : std::string("-");
  };
  table.add({sequence, system, pair(ten), pair(fifty), pair(hundred), cell(stepRatio(truth, estimate), 4), ms});
}

void addPeers(BenchTable& table, const Sequence& sequence, const std::vector<std::string>& peers) {
  for (const std::string& peer : peers) {
    const auto first = peer.find('='), second = peer.find('=', first + 1);
    if (second == std::string::npos || peer.substr(first + 1, second - first - 1) != sequence.name) continue;
    add(table, sequence.name, peer.substr(0, first), sequence.truth, urban_nav_core::readKitti(peer.substr(second + 1)),
        "");
  }
}

}  // namespace

int main(int argc, char** argv) try {
  Options options = parse(argc, argv);
  const swf_vo::Parameters parameters = parametersFrom(options.sets);
  if (options.folders.empty())
    for (const char* name : {"kitti06_000_050", "kitti_raw_0926_0005"})
      if (const std::string folder = dataFolder(name); !folder.empty()) options.folders.push_back(folder);

  BenchTable table({"sequence", "system", "10 frames", "50 frames", "100 frames", "step ratio", "ms a frame"}, argc,
                   argv);
  for (const std::string& folder : options.folders) {
    const Sequence sequence = kittiFolder(folder);
    const Run result = run(sequence, parameters);
    const std::string ms = cell(quantile(result.ms, 0.5), 1) + " (99 %: " + cell(quantile(result.ms, 0.99), 1) + ")";
    add(table, sequence.name, "swf_vo, now", sequence.truth, result.now, ms);
    add(table, sequence.name, "swf_vo, settled", sequence.truth, result.settled, ms);
    addPeers(table, sequence, options.peers);
  }
  std::cout << table.text();
  if (!options.output.empty()) table.write(options.output);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
