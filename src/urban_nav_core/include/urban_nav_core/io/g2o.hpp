// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// A pose graph as a g2o text file holds it, number for number, so that reading and writing changes none: the
/// quaternions of files are not exactly of length one, and who normalises them does it in pose().
struct G2oGraph {
  using Id = std::int64_t;

  struct Vertex {
    Id id = 0;
    std::array<double, 7> values{};  ///< SE2: x, y, theta; SE3: x, y, z, qx, qy, qz, qw (m, rad)
  };
  /// Measures pose `to` in the frame of pose `from`.
  struct Edge {
    Id from = 0, to = 0;
    std::array<double, 7> values{};  ///< as in Vertex
    std::array<double, 21>
        information{};  ///< upper triangle, row by row; SE2: x, y, theta, 6 numbers; SE3: x, y, z, qx, qy, qz
  };

  /// A landmark: VERTEX_XY, VERTEX_TRACKXYZ. `values`: x, y or x, y, z (m).
  struct Point {
    Id id = 0;
    std::array<double, 3> values{};
  };
  /// Measures a landmark in the frame of a pose, or of a sensor mounted on it: EDGE_SE2_XY, EDGE_SE3_TRACKXYZ.
  struct PointEdge {
    Id from = 0, to = 0;                  ///< pose, landmark
    Id parameter = 0;                     ///< SE3: of the Offset
    std::array<double, 3> values{};       ///< as in Point
    std::array<double, 6> information{};  ///< upper triangle, row by row: 3 numbers in the plane, 6 in space
  };
  /// Measures one pose in the frame of the graph: EDGE_PRIOR_SE2, EDGE_PRIOR_SE2_XY, EDGE_SE3_PRIOR.
  struct Prior {
    Id vertex = 0;
    Id parameter = 0;                ///< SE3: of the Offset
    bool position = false;           ///< EDGE_PRIOR_SE2_XY: x and y alone; `values` has 2 numbers then, `information` 3
    std::array<double, 7> values{};  ///< as in Vertex
    std::array<double, 21> information{};  ///< as in Edge
  };
  /// PARAMS_SE3OFFSET: the pose of a sensor in the frame of the vertex that carries it.
  struct Offset {
    Id id = 0;
    std::array<double, 7> values{};
  };

  int dimension = 3;  ///< 2 (SE2) or 3 (SE3:QUAT), one for the whole file
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Id> fixed;
  std::vector<Point> points;
  std::vector<PointEdge> point_edges;
  std::vector<Prior> priors;
  std::vector<Offset> offsets;
  std::vector<std::string> others;  ///< lines with other tags and comments, as they were

  /// What stands in which line, as an index into the vectors above. Elements appended to those vectors later need no
  /// line: they are written at the end, vertices first. Who removes elements clears `lines`.
  enum class Kind { Vertex, Point, Offset, Edge, PointEdge, Prior, Fix, Other };
  struct Line {
    Kind kind;
    std::size_t index;
  };
  std::vector<Line> lines;

  /// In 2D the pose has z = 0 and turns about z. Quaternions are normalised.
  Pose pose(const Vertex& vertex) const;
  Pose pose(const Edge& edge) const;
  Pose pose(const Prior& prior) const;
  Pose pose(const Offset& offset) const;
  void setPose(Vertex& vertex, const Pose& pose) const;
};

/// The symmetric matrix of an upper triangle of the first n (n + 1) / 2 numbers, and back.
Eigen::MatrixXd g2oInformation(const G2oGraph::Edge& edge, int dimension);
void setG2oInformation(G2oGraph::Edge& edge, const Eigen::MatrixXd& information);
/// The information of (rho, phi) in `from` (the convention of everything that leaves a stage) for that of g2o's error,
/// which is the translation and the quaternion's vector of Z^-1 X in the frame `to`, at a small error; and back. 6x6.
Matrix6d boxFromG2oInformation(const Matrix6d& g2o, const Pose& T_from_to);
Matrix6d g2oFromBoxInformation(const Matrix6d& box, const Pose& T_from_to);

/// What becomes of lines whose tag is unknown. Comments, from # to the end of a line, are never refused; one after
/// numbers is dropped.
enum class UnknownTags { Keep, Refuse };

/// A byte order mark at the begin of the text is skipped. Throw UserError with file and line for: a wrong number of
/// columns, numbers that are not finite, quaternions not of length one to 1 %, doubled vertices, SE2 and SE3 in one
/// file, and unknown tags if they are refused. Edges may name vertices that have no line.
G2oGraph readG2o(const std::string& path, UnknownTags unknown = UnknownTags::Keep);
G2oGraph parseG2o(std::string_view text, const std::string& name, UnknownTags unknown = UnknownTags::Keep);

/// The lines in the order in which they are written: graph.lines, then what has no line.
std::vector<G2oGraph::Line> toLines(const G2oGraph& graph);
std::string printG2o(const G2oGraph& graph);
/// Tags of `graph.others` and how often each occurs, in the order of their first line; comments are not counted.
std::vector<std::pair<std::string, std::size_t>> unknownTags(const G2oGraph& graph);
void writeG2o(const std::string& path, const G2oGraph& graph);

}  // namespace urban_nav_core
