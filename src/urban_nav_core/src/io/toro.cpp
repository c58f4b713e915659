// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/toro.hpp"

#include <cmath>

#include "io/graph_lines.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_core {
namespace {

using Words = GraphLines::Words;

constexpr const char* kKnownTags = "VERTEX2, VERTEX, EDGE2, EDGE, VERTEX3, EDGE3, FIX";

bool isVertex2(std::string_view tag) { return tag == "VERTEX2" || tag == "VERTEX"; }
bool isEdge2(std::string_view tag) { return tag == "EDGE2" || tag == "EDGE"; }

std::size_t toroPoseSize(int dimension) { return dimension == 2 ? 3 : 6; }
std::size_t toroInformationSize(int dimension) { return dimension == 2 ? 6 : 21; }

// Index in the upper triangle (11 12 13 22 23 33) of the numbers of EDGE2 (11 12 22 33 13 23).
constexpr std::array<std::size_t, 6> kUpperOfToro = {0, 1, 3, 5, 2, 4};

Quaterniond toRotation(double roll, double pitch, double yaw) {
  const Quaterniond z(std::cos(0.5 * yaw), 0.0, 0.0, std::sin(0.5 * yaw));
  const Quaterniond y(std::cos(0.5 * pitch), 0.0, std::sin(0.5 * pitch), 0.0);
  const Quaterniond x(std::cos(0.5 * roll), std::sin(0.5 * roll), 0.0, 0.0);
  return z * y * x;
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

// The sum and the difference of yaw and roll are exact to rounding of the quaternion at every pitch. Quotients of
// matrix elements are not near 90 deg, where one of the two angles is undetermined.
Vector3d rollPitchYaw(const Quaterniond& q) {
  const double sum = 2.0 * std::atan2(q.x() + q.z(), q.w() - q.y());
  const double difference = 2.0 * std::atan2(q.z() - q.x(), q.w() + q.y());
  const double pitch =
      2.0 * std::atan2(std::hypot(q.w() + q.y(), q.z() - q.x()), std::hypot(q.w() - q.y(), q.x() + q.z())) - 0.5 * M_PI;
  return {wrapped(0.5 * (sum - difference)), pitch, wrapped(0.5 * (sum + difference))};
}

// Converts the upper triangle to a rotation parameter scaled by 1 / scale: the quaternion's vector is half the rotation
// vector (scale 2), and back (0.5).
void scaleRotation(std::array<double, 21>& information, double scale) {
  std::size_t at = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column, ++at)
      information[at] *= (row >= 3 ? scale : 1.0) * (column >= 3 ? scale : 1.0);
  }
}

class ToroParser {
 public:
  ToroParser(const std::string& name, UnknownTags unknown) : lines_(name, unknown, kKnownTags, "plane and space") {}

  void line(std::string_view text, int number) {
    const Words words = lines_.begin(text, number);
    if (words.empty()) return;
    const std::string_view tag = words[0];
    if (isVertex2(tag)) vertex(words, 2);
    else if (tag == "VERTEX3") vertex(words, 3);
    else if (isEdge2(tag)) edge(words, 2);
    else if (tag == "EDGE3") edge(words, 3);
    else if (tag == "FIX") lines_.fix(words);
    else lines_.other(text, tag);
  }

  G2oGraph take() { return lines_.take(); }

 private:
  void vertex(const Words& words, int dimension) {
    lines_.demandColumns(words, 2 + toroPoseSize(dimension), dimension);
    G2oGraph::Vertex vertex;
    vertex.id = lines_.id(words[1]);
    vertex.values = pose(words, 2, dimension);
    lines_.add(vertex);
  }

  void edge(const Words& words, int dimension) {
    lines_.demandColumns(words, 3 + toroPoseSize(dimension) + toroInformationSize(dimension), dimension);
    G2oGraph::Edge edge;
    edge.from = lines_.id(words[1]);
    edge.to = lines_.id(words[2]);
    edge.values = pose(words, 3, dimension);
    for (std::size_t i = 0; i < toroInformationSize(dimension); ++i)
      edge.information[dimension == 2 ? kUpperOfToro[i] : i] = lines_.number(words[3 + toroPoseSize(dimension) + i]);
    if (dimension == 3) scaleRotation(edge.information, 2.0);
    for (const double value : edge.information)
      if (!std::isfinite(value)) lines_.refuse("information beyond a double's range", "");
    lines_.add(edge);
  }

  std::array<double, 7> pose(const Words& words, std::size_t first, int dimension) const {
    std::array<double, 7> values{};
    for (std::size_t i = 0; i < 3; ++i) values[i] = lines_.number(words[first + i]);
    if (dimension == 2) return values;
    const Quaterniond q =
        toRotation(lines_.number(words[first + 3]), lines_.number(words[first + 4]), lines_.number(words[first + 5]));
    values[3] = q.x();
    values[4] = q.y();
    values[5] = q.z();
    values[6] = q.w();
    return values;
  }

  GraphLines lines_;
};

void appendValue(std::string& text, double value) {
  text += ' ';
  appendNumber(text, value);
}

void appendPose(std::string& text, const std::array<double, 7>& values, const Pose& pose, int dimension) {
  for (std::size_t i = 0; i < 3; ++i) appendValue(text, values[i]);
  if (dimension == 2) return;
  const Vector3d angles = rollPitchYaw(pose.q());
  for (int i = 0; i < 3; ++i) appendValue(text, angles[i]);
}

void appendToroLine(std::string& text, const G2oGraph& graph, const G2oGraph::Line& line) {
  const char digit = graph.dimension == 2 ? '2' : '3';
  switch (line.kind) {
    case G2oGraph::Kind::Vertex: {
      const auto& vertex = graph.vertices[line.index];
      text += std::string("VERTEX") + digit + " " + std::to_string(vertex.id);
      appendPose(text, vertex.values, graph.pose(vertex), graph.dimension);
      break;
    }
    case G2oGraph::Kind::Edge: {
      const auto& edge = graph.edges[line.index];
      text += std::string("EDGE") + digit + " " + std::to_string(edge.from) + " " + std::to_string(edge.to);
      appendPose(text, edge.values, graph.pose(edge), graph.dimension);
      std::array<double, 21> information = edge.information;
      if (graph.dimension == 3) scaleRotation(information, 0.5);
      for (std::size_t i = 0; i < toroInformationSize(graph.dimension); ++i)
        appendValue(text, information[graph.dimension == 2 ? kUpperOfToro[i] : i]);
      break;
    }
    case G2oGraph::Kind::Point:
    case G2oGraph::Kind::PointEdge:
    case G2oGraph::Kind::Prior:
    case G2oGraph::Kind::Offset: return;
    case G2oGraph::Kind::Fix: text += "FIX " + std::to_string(graph.fixed[line.index]); break;
    case G2oGraph::Kind::Other: text += graph.others[line.index]; break;
  }
  text += '\n';
}

}  // namespace

G2oGraph readToro(const std::string& path, UnknownTags unknown) { return parseToro(readTextFile(path), path, unknown); }

G2oGraph parseToro(std::string_view text, const std::string& name, UnknownTags unknown) {
  ToroParser parser(name, unknown);
  forEachLine(withoutByteOrderMark(text), [&parser](std::string_view line, int number) { parser.line(line, number); });
  return parser.take();
}

std::string printToro(const G2oGraph& graph) {
  std::string text;
  for (const G2oGraph::Line& line : toLines(graph)) appendToroLine(text, graph, line);
  return text;
}

void writeToro(const std::string& path, const G2oGraph& graph) { writeAtomically(path, printToro(graph)); }

bool isToro(std::string_view text) {
  bool known = false, toro = false;
  forEachLine(withoutByteOrderMark(text), [&](std::string_view line, int) {
    if (known) return;
    const Words words = splitBlanks(line);
    if (words.empty()) return;
    toro = isVertex2(words[0]) || isEdge2(words[0]) || words[0] == "VERTEX3" || words[0] == "EDGE3";
    known = toro || words[0].substr(0, 10) == "VERTEX_SE2" || words[0].substr(0, 10) == "VERTEX_SE3" ||
            words[0].substr(0, 8) == "EDGE_SE2" || words[0].substr(0, 8) == "EDGE_SE3";
  });
  return toro;
}

}  // namespace urban_nav_core
