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

/// Triangles of a surface. Their corners go round counter-clockwise as seen from where the lasers were.
struct TriangleMesh {
  struct Vertex {
    Eigen::Vector3f p = Eigen::Vector3f::Zero();  ///< m
    std::uint8_t red = 0, green = 0, blue = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Makes triangles of the points of a map. Around each point with a normal the signed distance to its plane is averaged
/// in a sparse grid of two edges of the map's cubes; the surface is where it is zero (surface nets: Gibson 1998). Holes
/// narrower than some three edges of the grid are closed. Works tile by tile: in memory are three rows of tiles, and
/// the mesh. The result does not depend on the number of threads. Not thread-safe.
class SurfaceMesher {
 public:
  /// `voxel`: edge of the map's cubes, m.
  explicit SurfaceMesher(double voxel) : voxel_(voxel) {}

  /// Adds the points of a tile, in the order of tiles. Points without a normal are left out.
  void add(const Tile& tile, const std::vector<MapPoint>& points);
  /// Returns the mesh of all points.
  TriangleMesh finish();

 private:
  void meshRow(int y);

  const double voxel_;
  std::map<Tile, std::vector<MapPoint>> tiles_;  ///< of up to three rows
  TriangleMesh mesh_;
  std::map<std::array<int, 3>, std::uint32_t> border_;  ///< vertices of cells that several tiles use
};

/// Returns a mesh as binary PLY: vertices with colours, faces of three vertices.
std::string printMeshPly(const TriangleMesh& mesh);

}  // namespace laser_mapper
