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

/// Content of a g2o text file. All numbers are kept as written, so that reading and writing changes none: quaternions
/// in files are not exactly of unit length and are normalised only by pose().
struct G2oGraph {
  using Id = std::int64_t;

  struct Vertex {
    Id id = 0;
    std::array<double, 7> values{};  ///< SE2: x, y, theta; SE3: x, y, z, qx, qy, qz, qw (m, rad)
  };
  /// Measurement of pose `to` in the frame of pose `from`.
  struct Edge {
    Id from = 0, to = 0;
    std::array<double, 7> values{};  ///< as in Vertex
    std::array<double, 21>
        information{};  ///< upper triangle, row by row; SE2: x, y, theta, 6 numbers; SE3: x, y, z, qx, qy, qz
  };

  /// Landmark: VERTEX_XY, VERTEX_TRACKXYZ. `values`: x, y or x, y, z (m).
  struct Point {
    Id id = 0;
    std::array<double, 3> values{};
  };
  /// Measurement of a landmark in the frame of a pose or of a sensor mounted on it: EDGE_SE2_XY, EDGE_SE3_TRACKXYZ.
  struct PointEdge {
    Id from = 0, to = 0;                  ///< pose, landmark
    Id parameter = 0;                     ///< SE3: id of the Offset
    std::array<double, 3> values{};       ///< as in Point
    std::array<double, 6> information{};  ///< upper triangle, row by row: 3 numbers in the plane, 6 in space
  };
  /// Measurement of one pose in the frame of the graph: EDGE_PRIOR_SE2, EDGE_PRIOR_SE2_XY, EDGE_SE3_PRIOR.
  struct Prior {
    Id vertex = 0;
    Id parameter = 0;                ///< SE3: id of the Offset
    bool position = false;           ///< EDGE_PRIOR_SE2_XY: x and y only; `values` has 2 numbers then, `information` 3
    std::array<double, 7> values{};  ///< as in Vertex
    std::array<double, 21> information{};  ///< as in Edge
  };
  /// PARAMS_SE3OFFSET: pose of a sensor in the frame of its vertex.
  struct Offset {
    Id id = 0;
    std::array<double, 7> values{};
  };

  int dimension = 3;  ///< 2 (SE2) or 3 (SE3:QUAT), for the whole file
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Id> fixed;
  std::vector<Point> points;
  std::vector<PointEdge> point_edges;
  std::vector<Prior> priors;
  std::vector<Offset> offsets;
  std::vector<std::string> others;  ///< lines with other tags and comments, unchanged

  /// Element of each line, as an index into the vectors above. Elements appended later need no line: they are written
  /// at the end, vertices first. Clear `lines` after removing elements.
  enum class Kind { Vertex, Point, Offset, Edge, PointEdge, Prior, Fix, Other };
  struct Line {
    Kind kind;
    std::size_t index;
  };
  std::vector<Line> lines;

  /// Returns the pose of a vertex; in 2D with z = 0 and a rotation about z. Quaternions are normalised.
  Pose pose(const Vertex& vertex) const;
  Pose pose(const Edge& edge) const;
  Pose pose(const Prior& prior) const;
  Pose pose(const Offset& offset) const;
  void setPose(Vertex& vertex, const Pose& pose) const;
};

/// Return the symmetric matrix of an upper triangle, given as n (n + 1) / 2 numbers, and the inverse conversion.
Eigen::MatrixXd g2oInformation(const G2oGraph::Edge& edge, int dimension);
void setG2oInformation(G2oGraph::Edge& edge, const Eigen::MatrixXd& information);
/// Convert the 6x6 information between (rho, phi) in `from` (docs/conventions.md) and the error of g2o: translation and
/// vector part of the quaternion of Z^-1 X, in the frame `to`. To first order in the error.
Matrix6d boxFromG2oInformation(const Matrix6d& g2o, const Pose& T_from_to);
Matrix6d g2oFromBoxInformation(const Matrix6d& box, const Pose& T_from_to);

/// Handling of lines with unknown tags. Comments, from # to the end of a line, are always accepted; a comment after
/// numbers is dropped.
enum class UnknownTags { Keep, Refuse };

/// Read a graph. A byte order mark is skipped. Throw UserError with file and line for a wrong number of columns,
/// numbers that are not finite, quaternions that are not of unit length to 1 %, duplicate vertices, SE2 and SE3 in one
/// file, and unknown tags if they are refused. Edges may refer to vertices without a line.
G2oGraph readG2o(const std::string& path, UnknownTags unknown = UnknownTags::Keep);
G2oGraph parseG2o(std::string_view text, const std::string& name, UnknownTags unknown = UnknownTags::Keep);

/// Returns the lines in the order of writing: graph.lines, then elements without a line.
std::vector<G2oGraph::Line> toLines(const G2oGraph& graph);
std::string printG2o(const G2oGraph& graph);
/// Returns the tags of `graph.others` with their counts, in the order of first occurrence, without comments.
std::vector<std::pair<std::string, std::size_t>> unknownTags(const G2oGraph& graph);
void writeG2o(const std::string& path, const G2oGraph& graph);

}  // namespace urban_nav_core
