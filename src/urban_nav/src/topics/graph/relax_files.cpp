// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/relax_files.hpp"

#include <utility>

#include "pose_graph/marginals.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using pose_graph::EdgeAssessment;
using pose_graph::FileProblem;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::G2oGraph;

namespace {

constexpr double kFreeTranslation = 1e6, kFreeRotation = 10.0;  // m2, rad2, as in covarianceForDisplay()

std::string edgeLine(std::string from, std::string to, const EdgeAssessment& edge) {
  const bool rejected = edge.verdict == ClosureVerdict::Rejected;
  return urban_nav_core::printCsvRow({std::move(from), std::move(to), urban_nav_core::printNumber(edge.weight),
                                      toString(edge.verdict), rejected ? pose_graph::toString(edge.reason) : ""});
}

pose_graph::TangentMatrix<3> shown(const pose_graph::Marginal<3>& marginal) {
  return pose_graph::displayed(marginal, 1.0);
}
pose_graph::TangentMatrix<2> shown(const pose_graph::Marginal<2>& marginal) {
  if (marginal.knowledge == pose_graph::Knowledge::Full) return marginal.covariance;
  // Indices of x, y and yaw in the 3D tangent.
  constexpr int kInSpace[3] = {0, 1, 5};
  pose_graph::Marginal<3> space;
  space.knowledge = marginal.knowledge;
  space.information.setIdentity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      space.information(kInSpace[row], kInSpace[column]) = marginal.information(row, column);
  const urban_nav_core::Matrix6d all = pose_graph::displayed(space, 1.0);
  pose_graph::TangentMatrix<2> made;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) made(row, column) = all(kInSpace[row], kInSpace[column]);
  return made;
}

}  // namespace

template <int D>
std::string edgesCsv(const G2oGraph& graph, const FileProblem<D>& file,
                     const std::vector<EdgeAssessment>& assessments) {
  std::string text = "from,to,weight,verdict,reason\n";
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const std::string from = std::to_string(graph.edges[e].from), to = std::to_string(graph.edges[e].to);
    text += file.edges[e] < 0 ? from + "," + to + ",0,rejected,from a vertex to itself\n"
                              : edgeLine(from, to, assessments[static_cast<std::size_t>(file.edges[e])]);
  }
  for (std::size_t k = 0; k < graph.point_edges.size(); ++k)
    text += edgeLine(std::to_string(graph.point_edges[k].from), std::to_string(graph.point_edges[k].to),
                     assessments[static_cast<std::size_t>(file.point_edges[k])]);
  for (std::size_t k = 0; k < graph.priors.size(); ++k)
    text += edgeLine(std::to_string(graph.priors[k].vertex), "", assessments[static_cast<std::size_t>(file.priors[k])]);
  return text;
}

template <int D>
std::string covarianceCsv(const FileProblem<D>& file, const std::vector<EdgeAssessment>& assessments,
                          const std::vector<pose_graph::Rigid<D>>& poses) {
  std::vector<double> weights;
  for (const EdgeAssessment& edge : assessments) weights.push_back(edge.weight);
  const pose_graph::Marginals<D> marginals(file.problem, poses, weights);
  constexpr int kN = pose_graph::kTangentSize<D>;
  std::string text = "vertex";
  for (int i = 0; i < kN * kN; ++i) text += ",c" + std::to_string(i);
  text += '\n';
  for (std::size_t i = 0; i < file.ids.size(); ++i) {
    const int pose = static_cast<int>(i);
    const pose_graph::Marginal<D> marginal =
        file.frame >= 0 ? marginals.between(file.frame, pose) : marginals.ofPose(pose);
    pose_graph::TangentMatrix<D> covariance = pose_graph::TangentMatrix<D>::Zero();
    if (marginal.knowledge == pose_graph::Knowledge::None) {
      covariance.diagonal().setConstant(kFreeRotation);
      covariance.diagonal().template head<D>().setConstant(kFreeTranslation);
    } else {
      covariance = shown(marginal);
    }
    text += std::to_string(file.ids[i]);
    for (int row = 0; row < kN; ++row)
      for (int column = 0; column < kN; ++column) text += "," + urban_nav_core::printNumber(covariance(row, column));
    text += '\n';
  }
  return text;
}

template <int D>
G2oGraph withoutRejected(const G2oGraph& graph, const FileProblem<D>& file,
                         const std::vector<EdgeAssessment>& assessments) {
  const auto rejected = [&](int edge) {
    return edge >= 0 && assessments[static_cast<std::size_t>(edge)].verdict == ClosureVerdict::Rejected;
  };
  G2oGraph made = graph;
  made.lines.clear();
  made.edges.clear();
  made.point_edges.clear();
  made.priors.clear();
  using Kind = G2oGraph::Kind;
  const auto copy = [&](const auto& from, auto& to, const G2oGraph::Line& line) {
    made.lines.push_back({line.kind, to.size()});
    to.push_back(from[line.index]);
  };
  for (const G2oGraph::Line& line : urban_nav_core::toLines(graph)) {
    if (line.kind == Kind::Edge) {
      if (!rejected(file.edges[line.index])) copy(graph.edges, made.edges, line);
    } else if (line.kind == Kind::PointEdge) {
      if (!rejected(file.point_edges[line.index])) copy(graph.point_edges, made.point_edges, line);
    } else if (line.kind == Kind::Prior) {
      if (!rejected(file.priors[line.index])) copy(graph.priors, made.priors, line);
    } else {
      made.lines.push_back(line);
    }
  }
  return made;
}

template std::string edgesCsv<2>(const G2oGraph&, const FileProblem<2>&, const std::vector<EdgeAssessment>&);
template std::string edgesCsv<3>(const G2oGraph&, const FileProblem<3>&, const std::vector<EdgeAssessment>&);
template std::string covarianceCsv<2>(const FileProblem<2>&, const std::vector<EdgeAssessment>&,
                                      const std::vector<pose_graph::Rigid<2>>&);
template std::string covarianceCsv<3>(const FileProblem<3>&, const std::vector<EdgeAssessment>&,
                                      const std::vector<pose_graph::Rigid<3>>&);
template G2oGraph withoutRejected<2>(const G2oGraph&, const FileProblem<2>&, const std::vector<EdgeAssessment>&);
template G2oGraph withoutRejected<3>(const G2oGraph&, const FileProblem<3>&, const std::vector<EdgeAssessment>&);

}  // namespace urban_nav
