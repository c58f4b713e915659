// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/mesh/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/distance_field.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

namespace {

using Key = std::array<int, 3>;

constexpr int kCubesPerEdge = 2;  // voxels of the map along an edge of the grid
constexpr int kTileNodes = kTileCells / kCubesPerEdge;
constexpr int kMargin = 4;  // edges around a tile whose points are used

/// Piece of surface, by the cells with its vertices.
struct TilePiece {
  std::map<Key, TriangleMesh::Vertex> vertices;
  std::vector<std::array<Key, 4>> quads;
};

void addIfNear(const std::vector<MapPoint>& points, const Tile& tile, double edge, DistanceField& field) {
  const auto distance = [&](double value, int index) {
    const double low = edge * kTileNodes * index, high = low + edge * kTileNodes;
    return std::max({low - value, value - high, 0.0});
  };
  for (const MapPoint& point : points)
    if (std::max(distance(static_cast<double>(point.p.x()), tile.x),
                 distance(static_cast<double>(point.p.y()), tile.y)) < kMargin * edge)
      field.add(point);
}

/// Adds the quadrangle across the grid edge from a node of the tile along an axis.
void addQuad(const DistanceField& field, const DistanceField::Value& from, int axis, TilePiece& piece) {
  Key to{from.node.x, from.node.y, from.node.z};
  ++to[static_cast<std::size_t>(axis)];
  const auto next = field.at({to[0], to[1], to[2]});
  if (!next || (next->distance < 0.0F) == (from.distance < 0.0F)) return;
  const std::size_t u = (static_cast<std::size_t>(axis) + 1) % 3, v = (u + 1) % 3;
  std::array<Key, 4> cells;
  const int steps[4][2] = {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}};  // around the axis, counter-clockwise
  for (std::size_t i = 0; i < 4; ++i) {
    cells[i] = {from.node.x, from.node.y, from.node.z};
    cells[i][u] += steps[i][0];
    cells[i][v] += steps[i][1];
    if (piece.vertices.count(cells[i]) != 0) continue;
    const auto vertex = field.vertexAt({cells[i][0], cells[i][1], cells[i][2]});
    if (!vertex) return;
    piece.vertices[cells[i]] = *vertex;
  }
  if (next->distance < 0.0F) std::swap(cells[1], cells[3]);  // as seen from the side with positive distance
  piece.quads.push_back(cells);
}

bool isOfTile(const DistanceField::Node& node, const Tile& tile) {
  const auto part = [](int value) { return static_cast<int>(std::floor(static_cast<double>(value) / kTileNodes)); };
  return part(node.x) == tile.x && part(node.y) == tile.y;
}

bool isAtBorder(const Key& cell) {
  const auto within = [](int value) { return ((value % kTileNodes) + kTileNodes) % kTileNodes; };
  const auto isOutermost = [&](int value) { return within(value) == 0 || within(value) == kTileNodes - 1; };
  return isOutermost(cell[0]) || isOutermost(cell[1]);
}

}  // namespace

void SurfaceMesher::add(const Tile& tile, const std::vector<MapPoint>& points) {
  if (!tiles_.empty() && tiles_.rbegin()->first.y < tile.y) {
    const int last = tiles_.rbegin()->first.y;
    meshRow(last - 1);
    const bool continues = tile.y == last + 1;
    if (!continues) meshRow(last);
    while (!tiles_.empty() && (!continues || tiles_.begin()->first.y < last - 1)) tiles_.erase(tiles_.begin());
  }
  tiles_[tile] = points;
}

void SurfaceMesher::meshRow(int y) {
  std::vector<Tile> row;
  for (const auto& [tile, points] : tiles_)
    if (tile.y == y) row.push_back(tile);
  const double edge = kCubesPerEdge * voxel_;
  std::vector<TilePiece> pieces(row.size());
  urban_nav_core::forEach(row.size(), 1, [&](std::size_t i) {
    DistanceField field(edge);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const auto near = tiles_.find({row[i].x + dx, row[i].y + dy}); near != tiles_.end())
          addIfNear(near->second, row[i], edge, field);
    for (const DistanceField::Value& value : field.values())
      if (isOfTile(value.node, row[i]))
        for (int axis = 0; axis < 3; ++axis) addQuad(field, value, axis, pieces[i]);
  });
  for (const TilePiece& piece : pieces) {
    std::map<Key, std::uint32_t> numbers;
    const auto numberOf = [&](const Key& cell) {
      std::map<Key, std::uint32_t>& known = isAtBorder(cell) ? border_ : numbers;
      const auto [found, is_new] = known.try_emplace(cell, static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (is_new) mesh_.vertices.push_back(piece.vertices.at(cell));
      return found->second;
    };
    for (const std::array<Key, 4>& quad : piece.quads) {
      const std::uint32_t a = numberOf(quad[0]), b = numberOf(quad[1]), c = numberOf(quad[2]), d = numberOf(quad[3]);
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
    }
  }
}

TriangleMesh SurfaceMesher::finish() {
  if (!tiles_.empty()) {
    const int last = tiles_.rbegin()->first.y;
    meshRow(last - 1);
    meshRow(last);
  }
  tiles_.clear();
  border_.clear();
  return std::exchange(mesh_, {});
}

std::string printMeshPly(const TriangleMesh& mesh) {
  using urban_nav_core::PlyType;
  const urban_nav_core::PlyLayout layout{{{"x", PlyType::Float},
                                          {"y", PlyType::Float},
                                          {"z", PlyType::Float},
                                          {"red", PlyType::UChar},
                                          {"green", PlyType::UChar},
                                          {"blue", PlyType::UChar}},
                                         {"surface of the laser map: urban_nav"}};
  std::string bytes = plyHeader(layout, mesh.vertices.size());
  bytes.insert(bytes.rfind("end_header"),
               "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\n");
  bytes.reserve(bytes.size() + 15 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const TriangleMesh::Vertex& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) urban_nav_core::appendLittleEndian(bytes, vertex.p(axis));
    for (const std::uint8_t value : {vertex.red, vertex.green, vertex.blue})
      urban_nav_core::appendLittleEndian(bytes, value);
  }
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    bytes += '\3';
    for (const std::uint32_t vertex : triangle) urban_nav_core::appendLittleEndian(bytes, vertex);
  }
  return bytes;
}

}  // namespace laser_mapper
