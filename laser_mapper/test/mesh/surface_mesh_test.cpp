// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/mesh/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace laser_mapper {
namespace {

using Eigen::Vector3f;

constexpr double kMeshVoxel = 0.05;

/// Points of a sphere seen from outside, about 4 cm apart, by tile.
std::map<Tile, std::vector<MapPoint>> spherePoints(const Vector3f& centre, float radius) {
  std::map<Tile, std::vector<MapPoint>> tiles;
  const int count = static_cast<int>(4.0F * static_cast<float>(M_PI) * radius * radius / (0.04F * 0.04F));
  for (int i = 0; i < count; ++i) {  // spiral of equal areas
    const double z = 1.0 - 2.0 * (i + 0.5) / count, angle = i * M_PI * (3.0 - std::sqrt(5.0));
    const double around = std::sqrt(1.0 - z * z);
    MapPoint point;
    point.normal = Eigen::Vector3d(around * std::cos(angle), around * std::sin(angle), z).cast<float>();
    point.p = centre + radius * point.normal;
    point.red = 200;
    point.green = point.p.z() > centre.z() ? 100 : 0;
    const auto part = [](float value) {
      return static_cast<int>(std::floor(static_cast<double>(value) / (kMeshVoxel * kTileCells)));
    };
    tiles[{part(point.p.x()), part(point.p.y())}].push_back(point);
  }
  return tiles;
}

TriangleMesh meshOf(const std::map<Tile, std::vector<MapPoint>>& tiles) {
  SurfaceMesher mesher(kMeshVoxel);
  for (const auto& [tile, points] : tiles) mesher.add(tile, points);
  return mesher.finish();
}

/// Returns how often each edge occurs, by its vertices in the order of the triangle.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesOf(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  return edges;
}

TEST(SurfaceMesh, ASphereAcrossFourTilesIsClosedAndFacesOutwards) {
  const Vector3f centre(0.3F, -0.2F, 5.0F);  // tiles meet at x = 0 and y = 0
  const TriangleMesh mesh = meshOf(spherePoints(centre, 1.5F));
  ASSERT_GT(mesh.triangles.size(), 3000U);
  const auto edges = edgesOf(mesh);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U)
        << "adjacent triangles traverse the edge in opposite directions";
  }
  const auto euler = static_cast<long>(mesh.vertices.size()) - static_cast<long>(edges.size() / 2) +
                     static_cast<long>(mesh.triangles.size());
  EXPECT_EQ(euler, 2);
  for (const TriangleMesh::Vertex& vertex : mesh.vertices) EXPECT_NEAR((vertex.p - centre).norm(), 1.5F, 0.01F);
  for (const auto& triangle : mesh.triangles) {
    const Vector3f a = mesh.vertices[triangle[0]].p, b = mesh.vertices[triangle[1]].p, c = mesh.vertices[triangle[2]].p;
    EXPECT_GT((b - a).cross(c - a).dot(a - centre), 0.0F);
  }
}

TEST(SurfaceMesh, VerticesHaveTheColourOfThePointsAround) {
  const Vector3f centre(5.0F, 5.0F, 5.0F);
  for (const TriangleMesh::Vertex& vertex : meshOf(spherePoints(centre, 1.0F)).vertices) {
    EXPECT_EQ(vertex.red, 200);
    if (vertex.p.z() > centre.z() + 0.4F) {
      EXPECT_EQ(vertex.green, 100);
    }
    if (vertex.p.z() < centre.z() - 0.4F) {
      EXPECT_EQ(vertex.green, 0);
    }
  }
}

TEST(SurfaceMesh, RowsOfTilesWithAGapBetweenThemAreAllThere) {
  auto tiles = spherePoints(Vector3f(3.0F, 3.0F, 1.0F), 1.0F);
  const std::size_t one = meshOf(tiles).triangles.size();
  for (const auto& [tile, points] : spherePoints(Vector3f(3.0F, 3.0F + 4.0F * 12.8F, 1.0F), 1.0F)) tiles[tile] = points;
  const std::size_t two = meshOf(tiles).triangles.size();
  EXPECT_GT(two, 19 * one / 10);
  EXPECT_LT(two, 21 * one / 10);
}

TEST(SurfaceMesh, PointsWithoutNormalsMakeNoSurface) {
  auto tiles = spherePoints(Vector3f(3.0F, 3.0F, 1.0F), 1.0F);
  for (auto& [tile, points] : tiles)
    for (MapPoint& point : points) point.normal.setZero();
  EXPECT_TRUE(meshOf(tiles).vertices.empty());
}

TEST(SurfaceMesh, TheFileHasAllVerticesAndFaces) {
  const TriangleMesh mesh = meshOf(spherePoints(Vector3f(3.0F, 3.0F, 1.0F), 0.5F));
  const std::string bytes = printMeshPly(mesh);
  const std::size_t header = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.size() - header, 15 * mesh.vertices.size() + 13 * mesh.triangles.size());
  EXPECT_NE(bytes.find("element vertex " + std::to_string(mesh.vertices.size()) + "\n"), std::string::npos);
  EXPECT_NE(bytes.find("element face " + std::to_string(mesh.triangles.size()) +
                       "\nproperty list uchar uint vertex_indices\n"),
            std::string::npos);
}

}  // namespace
}  // namespace laser_mapper
