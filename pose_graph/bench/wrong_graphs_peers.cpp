// SPDX-License-Identifier: BSD-3-Clause
// The graphs of wrong_graphs relaxed by other programs: distance of each result from the right poses, with ours and
// least squares of all edges.
//   pose_graph-bench-wrong_graphs_peers [NAME...] [--seeds N] [--kind PART_OF_ITS_NAME] --keep FOLDER
// writes the graphs as GRAPH.KIND.SEED.g2o, with the vertices of the public graphs as initial guess.
//   pose_graph-bench-wrong_graphs_peers [NAME...] [--seeds N] [--kind PART_OF_ITS_NAME] --peers FILE [-o
//   results/wrong_graphs_peers.json]
// FILE: results of the programs, CSV of `peer,graph,relaxed,seconds`: name, name without .g2o, path, processor time. A
// peer without a row for a graph gave no result.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/robust.hpp"
#include "support/false_closures.hpp"
#include "support/program.hpp"
#include "support/wrong_graphs.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/g2o.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using urban_nav_core::CsvTable;
using urban_nav_core::G2oGraph;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Dice;

std::string fileName(const std::string& graph, const std::string& kind, int seed) {
  std::string name = graph + "." + kind + "." + std::to_string(seed);
  for (char& letter : name)
    if (letter == ' ' || letter == ',') letter = '_';
  return name;
}

template <int D>
void setValues(const Rigid<D>& T, std::array<double, 7>& values) {
  G2oGraph graph;
  graph.dimension = D;
  G2oGraph::Vertex vertex;
  graph.setPose(vertex, toPose(T));
  values = vertex.values;
}

/// Converts a graph to the file format; in space, information refers to the vector part of the quaternion, half the
/// rotation vector.
template <int D>
G2oGraph toG2o(const Problem<D>& problem) {
  G2oGraph graph;
  graph.dimension = D;
  for (std::size_t i = 0; i < problem.poses.size(); ++i) {
    graph.vertices.push_back({static_cast<G2oGraph::Id>(i), {}});
    setValues<D>(problem.poses[i], graph.vertices.back().values);
  }
  for (const Edge<D>& edge : problem.edges) {
    G2oGraph::Edge written;
    written.from = edge.from;
    written.to = edge.to;
    setValues<D>(edge.Z, written.values);
    Eigen::MatrixXd information = edge.information;
    if (D == 3) {
      information.rightCols(3) *= 2.0;
      information.bottomRows(3) *= 2.0;
    }
    urban_nav_core::setG2oInformation(written, information);
    graph.edges.push_back(written);
  }
  return graph;
}

/// Results of one program on the graphs of one kind.
struct Ended {
  int answers = 0;
  double worst = 0.0, seconds = 0.0;

  void add(double off, double time) {
    ++answers;
    worst = std::max(worst, off);
    seconds += time;
  }
  std::string text(int draws) const {
    if (answers == 0) return "";
    return cell(100.0 * worst, 2) + (answers < draws ? " (" + std::to_string(answers) + " answers)" : "");
  }
  std::string time() const { return answers == 0 ? "" : cell(seconds / answers, 2); }
};

class Answers {
 public:
  explicit Answers(const std::string& path) : table_(CsvTable::read(path)) {
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      const std::string peer = table_.text(row, table_.column("peer"));
      if (std::find(peers_.begin(), peers_.end(), peer) == peers_.end()) peers_.push_back(peer);
    }
  }
  const std::vector<std::string>& peers() const { return peers_; }

  template <int D>
  void add(const std::string& graph, const WrongGraph<D>& wrong, double extent,
           std::map<std::string, Ended>& ended) const {
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      if (table_.text(row, table_.column("graph")) != graph) continue;
      const std::string path = table_.text(row, table_.column("relaxed"));
      const G2oGraph file = urban_nav_core::readG2o(path);
      std::vector<Rigid<D>> poses(wrong.right.size());
      if (file.vertices.size() != poses.size())
        throw urban_nav_core::UserError(path, "vertices of another graph", "the vertices of the graph");
      for (const G2oGraph::Vertex& vertex : file.vertices)
        poses.at(static_cast<std::size_t>(vertex.id)) = toRigid<D>(file.pose(vertex));
      ended[table_.text(row, table_.column("peer"))].add(distanceFromRight(wrong, poses) / extent,
                                                         table_.number(row, table_.column("seconds")));
    }
  }

 private:
  CsvTable table_;
  std::vector<std::string> peers_;
};

struct Draws {
  int seeds = 3;
  std::string only;  ///< part of a kind's name
};

template <int D>
void keepGraphs(const std::string& name, const Problem<D>& clean, const Draws& draws, const std::string& folder) {
  const std::vector<Rigid<D>> optimum = solve(clean, {}).poses;
  for (const WrongKind<D>& kind : wrongKinds<D>(clean, optimum)) {
    if (kind.name.find(draws.only) == std::string::npos) continue;
    for (int seed = 1; seed <= (kind.is_drawn ? draws.seeds : 1); ++seed) {
      Dice dice(static_cast<std::uint64_t>(seed));
      urban_nav_core::writeG2o(folder + "/" + fileName(name, kind.name, seed) + ".g2o",
                               toG2o<D>(kind.draw(dice).problem));
    }
  }
}

template <int D>
void addKinds(const std::string& name, const Problem<D>& clean, const Draws& draws, const Answers& answers,
              BenchTable& table) {
  const std::vector<Rigid<D>> optimum = solve(clean, {}).poses;
  const double extent = longestSide<D>(optimum);
  for (const WrongKind<D>& kind : wrongKinds<D>(clean, optimum)) {
    if (kind.name.find(draws.only) == std::string::npos) continue;
    const int seeds = kind.is_drawn ? draws.seeds : 1;
    Ended ours, plain;
    std::map<std::string, Ended> peers;
    int warned = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      Dice dice(static_cast<std::uint64_t>(seed));
      const WrongGraph<D> wrong = kind.draw(dice);
      RobustSolution<D> robust;
      const double seconds =
          measureSeconds(1, [&] { robust = relaxSelected(wrong.problem, rolesByNumbers(wrong.problem), {}); });
      const double off = distanceFromRight(wrong, robust.solution.poses) / extent;
      ours.add(off, seconds);
      warned += countWarnings(wrong.problem, robust) > 0;
      Solution<D> squares;
      const double plain_seconds = measureSeconds(1, [&] { squares = solve(wrong.problem, {}); });
      plain.add(distanceFromRight(wrong, squares.poses) / extent, plain_seconds);
      answers.add(fileName(name, kind.name, seed), wrong, extent, peers);
    }
    std::vector<std::string> row{name,
                                 kind.name,
                                 std::to_string(seeds),
                                 ours.text(seeds),
                                 ours.time(),
                                 std::to_string(warned),
                                 plain.text(seeds)};
    for (const std::string& peer : answers.peers()) {
      row.push_back(peers[peer].text(seeds));
      row.push_back(peers[peer].time());
    }
    table.add(row);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--seeds", "--kind", "--keep", "--peers"});
  const Draws draws{asked.number("--seeds", 3), asked.text("--kind", "")};
  const urban_nav_core::ThreadLimit one(1);
  const auto graphs = publicGraphs(asked.names);
  if (const std::string folder = asked.text("--keep", ""); !folder.empty()) {
    for (const PublicGraph& graph : graphs)
      std::visit([&](const auto& problem) { keepGraphs(graph.name, problem, draws, folder); }, graph.problem);
    return 0;
  }
  const Answers answers(asked.text("--peers", "peers.csv"));
  std::vector<std::string> columns{
      "graph", "what is wrong", "draws", "from the right one, % of the extent, worst", "s", "warned", "all edges used"};
  for (const std::string& peer : answers.peers()) {
    columns.push_back(peer);
    columns.push_back("s");
  }
  BenchTable table(columns, argc, argv);
  for (const PublicGraph& graph : graphs)
    std::visit([&](const auto& problem) { addKinds(graph.name, problem, draws, answers, table); }, graph.problem);
  table.note(
      "Seeds from 1; the worst of the draws, % of the extent from the right poses; mean processor times on one "
      "core. All edges used: least squares by our plain solver.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return pose_graph::bench::complain(error);
}
