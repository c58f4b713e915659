// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/g2o.hpp"

#include <cassert>
#include <cmath>
#include <set>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

using Words = std::vector<std::string_view>;

std::size_t poseSize(int dimension) { return dimension == 2 ? 3 : 7; }
std::size_t informationSize(int dimension) { return dimension == 2 ? 6 : 21; }
Eigen::Index tangentSize(int dimension) { return dimension == 2 ? 3 : 6; }

class Parser {
 public:
  Parser(std::string name, UnknownTags unknown) : name_(std::move(name)), unknown_(unknown) {}

  void line(std::string_view text, int number) {
    const Words words = splitBlanks(text);
    if (words.empty()) return;
    where_ = atLine(name_, number);
    const std::string_view tag = words[0];
    if (tag == "VERTEX_SE2") vertex(words, 2);
    else if (tag == "VERTEX_SE3:QUAT") vertex(words, 3);
    else if (tag == "EDGE_SE2") edge(words, 2);
    else if (tag == "EDGE_SE3:QUAT") edge(words, 3);
    else if (tag == "FIX") fix(words);
    else other(text, tag);
  }

  G2oGraph take() { return std::move(graph_); }

 private:
  void vertex(const Words& words, int dimension) {
    demand(words, 2 + poseSize(dimension), dimension);
    G2oGraph::Vertex vertex;
    vertex.id = id(words[1]);
    pose(words, 2, dimension, vertex.values);
    if (!known_.insert(vertex.id).second)
      throw UserError(where_, "vertex " + std::to_string(vertex.id) + " stands twice", "");
    graph_.lines.push_back({G2oGraph::Kind::Vertex, graph_.vertices.size()});
    graph_.vertices.push_back(vertex);
  }

  void edge(const Words& words, int dimension) {
    demand(words, 3 + poseSize(dimension) + informationSize(dimension), dimension);
    G2oGraph::Edge edge;
    edge.from = id(words[1]);
    edge.to = id(words[2]);
    if (edge.from == edge.to) throw UserError(where_, "an edge from " + std::to_string(edge.from) + " to itself", "");
    pose(words, 3, dimension, edge.values);
    for (std::size_t i = 0; i < informationSize(dimension); ++i)
      edge.information[i] = number(words[3 + poseSize(dimension) + i]);
    graph_.lines.push_back({G2oGraph::Kind::Edge, graph_.edges.size()});
    graph_.edges.push_back(edge);
  }

  void fix(const Words& words) {
    for (std::size_t i = 1; i < words.size(); ++i) {
      graph_.lines.push_back({G2oGraph::Kind::Fix, graph_.fixed.size()});
      graph_.fixed.push_back(id(words[i]));
    }
    if (words.size() == 1) throw UserError(where_, "FIX without a vertex", "FIX id");
  }

  void other(std::string_view text, std::string_view tag) {
    if (unknown_ == UnknownTags::Refuse && tag.front() != '#') {
      throw UserError(where_, "unknown tag " + std::string(tag),
                      "VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT, FIX");
    }
    graph_.lines.push_back({G2oGraph::Kind::Other, graph_.others.size()});
    graph_.others.emplace_back(text);
  }

  void demand(const Words& words, std::size_t columns, int dimension) {
    if (words.size() != columns) {
      throw UserError(where_, std::string(words[0]) + " with " + std::to_string(words.size()) + " columns",
                      std::to_string(columns));
    }
    if (has_dimension_ && graph_.dimension != dimension)
      throw UserError(where_, "SE2 and SE3 in one file", "one of them");
    graph_.dimension = dimension;
    has_dimension_ = true;
  }

  G2oGraph::Id id(std::string_view word) const {
    const auto value = parseInteger(word);
    if (!value || *value < 0) throw UserError(where_, "vertex `" + std::string(word) + "`", "whole numbers from 0");
    return *value;
  }

  double number(std::string_view word) const {
    const auto value = parseNumber(word);
    if (!value) throw UserError(where_, "`" + std::string(word) + "`", "a finite number");
    return *value;
  }

  void pose(const Words& words, std::size_t first, int dimension, std::array<double, 7>& values) const {
    for (std::size_t i = 0; i < poseSize(dimension); ++i) values[i] = number(words[first + i]);
    if (dimension == 2) return;
    const double length = Quaterniond(values[6], values[3], values[4], values[5]).norm();
    if (!(std::abs(length - 1.0) <= 0.01))
      throw UserError(where_, "a quaternion of length " + printNumber(length), "length 1 (1 %)");
  }

  std::string name_, where_;
  UnknownTags unknown_;
  bool has_dimension_ = false;
  std::set<G2oGraph::Id> known_;
  G2oGraph graph_;
};

template <std::size_t N>
void appendNumbers(std::string& text, const std::array<double, N>& values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    text += ' ';
    appendNumber(text, values[i]);
  }
}

void appendLine(std::string& text, const G2oGraph& graph, const G2oGraph::Line& line) {
  const std::string type = graph.dimension == 2 ? "SE2 " : "SE3:QUAT ";
  switch (line.kind) {
    case G2oGraph::Kind::Vertex: {
      const auto& vertex = graph.vertices[line.index];
      text += "VERTEX_" + type + std::to_string(vertex.id);
      appendNumbers(text, vertex.values, poseSize(graph.dimension));
      break;
    }
    case G2oGraph::Kind::Edge: {
      const auto& edge = graph.edges[line.index];
      text += "EDGE_" + type + std::to_string(edge.from) + " " + std::to_string(edge.to);
      appendNumbers(text, edge.values, poseSize(graph.dimension));
      appendNumbers(text, edge.information, informationSize(graph.dimension));
      break;
    }
    case G2oGraph::Kind::Fix: text += "FIX " + std::to_string(graph.fixed[line.index]); break;
    case G2oGraph::Kind::Other: text += graph.others[line.index]; break;
  }
  text += '\n';
}

Pose poseOf(const std::array<double, 7>& v, int dimension) {
  if (dimension == 2) return Pose(Quaterniond(std::cos(0.5 * v[2]), 0.0, 0.0, std::sin(0.5 * v[2])), {v[0], v[1], 0.0});
  return Pose(Quaterniond(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]});
}

// d_g2o = J d_box: the error's translation and quaternion vector live in `to`, and the vector is half the angle.
Matrix6d g2oFromBox(const Pose& T_from_to) {
  const Matrix3d R_to_from = T_from_to.R().transpose();
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_to_from;
  J.bottomRightCorner<3, 3>() = 0.5 * R_to_from;
  return J;
}

}  // namespace

Pose G2oGraph::pose(const Vertex& vertex) const { return poseOf(vertex.values, dimension); }
Pose G2oGraph::pose(const Edge& edge) const { return poseOf(edge.values, dimension); }

void G2oGraph::setPose(Vertex& vertex, const Pose& pose) const {
  const Vector3d& t = pose.t();
  const Quaterniond& q = pose.q();
  if (dimension == 2) {
    vertex.values = {t.x(), t.y(), logSo3(q).z()};
  } else {
    vertex.values = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
  }
}

Eigen::MatrixXd g2oInformation(const G2oGraph::Edge& edge, int dimension) {
  const Eigen::Index n = tangentSize(dimension);
  Eigen::MatrixXd M(n, n);
  std::size_t at = 0;
  for (Eigen::Index row = 0; row < n; ++row) {
    for (Eigen::Index column = row; column < n; ++column) M(row, column) = M(column, row) = edge.information[at++];
  }
  return M;
}

void setG2oInformation(G2oGraph::Edge& edge, const Eigen::MatrixXd& information) {
  assert(information.rows() == information.cols() && (information.rows() == 3 || information.rows() == 6));
  std::size_t at = 0;
  for (Eigen::Index row = 0; row < information.rows(); ++row) {
    for (Eigen::Index column = row; column < information.cols(); ++column)
      edge.information[at++] = information(row, column);
  }
}

Matrix6d boxFromG2oInformation(const Matrix6d& g2o, const Pose& T_from_to) {
  const Matrix6d J = g2oFromBox(T_from_to);
  return J.transpose() * g2o * J;
}

Matrix6d g2oFromBoxInformation(const Matrix6d& box, const Pose& T_from_to) {
  const Matrix3d R_from_to = T_from_to.R();
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_from_to;
  J.bottomRightCorner<3, 3>() = 2.0 * R_from_to;
  return J.transpose() * box * J;
}

G2oGraph readG2o(const std::string& path, UnknownTags unknown) { return parseG2o(readTextFile(path), path, unknown); }

G2oGraph parseG2o(std::string_view text, const std::string& name, UnknownTags unknown) {
  Parser parser(name, unknown);
  forEachLine(text, [&parser](std::string_view line, int number) { parser.line(line, number); });
  return parser.take();
}

std::vector<G2oGraph::Line> linesOf(const G2oGraph& graph) {
  std::vector<G2oGraph::Line> lines = graph.lines;
  std::array<std::size_t, 4> listed{};
  for (const G2oGraph::Line& line : graph.lines) ++listed[static_cast<std::size_t>(line.kind)];
  const auto append_rest = [&](G2oGraph::Kind kind, std::size_t size) {
    for (std::size_t i = listed[static_cast<std::size_t>(kind)]; i < size; ++i) lines.push_back({kind, i});
  };
  append_rest(G2oGraph::Kind::Vertex, graph.vertices.size());
  append_rest(G2oGraph::Kind::Edge, graph.edges.size());
  append_rest(G2oGraph::Kind::Fix, graph.fixed.size());
  append_rest(G2oGraph::Kind::Other, graph.others.size());
  return lines;
}

std::string printG2o(const G2oGraph& graph) {
  std::string text;
  for (const G2oGraph::Line& line : linesOf(graph)) appendLine(text, graph, line);
  return text;
}

void writeG2o(const std::string& path, const G2oGraph& graph) { writeAtomically(path, printG2o(graph)); }

}  // namespace urban_nav_core
