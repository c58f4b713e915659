// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/g2o.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "io/graph_lines.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_core {
namespace {

using Words = GraphLines::Words;

std::size_t g2oPoseSize(int dimension) { return dimension == 2 ? 3 : 7; }
std::size_t g2oInformationSize(int dimension) { return dimension == 2 ? 6 : 21; }
std::size_t pointInformationSize(int dimension) { return dimension == 2 ? 3 : 6; }
Eigen::Index tangentSize(int dimension) { return dimension == 2 ? 3 : 6; }

class G2oParser {
 public:
  G2oParser(const std::string& name, UnknownTags unknown)
      : lines_(name, unknown,
               "VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT, FIX, VERTEX_XY, EDGE_SE2_XY, VERTEX_TRACKXYZ, "
               "EDGE_SE3_TRACKXYZ, EDGE_PRIOR_SE2, EDGE_PRIOR_SE2_XY, EDGE_SE3_PRIOR, PARAMS_SE3OFFSET",
               "SE2 and SE3") {}

  void line(std::string_view text, int number) {
    const Words words = lines_.begin(text, number);
    if (words.empty()) return;
    const std::string_view tag = words[0];
    if (tag == "VERTEX_SE2") vertex(words, 2);
    else if (tag == "VERTEX_SE3:QUAT") vertex(words, 3);
    else if (tag == "EDGE_SE2") edge(words, 2);
    else if (tag == "EDGE_SE3:QUAT") edge(words, 3);
    else if (tag == "FIX") lines_.fix(words);
    else if (tag == "VERTEX_XY") point(words, 2);
    else if (tag == "VERTEX_TRACKXYZ") point(words, 3);
    else if (tag == "EDGE_SE2_XY") pointEdge(words, 2);
    else if (tag == "EDGE_SE3_TRACKXYZ") pointEdge(words, 3);
    else if (tag == "EDGE_PRIOR_SE2") prior(words, 2, false);
    else if (tag == "EDGE_PRIOR_SE2_XY") prior(words, 2, true);
    else if (tag == "EDGE_SE3_PRIOR") prior(words, 3, false);
    else if (tag == "PARAMS_SE3OFFSET") offset(words);
    else lines_.other(text, tag);
  }

  G2oGraph take() { return lines_.take(); }

 private:
  void vertex(const Words& words, int dimension) {
    lines_.demandColumns(words, 2 + g2oPoseSize(dimension), dimension);
    G2oGraph::Vertex vertex;
    vertex.id = lines_.id(words[1]);
    pose(words, 2, dimension, vertex.values);
    lines_.add(vertex);
  }

  void edge(const Words& words, int dimension) {
    lines_.demandColumns(words, 3 + g2oPoseSize(dimension) + g2oInformationSize(dimension), dimension);
    G2oGraph::Edge edge;
    edge.from = lines_.id(words[1]);
    edge.to = lines_.id(words[2]);
    pose(words, 3, dimension, edge.values);
    for (std::size_t i = 0; i < g2oInformationSize(dimension); ++i)
      edge.information[i] = lines_.number(words[3 + g2oPoseSize(dimension) + i]);
    lines_.add(edge);
  }

  void point(const Words& words, int dimension) {
    const auto numbers = static_cast<std::size_t>(dimension);
    lines_.demandColumns(words, 2 + numbers, dimension);
    G2oGraph::Point point;
    point.id = lines_.id(words[1]);
    for (std::size_t i = 0; i < numbers; ++i) point.values[i] = lines_.number(words[2 + i]);
    lines_.add(point);
  }

  void pointEdge(const Words& words, int dimension) {
    const auto numbers = static_cast<std::size_t>(dimension);
    const std::size_t first = dimension == 2 ? 3 : 4;
    lines_.demandColumns(words, first + numbers + pointInformationSize(dimension), dimension);
    G2oGraph::PointEdge edge;
    edge.from = lines_.id(words[1]);
    edge.to = lines_.id(words[2]);
    if (dimension == 3) edge.parameter = lines_.id(words[3]);
    for (std::size_t i = 0; i < numbers; ++i) edge.values[i] = lines_.number(words[first + i]);
    for (std::size_t i = 0; i < pointInformationSize(dimension); ++i)
      edge.information[i] = lines_.number(words[first + numbers + i]);
    lines_.add(edge);
  }

  void prior(const Words& words, int dimension, bool position) {
    const std::size_t first = dimension == 2 ? 2 : 3;
    const std::size_t numbers = position ? 2 : g2oPoseSize(dimension);
    const std::size_t information = position ? 3 : g2oInformationSize(dimension);
    lines_.demandColumns(words, first + numbers + information, dimension);
    G2oGraph::Prior prior;
    prior.vertex = lines_.id(words[1]);
    if (dimension == 3) prior.parameter = lines_.id(words[2]);
    prior.position = position;
    if (position) {
      for (std::size_t i = 0; i < numbers; ++i) prior.values[i] = lines_.number(words[first + i]);
    } else {
      pose(words, first, dimension, prior.values);
    }
    for (std::size_t i = 0; i < information; ++i) prior.information[i] = lines_.number(words[first + numbers + i]);
    lines_.add(prior);
  }

  void offset(const Words& words) {
    lines_.demandColumns(words, 2 + g2oPoseSize(3), 3);
    G2oGraph::Offset offset;
    offset.id = lines_.id(words[1]);
    pose(words, 2, 3, offset.values);
    lines_.add(offset);
  }

  void pose(const Words& words, std::size_t first, int dimension, std::array<double, 7>& values) const {
    for (std::size_t i = 0; i < g2oPoseSize(dimension); ++i) values[i] = lines_.number(words[first + i]);
    if (dimension == 2) return;
    const double length = Quaterniond(values[6], values[3], values[4], values[5]).norm();
    if (!(std::abs(length - 1.0) <= 0.01))
      lines_.refuse("a quaternion of length " + printNumber(length), "length 1 (1 %)");
  }

  GraphLines lines_;
};

template <std::size_t N>
void appendNumbers(std::string& text, const std::array<double, N>& values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    text += ' ';
    appendNumber(text, values[i]);
  }
}

// Landmarks, priors and the offsets of sensors.
void appendConstraintLine(std::string& text, const G2oGraph& graph, const G2oGraph::Line& line) {
  const bool plane = graph.dimension == 2;
  const auto numbers = static_cast<std::size_t>(graph.dimension);
  if (line.kind == G2oGraph::Kind::Point) {
    const auto& point = graph.points[line.index];
    text += (plane ? "VERTEX_XY " : "VERTEX_TRACKXYZ ") + std::to_string(point.id);
    appendNumbers(text, point.values, numbers);
  } else if (line.kind == G2oGraph::Kind::PointEdge) {
    const auto& edge = graph.point_edges[line.index];
    text += (plane ? "EDGE_SE2_XY " : "EDGE_SE3_TRACKXYZ ") + std::to_string(edge.from) + " " + std::to_string(edge.to);
    if (!plane) text += " " + std::to_string(edge.parameter);
    appendNumbers(text, edge.values, numbers);
    appendNumbers(text, edge.information, pointInformationSize(graph.dimension));
  } else if (line.kind == G2oGraph::Kind::Prior) {
    const auto& prior = graph.priors[line.index];
    const std::string tag = !plane ? "EDGE_SE3_PRIOR " : prior.position ? "EDGE_PRIOR_SE2_XY " : "EDGE_PRIOR_SE2 ";
    text += tag + std::to_string(prior.vertex);
    if (!plane) text += " " + std::to_string(prior.parameter);
    appendNumbers(text, prior.values, prior.position ? 2 : g2oPoseSize(graph.dimension));
    appendNumbers(text, prior.information, prior.position ? 3 : g2oInformationSize(graph.dimension));
  } else {
    const auto& offset = graph.offsets[line.index];
    text += "PARAMS_SE3OFFSET " + std::to_string(offset.id);
    appendNumbers(text, offset.values, g2oPoseSize(3));
  }
}

void appendG2oLine(std::string& text, const G2oGraph& graph, const G2oGraph::Line& line) {
  const std::string type = graph.dimension == 2 ? "SE2 " : "SE3:QUAT ";
  switch (line.kind) {
    case G2oGraph::Kind::Vertex: {
      const auto& vertex = graph.vertices[line.index];
      text += "VERTEX_" + type + std::to_string(vertex.id);
      appendNumbers(text, vertex.values, g2oPoseSize(graph.dimension));
      break;
    }
    case G2oGraph::Kind::Edge: {
      const auto& edge = graph.edges[line.index];
      text += "EDGE_" + type + std::to_string(edge.from) + " " + std::to_string(edge.to);
      appendNumbers(text, edge.values, g2oPoseSize(graph.dimension));
      appendNumbers(text, edge.information, g2oInformationSize(graph.dimension));
      break;
    }
    case G2oGraph::Kind::Point:
    case G2oGraph::Kind::PointEdge:
    case G2oGraph::Kind::Prior:
    case G2oGraph::Kind::Offset: appendConstraintLine(text, graph, line); break;
    case G2oGraph::Kind::Fix: text += "FIX " + std::to_string(graph.fixed[line.index]); break;
    case G2oGraph::Kind::Other: text += graph.others[line.index]; break;
  }
  text += '\n';
}

Pose toPose(const std::array<double, 7>& v, int dimension) {
  if (dimension == 2) return Pose(Quaterniond(std::cos(0.5 * v[2]), 0.0, 0.0, std::sin(0.5 * v[2])), {v[0], v[1], 0.0});
  return Pose(Quaterniond(v[6], v[3], v[4], v[5]), {v[0], v[1], v[2]});
}

// d_g2o = J d_box: translation and quaternion vector of the error are in `to`, and the vector is half the angle.
Matrix6d g2oFromBox(const Pose& T_from_to) {
  const Matrix3d R_to_from = T_from_to.R().transpose();
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_to_from;
  J.bottomRightCorner<3, 3>() = 0.5 * R_to_from;
  return J;
}

}  // namespace

Pose G2oGraph::pose(const Vertex& vertex) const { return toPose(vertex.values, dimension); }
Pose G2oGraph::pose(const Edge& edge) const { return toPose(edge.values, dimension); }
Pose G2oGraph::pose(const Prior& prior) const { return toPose(prior.values, dimension); }
Pose G2oGraph::pose(const Offset& offset) const { return toPose(offset.values, 3); }

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
  G2oParser parser(name, unknown);
  forEachLine(withoutByteOrderMark(text), [&parser](std::string_view line, int number) { parser.line(line, number); });
  return parser.take();
}

std::vector<G2oGraph::Line> toLines(const G2oGraph& graph) {
  std::vector<G2oGraph::Line> lines = graph.lines;
  std::array<std::size_t, 8> listed{};
  for (const G2oGraph::Line& line : graph.lines) ++listed[static_cast<std::size_t>(line.kind)];
  const auto append_rest = [&](G2oGraph::Kind kind, std::size_t size) {
    for (std::size_t i = listed[static_cast<std::size_t>(kind)]; i < size; ++i) lines.push_back({kind, i});
  };
  append_rest(G2oGraph::Kind::Vertex, graph.vertices.size());
  append_rest(G2oGraph::Kind::Point, graph.points.size());
  append_rest(G2oGraph::Kind::Offset, graph.offsets.size());
  append_rest(G2oGraph::Kind::Edge, graph.edges.size());
  append_rest(G2oGraph::Kind::PointEdge, graph.point_edges.size());
  append_rest(G2oGraph::Kind::Prior, graph.priors.size());
  append_rest(G2oGraph::Kind::Fix, graph.fixed.size());
  append_rest(G2oGraph::Kind::Other, graph.others.size());
  return lines;
}

std::string printG2o(const G2oGraph& graph) {
  std::string text;
  for (const G2oGraph::Line& line : toLines(graph)) appendG2oLine(text, graph, line);
  return text;
}

std::vector<std::pair<std::string, std::size_t>> unknownTags(const G2oGraph& graph) {
  std::vector<std::pair<std::string, std::size_t>> made;
  for (const std::string& line : graph.others) {
    const Words words = splitBlanks(line);
    if (words.empty() || words[0].front() == '#') continue;
    const auto at = std::find_if(made.begin(), made.end(), [&](const auto& entry) { return entry.first == words[0]; });
    if (at == made.end()) made.emplace_back(std::string(words[0]), 1);
    else ++at->second;
  }
  return made;
}

void writeG2o(const std::string& path, const G2oGraph& graph) { writeAtomically(path, printG2o(graph)); }

}  // namespace urban_nav_core
