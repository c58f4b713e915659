// SPDX-License-Identifier: BSD-3-Clause
#include "problems.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "pose_graph/graph_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph::bench {

using urban_nav_core::G2oGraph;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::UserError;
using urban_nav_core::testing::GraphEdge;
using urban_nav_core::testing::SimulatedGraph;

namespace {

/// Returns the rows and columns of the plane from an information of space.
template <int D>
TangentMatrix<D> ofDimension(const Matrix6d& information) {
  if constexpr (D == 3) {
    return information;
  } else {
    constexpr std::array<int, 3> kPlane = {0, 1, 5};
    Eigen::Matrix3d made;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        made(i, j) = information(kPlane[static_cast<std::size_t>(i)], kPlane[static_cast<std::size_t>(j)]);
    return made;
  }
}

template <int D>
AnyProblem fromSimulated(const SimulatedGraph& graph, const std::vector<Pose>& guess) {
  Problem<D> problem;
  problem.poses.reserve(guess.size());
  problem.edges.reserve(graph.edges.size());
  for (const Pose& pose : guess) problem.poses.push_back(toRigid<D>(pose));
  for (const GraphEdge& edge : graph.edges) {
    // Rotates the information from the frame of a, where the noise was drawn, to that of b.
    Matrix6d turn = Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = edge.T_a_b.R();
    problem.edges.push_back({static_cast<int>(edge.a), static_cast<int>(edge.b), toRigid<D>(edge.T_a_b),
                             ofDimension<D>(turn.transpose() * edge.information * turn)});
  }
  return problem;
}

std::string unpacked(const std::string& path) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(("xz -dc '" + path + "'").c_str(), "r"), pclose);
  std::string text;
  std::array<char, 65536> buffer{};
  while (pipe) {
    const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe.get());
    if (count == 0) break;
    text.append(buffer.data(), count);
  }
  if (text.empty()) throw UserError(path, "cannot be unpacked", "a graph packed by xz");
  return text;
}

}  // namespace

AnyProblem makeProblem(const SimulatedGraph& graph, const std::vector<Pose>& guess) {
  return graph.planar ? fromSimulated<2>(graph, guess) : fromSimulated<3>(graph, guess);
}

std::vector<PublicGraph> publicGraphs(const std::vector<std::string>& names) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  if (data == nullptr) throw UserError("URBAN_NAV_DATA", "is not set", "the folder that holds graphs/optima.csv");
  const std::string folder = std::string(data) + "/graphs/";
  const auto optima = urban_nav_core::CsvTable::read(folder + "optima.csv");
  std::vector<PublicGraph> graphs;
  for (std::size_t row = 0; row < optima.rows(); ++row) {
    const std::string name = optima.text(row, optima.column("name"));
    if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
    const G2oGraph file = urban_nav_core::parseG2o(unpacked(folder + name + ".g2o.xz"), name);
    const AnyProblem problem = file.dimension == 2 ? AnyProblem(pose_graph::makeProblem<2>(file, name).problem)
                                                   : AnyProblem(pose_graph::makeProblem<3>(file, name).problem);
    graphs.push_back({name, problem, optima.number(row, optima.column("F_certified")),
                      optima.number(row, optima.column("chi2_g2o_optimum"))});
  }
  if (graphs.empty() || graphs.size() < names.size())
    throw UserError("", "a graph that is not there", "names of optima.csv");
  return graphs;
}

}  // namespace pose_graph::bench
