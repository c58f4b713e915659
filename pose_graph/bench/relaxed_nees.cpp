// SPDX-License-Identifier: BSD-3-Clause
// Consistency (NEES) of covariances between poses of relaxed sessions, near and far, with and without the constants of
// the rig, from stores of `urban_nav map --store` of simulated sessions with ground truth.
//   pose_graph-bench-relaxed_nees [-o FILE.json] STORE TRUTH.tum [STORE TRUTH.tum]...
// First from odometry only, then with the closures and planes in the store.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/marginals.hpp"
#include "pose_graph/stored_graph.hpp"
#include "support/program.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/trajectory/nees.hpp"
#include "urban_nav_store/store.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::testing::cell;

constexpr std::array<double, 3> kLags = {1.0, 10.0, 100.0};  // m driven
constexpr std::size_t kEvery = 5;                            // poses between the first poses of pairs
constexpr double kReturnM = 2.0, kReturnDriven = 60.0;       // m: revisits of the first pose
constexpr StampNs kTruthGap = 200'000'000;

/// Sums over pairs of poses.
struct Score {
  double nees = 0.0, translation = 0.0, rotation = 0.0;
  std::size_t inside = 0, pairs = 0;

  void add(const Pose& truth, const PoseWithCovariance& estimate) {
    const auto whole = urban_nav_core::nees(truth, estimate), t = urban_nav_core::neesTranslation(truth, estimate),
               r = urban_nav_core::neesRotation(truth, estimate);
    if (!whole || !t || !r) return;
    ++pairs;
    nees += *whole;
    translation += *t;
    rotation += *r;
    inside += *t < urban_nav_core::chiSquareQuantile(0.9, 3.0) ? 1 : 0;
  }
  std::vector<std::string> cells() const {
    const double each = pairs == 0 ? std::nan("") : 1.0 / static_cast<double>(pairs);
    return {cell(each * nees, 2), cell(each * translation, 2), cell(each * rotation, 2),
            cell(100.0 * each * static_cast<double>(inside), 0)};
  }
};

/// Indices of the first and the last pose of pairs; the last group contains revisits of the first pose.
using Pairs = std::array<std::vector<std::pair<std::size_t, std::size_t>>, kLags.size() + 2>;

Pairs findPairs(const std::vector<Pose>& truth) {
  std::vector<double> driven(truth.size(), 0.0);
  for (std::size_t i = 1; i < truth.size(); ++i) driven[i] = driven[i - 1] + distanceBetween(truth[i - 1], truth[i]);
  Pairs pairs;
  for (std::size_t l = 0; l < kLags.size(); ++l)
    for (std::size_t a = 0, b = 0; a < truth.size(); a += kEvery) {
      while (b < truth.size() && driven[b] - driven[a] < kLags[l]) ++b;
      if (b < truth.size()) pairs[l].emplace_back(a, b);
    }
  for (std::size_t b = kEvery; b < truth.size(); b += kEvery) {
    pairs[kLags.size()].emplace_back(0, b);
    if (driven[b] > kReturnDriven && distanceBetween(truth[0], truth[b]) < kReturnM)
      pairs[kLags.size() + 1].emplace_back(0, b);
  }
  return pairs;
}

using Scores = std::array<std::array<Score, 2>, std::tuple_size_v<Pairs>>;  // without and with constants

void score(const PoseGraph& graph, const std::vector<Pose>& truth, Scores& scores) {
  const Track& track = graph.tracks().front();
  std::vector<Rigid<3>> poses;
  for (const Pose& pose : track.map) poses.push_back(toRigid<3>(pose));
  const Pairs pairs = findPairs(truth);
  for (const bool constants : {false, true}) {
    const Marginals<3> marginals(graph.problem(), poses, graph.weights(),
                                 constants ? graph.commonErrors() : std::vector<CommonError<3>>());
    for (std::size_t group = 0; group < pairs.size(); ++group)
      for (const auto& [a, b] : pairs[group]) {
        PoseWithCovariance estimate;
        estimate.pose = track.map[a].inverse() * track.map[b];
        estimate.covariance = marginals.between(static_cast<int>(a), static_cast<int>(b)).covariance +
                              relativeNoise(estimate.pose, graph.ownNoise({track.session, track.stamps[a]}),
                                            graph.ownNoise({track.session, track.stamps[b]}));
        scores[group][constants ? 1 : 0].add(truth[a].inverse() * truth[b], estimate);
      }
  }
}

void add(const std::string& path, const std::string& truth_path, Scores& before, Scores& after) {
  urban_nav_store::Store store(path, urban_nav_store::Access::Read);
  const StoredGraph stored = readGraph(store);
  const StoredGraph::Chain& chain = stored.chains.front();
  const SessionId& id = chain.session.id;
  PoseGraph graph{Parameters()};
  for (const urban_nav_core::RelativePose& step : chain.steps) graph.addOdometry(id, step);
  const urban_nav_core::Trajectory true_path = urban_nav_core::readTum(truth_path);
  std::vector<Pose> truth;
  for (const StampNs stamp : graph.tracks().front().stamps) {
    const auto pose = true_path.at(stamp, kTruthGap);
    if (!pose) throw std::runtime_error(truth_path + " does not reach " + urban_nav_core::printStamp(stamp) + " s");
    truth.push_back(*pose);
  }
  score(graph, truth, before);
  for (const Closure& closure : stored.closures)
    if (closure.a.session == id && closure.b.session == id) graph.addClosure(closure);
  graph.putForces(id, chain.forces);
  graph.relax();
  score(graph, truth, after);
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {});
  if (asked.names.empty() || asked.names.size() % 2 != 0) throw std::runtime_error("STORE TRUTH.tum, in pairs");
  Scores before, after;
  for (std::size_t i = 0; i < asked.names.size(); i += 2) add(asked.names[i], asked.names[i + 1], before, after);
  urban_nav_core::testing::BenchTable table(
      {"poses", "pairs", "constants of the rig", "NEES", "translation", "rotation", "positions inside 90 %"}, argc,
      argv);
  const std::array<const char*, std::tuple_size_v<Pairs>> kGroups = {"1 m apart", "10 m apart", "100 m apart",
                                                                     "from the first", "back at the first"};
  for (const bool relaxed : {false, true})
    for (std::size_t group = 0; group < kGroups.size(); ++group)
      for (std::size_t constants = 0; constants < 2; ++constants) {
        const Score& of = (relaxed ? after : before)[group][constants];
        if (of.pairs == 0) continue;
        std::vector<std::string> row = {std::string(kGroups[group]) + (relaxed ? ", relaxed" : ", odometry"),
                                        std::to_string(of.pairs), constants == 1 ? "with" : "without"};
        for (std::string& each : of.cells()) row.push_back(std::move(each));
        table.add(row);
      }
  table.note(
      "Expected: NEES 6, of translation and rotation 3 each, 90 % inside. Pairs overlap, so a session has few "
      "independent errors.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
