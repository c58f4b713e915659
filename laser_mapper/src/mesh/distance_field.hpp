// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "laser_mapper/map_point.hpp"
#include "laser_mapper/mesh/surface_mesh.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

/// Signed distances to the surface of points at the nodes of a sparse grid around them; positive on the side of the
/// lasers. Not thread-safe while points are added.
class DistanceField {
 public:
  using Node = urban_nav_registration::Cell;

  /// `edge`: of the grid, m.
  explicit DistanceField(double edge) : edge_(edge), table_(1 << 16) {}

  void add(const MapPoint& point);

  /// Node with enough points around it.
  struct Value {
    Node node;
    float distance = 0.0F;  ///< m
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();
  };
  /// Returns the known nodes, in order of first occurrence.
  std::vector<Value> values() const;
  std::optional<Value> at(const Node& node) const;
  /// Returns the vertex of the cell whose lowest corner is `node`: the mean of the intersections of its edges with the
  /// surface; nullopt if a corner is unknown or the surface does not intersect the cell.
  std::optional<TriangleMesh::Vertex> vertexAt(const Node& node) const;

 private:
  struct Sums {
    Node node;
    float weight = 0.0F, distance = 0.0F;
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();
  };
  static std::optional<Value> valueOf(const Sums& sums);

  const double edge_;
  urban_nav_registration::CellTable table_;
  std::vector<Sums> nodes_;
};

}  // namespace laser_mapper
