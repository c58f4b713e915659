// SPDX-License-Identifier: BSD-3-Clause
// Accuracy on the real sequences with the shipped defaults, now and settled, beside other systems on the same frames;
// and how consistent the covariance is there (NEES, mean over the frames: 6 is right).
//   swf_vo-bench-accuracy [FOLDER...] [--peer NAME=SEQUENCE=FILE]... [--set swf_vo.NAME=VALUE]...
//     [-o results/accuracy.json]
// FOLDER: a sequence in KITTI's layout with poses.txt, such as render_sequence writes; default: the two real ones.
// FILE: what another system made of the folder named SEQUENCE, poses of the left camera in KITTI's or (.tum) the TUM
// format, one a frame.
#include <algorithm>
#include <filesystem>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_core/trajectory/nees.hpp"
#include "urban_nav_core/types/error.hpp"

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

std::string positionError(const std::vector<Pose>& truth, const std::vector<Pose>& estimate) {
  const double rmse = absoluteError(truth, estimate, urban_nav_core::TrajectoryAlignment::First).rmse;
  return rmse < 0.1 ? cell(1000.0 * rmse, 1) + " mm" : cell(rmse, 3) + " m";
}

std::string meanNees(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                     const std::vector<urban_nav_core::Matrix6d>& covariances) {
  const urban_nav_core::NeesSummary summary = neesOfTrajectory(truth, estimate, covariances);
  return summary.count > 0 ? cell(summary.mean, summary.mean < 100.0 ? 1 : 0) : "-";
}

void add(BenchTable& table, const Sequence& sequence, const std::string& system, const std::vector<Pose>& estimate,
         const std::string& nees, const std::string& ms) {
  if (estimate.size() != sequence.truth.size())
    throw urban_nav_core::UserError(system + " on " + sequence.name, std::to_string(estimate.size()) + " poses",
                                    std::to_string(sequence.truth.size()) + ", as many as the truth");
  const auto spans = [&](std::size_t frames) {
    const SpanErrors e = spanErrors(sequence.truth, estimate, frames);
    return e.percent > 0.0 ? cell(e.percent, 3) + " %, " + cell(e.deg_per_m, 4) + " deg/m" : std::string("-");
  };
  const double ratio = stepRatio(sequence.truth, estimate);
  table.add({sequence.name, system, spans(10), spans(50), spans(100), ratio > 0.0 ? cell(ratio, 4) : "-",
             positionError(sequence.truth, estimate), nees, ms});
}

std::vector<Pose> readPeer(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".tum") {
    std::vector<Pose> poses;
    for (const auto& stamped : urban_nav_core::readTum(path)) poses.push_back(stamped.pose);
    return poses;
  }
  return urban_nav_core::readKitti(path);
}

void addPeers(BenchTable& table, const Sequence& sequence, const std::vector<std::string>& peers) {
  for (const std::string& peer : peers) {
    const auto first = peer.find('='), second = peer.find('=', first + 1);
    if (second == std::string::npos || peer.substr(first + 1, second - first - 1) != sequence.name) continue;
    add(table, sequence, peer.substr(0, first), readPeer(peer.substr(second + 1)), "", "");
  }
}

}  // namespace

int main(int argc, char** argv) try {
  Options options = parse(argc, argv);
  const swf_vo::Parameters parameters = parametersFrom(options.sets);
  options.folders = orRealSequences(options.folders);

  BenchTable table({"sequence", "system", "10 frames", "50 frames", "100 frames", "step ratio", "position, rms", "NEES",
                    "ms a frame"},
                   argc, argv);
  for (const std::string& folder : options.folders) {
    const Sequence sequence = kittiFolder(folder);
    const Run result = run(sequence, parameters);
    const std::string ms = cell(quantile(result.ms, 0.5), 1) + " (99 %: " + cell(quantile(result.ms, 0.99), 1) + ")";
    add(table, sequence, "swf_vo, now", result.now, meanNees(sequence.truth, result.now, result.now_covariance), ms);
    add(table, sequence, "swf_vo, settled", result.settled,
        meanNees(sequence.truth, result.settled, result.settled_covariance), ms);
    addPeers(table, sequence, options.peers);
  }
  return show(table, options.output);
} catch (const std::exception& error) {
  return complain(error);
}
