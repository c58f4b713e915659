// SPDX-License-Identifier: BSD-3-Clause
// Real odometry and real closures by visual words, many of them false, with ground truth: KITTI sequences with closures
// at 21 thresholds each (Latif, Cadena, Neira, Robust loop closing over time for pose graph SLAM, IJRR 2013). One row
// per sequence: errors of odometry, least squares and relax with default options, and whether a warning was given if
// relax is worse than odometry. Each graph is named on stderr.
//   pose_graph-bench-real_graphs FOLDER... [--every N] [--peers PEERS.csv] [-o results/real_graphs.json]
// FOLDER: one of https://github.com/ylatif/dataset-RobustSLAM, with NAME_GT.g2o, NAME_odom.g2o and NAME_alpha_*.g2o.
// PEERS: `graph,peer,error_m` (the name of the graph without its ending).
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr double kWorse = 1.1;      // times odometry
constexpr double kWorsePeer = 1.5;  // times the best of the peers and of least squares

FileProblem<2> readGraph(const std::string& path) {
  return pose_graph::makeProblem<2>(urban_nav_core::readG2o(path), path);
}

std::vector<Rigid<2>> relaxPlainly(const std::string& path) { return solve(readGraph(path).problem, {}).poses; }

using PeerErrors = std::map<std::string, double>;  // best of each graph, m

PeerErrors readPeers(const std::string& path) {
  PeerErrors best;
  if (path.empty()) return best;
  const auto table = urban_nav_core::CsvTable::read(path);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double error = table.number(row, table.column("error_m"));
    const auto [at, is_new] = best.emplace(table.text(row, table.column("graph")), error);
    if (!is_new) at->second = std::min(at->second, error);
  }
  return best;
}

struct Sequence {
  std::string name, truth, odometry;
  std::vector<std::string> graphs;
};

Sequence findSequence(const std::string& folder) {
  Sequence made;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string(), path = entry.path().string();
    if (entry.path().extension() != ".g2o") continue;
    if (stem.find("_alpha_") != std::string::npos) made.graphs.push_back(path);
    else if (stem.size() > 3 && stem.compare(stem.size() - 3, 3, "_GT") == 0) made.truth = path;
    else if (stem.size() > 5 && stem.compare(stem.size() - 5, 5, "_odom") == 0) made.odometry = path;
  }
  if (made.truth.empty() || made.odometry.empty())
    throw urban_nav_core::UserError(folder, "NAME_GT.g2o or NAME_odom.g2o missing", "a folder of dataset-RobustSLAM");
  made.name = std::filesystem::path(made.truth).stem().string();
  made.name.resize(made.name.size() - 3);
  std::sort(made.graphs.begin(), made.graphs.end());
  return made;
}

void addSequence(const Sequence& sequence, int every, const PeerErrors& peers, BenchTable& table) {
  const std::vector<Rigid<2>> truth = relaxPlainly(sequence.truth);
  const double odometry = apart<2>(relaxPlainly(sequence.odometry), truth);
  std::vector<double> errors, least_squares;
  std::size_t worse = 0, silent = 0, worse_than_peers = 0, silent_peers = 0, warned = 0;
  for (std::size_t i = 0; i < sequence.graphs.size(); i += static_cast<std::size_t>(every)) {
    const FileProblem<2> file = readGraph(sequence.graphs[i]);
    const std::string stem = std::filesystem::path(sequence.graphs[i]).stem().string();
    const double plain = apart<2>(solve(file.problem, {}).poses, truth);
    RobustSolution<2> robust;
    const double seconds = measureSeconds(1, [&] { robust = relaxSelected(file.problem, file.roles, {}); });
    const double error = apart<2>(robust.solution.poses, truth);
    const auto warnings = selectionWarnings(
        file, robust, estimateScales(file.problem, file.roles, robust.edges, robust.solution.poses, robust.selection));
    const auto peer = peers.find(stem);
    const double best = std::min(plain, peer == peers.end() ? plain : peer->second);
    std::fprintf(
        stderr,
        "%s: odometry %.2f m, least squares %.2f, best of the peers %.2f, relax %.2f, %.2f s, %zu warnings%s%s\n",
        stem.c_str(), odometry, plain, best, error, seconds, warnings.size(), warnings.empty() ? "" : ": ",
        warnings.empty() ? "" : warnings.front().c_str());
    errors.push_back(error);
    least_squares.push_back(plain);
    warned += !warnings.empty();
    worse += error > kWorse * odometry;
    silent += error > kWorse * odometry && warnings.empty();
    worse_than_peers += error > kWorsePeer * best;
    silent_peers += error > kWorsePeer * best && warnings.empty();
  }
  std::sort(errors.begin(), errors.end());
  std::sort(least_squares.begin(), least_squares.end());
  table.add({sequence.name, std::to_string(errors.size()), cell(odometry, 2), cell(least_squares[errors.size() / 2], 2),
             cell(errors[errors.size() / 2], 2), cell(errors.back(), 2), std::to_string(worse), std::to_string(silent),
             std::to_string(worse_than_peers), std::to_string(silent_peers), std::to_string(warned)});
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--every", "--peers"});
  const PeerErrors peers = readPeers(asked.text("--peers", ""));
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"sequence", "graphs", "odometry, m", "least squares, m, median", "relax, m, median", "worst",
                    "worse than odometry by 10 %", "of these without a warning", "worse than the best other by half",
                    "of these without a warning", "warned"},
                   argc, argv);
  for (const std::string& folder : asked.names)
    addSequence(findSequence(folder), asked.number("--every", 1), peers, table);
  table.note(
      "Root mean square of positions after the best rigid motion in the plane. The best other: of least squares" +
      std::string(peers.empty() ? "." : " and of g2o with Cauchy's kernel and with DCS on all edges."));
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
