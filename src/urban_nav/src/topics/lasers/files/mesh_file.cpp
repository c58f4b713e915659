// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/mesh_file.hpp"

#include "base/json.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav {

void writeMesh(const std::string& path, laser_mapper::TriangleMesh mesh, const MapAxes& axes) {
  if (!axes.areOfMap())
    for (laser_mapper::TriangleMesh::Vertex& vertex : mesh.vertices)
      vertex.p = axes.place(urban_nav_core::Vector3d(vertex.p.cast<double>())).cast<float>();
  urban_nav_core::writeAtomically(path, printMeshPly(mesh));
  if (axes.areOfMap()) return;
  Json offset = Json::array();
  for (int axis = 0; axis < 3; ++axis) offset.append(axes.offset()(axis));
  urban_nav_core::writeAtomically(
      withExtension(path, ".json"),
      Json::object({{"crs", "EPSG:" + std::to_string(axes.crs()->epsg())}, {"offset", std::move(offset)}}).print());
}

}  // namespace urban_nav
