// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "laser_mapper/map_cell.hpp"
#include "laser_mapper/map_point.hpp"

namespace laser_mapper {

/// Triangles of a surface, with corners counter-clockwise as seen from the lasers.
struct TriangleMesh {
  struct Vertex {
    Eigen::Vector3f p = Eigen::Vector3f::Zero();  ///< m
    std::uint8_t red = 0, green = 0, blue = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Triangulates the points of a map. The signed distance to the plane of each point with a normal is averaged in a
/// sparse grid of twice the voxel edge; the surface is its zero level (surface nets: Gibson 1998). Holes narrower than
/// about three edges of the grid are closed. Processes tile by tile: memory holds three rows of tiles and the mesh. The
/// result does not depend on the number of threads. Not thread-safe.
class SurfaceMesher {
 public:
  /// `voxel`: edge of the map's voxels, m.
  explicit SurfaceMesher(double voxel) : voxel_(voxel) {}

  /// Adds the points of a tile, in the order of tiles. Points without a normal are ignored.
  void add(const Tile& tile, const std::vector<MapPoint>& points);
  /// Returns the mesh of all points.
  TriangleMesh finish();

 private:
  void meshRow(int y);

  const double voxel_;
  std::map<Tile, std::vector<MapPoint>> tiles_;  ///< up to three rows of tiles
  TriangleMesh mesh_;
  std::map<std::array<int, 3>, std::uint32_t> border_;  ///< vertices of cells used by several tiles
};

/// Returns a mesh as binary PLY: vertices with colours, faces of three vertices.
std::string printMeshPly(const TriangleMesh& mesh);

}  // namespace laser_mapper
