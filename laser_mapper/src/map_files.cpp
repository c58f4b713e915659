// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_files.hpp"

namespace laser_mapper {

using urban_nav_core::appendLittleEndian;
using urban_nav_core::PlyType;

urban_nav_core::PlyLayout mapLayout() {
  urban_nav_core::PlyLayout layout;
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "sigma"})
    layout.properties.push_back({name, PlyType::Float});
  for (const char* name : {"red", "green", "blue", "intensity", "laser"})
    layout.properties.push_back({name, PlyType::UChar});
  layout.properties.push_back({"pass", PlyType::UShort});
  layout.properties.push_back({"stamp", PlyType::Double});
  layout.comments = {"map of urban_nav: frame map, m; stamp in s; laser 0 left, 1 right, 255 stereo"};
  return layout;
}

void appendVertex(std::string& bytes, const MapPoint& point) {
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.p(i));
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.normal(i));
  appendLittleEndian(bytes, point.sigma);
  for (const std::uint8_t value : {point.red, point.green, point.blue, point.intensity, point.laser})
    appendLittleEndian(bytes, value);
  appendLittleEndian(bytes, point.pass);
  appendLittleEndian(bytes, 1e-9 * static_cast<double>(point.stamp));
}

}  // namespace laser_mapper
