// SPDX-License-Identifier: BSD-3-Clause
// Accuracy on the real sequences with the default parameters, filtered and smoothed, compared with other systems on the
// same frames; consistency of the covariance (NEES, mean over the frames; expected 6).
//   swf_vo-bench-accuracy [FOLDER...] [--peer NAME=SEQUENCE=FILE]... [--set swf_vo.NAME=VALUE]...
//     [-o results/accuracy.json]
// FOLDER: a sequence in KITTI's layout with poses.txt, such as render_sequence writes; default: the two real ones.
// FILE: result of another system for the folder named SEQUENCE, poses of the left camera in KITTI's or (.tum) the TUM
// format, one per frame.
#include <algorithm>
#include <string>

#include "support/peer.hpp"
#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"
#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::Pose;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;

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
  const auto spans = [&](std::size_t frames) {
    const SpanErrors e = spanErrors(sequence.truth, estimate, frames);
    return e.percent > 0.0 ? cell(e.percent, 3) + " %, " + cell(e.deg_per_m, 4) + " deg/m" : std::string("-");
  };
  const double ratio = stepRatio(sequence.truth, estimate);
  table.add({sequence.name, system, spans(50), spans(100), ratio > 0.0 ? cell(ratio, 4) : "-",
             positionError(sequence.truth, estimate), nees, ms});
}

}  // namespace

int main(int argc, char** argv) try {
  Options options = parse(argc, argv);
  const swf_vo::Parameters parameters = parametersFrom(options.sets);
  options.folders = orRealSequences(options.folders);

  BenchTable table(
      {"sequence", "system", "50 frames", "100 frames", "step ratio", "position, rms", "NEES", "ms a frame"}, argc,
      argv);
  for (const std::string& folder : options.folders) {
    const Sequence sequence = kittiFolder(folder);
    const Run result = run(sequence, parameters);
    const std::string ms = cell(quantile(result.ms, 0.5), 1);
    add(table, sequence, "swf_vo, now", result.now, meanNees(sequence.truth, result.now, result.now_covariance), ms);
    add(table, sequence, "swf_vo, settled", result.settled,
        meanNees(sequence.truth, result.settled, result.settled_covariance), ms);
    for (const Peer& peer : readPeers(sequence, options.peers)) add(table, sequence, peer.name, peer.poses, "", "");
  }
  return show(table, options.output);
} catch (const std::exception& error) {
  return complain(error);
}
