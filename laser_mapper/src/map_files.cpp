// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_files.hpp"

#include <algorithm>

namespace laser_mapper {

using urban_nav_core::appendLittleEndian;
using urban_nav_core::PlyType;

namespace {

std::uint8_t colouredFlag(const MapPoint& point) { return point.is_coloured ? 1 : 0; }

}  // namespace

urban_nav_core::PlyLayout mapLayout(const std::vector<SensorName>& sensors) {
  urban_nav_core::PlyLayout layout;
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "sigma"})
    layout.properties.push_back({name, PlyType::Float});
  for (const char* name : {"red", "green", "blue", "intensity", "laser", "coloured"})
    layout.properties.push_back({name, PlyType::UChar});
  layout.properties.push_back({"pass", PlyType::UShort});
  layout.properties.push_back({"stamp", PlyType::Double});
  layout.comments = {
      "map of urban_nav: frame map, m; stamp in s; laser: id of the sensor; coloured 0: no camera shows it"};
  for (const SensorName& sensor : sensors)
    layout.comments.push_back("sensor " + std::to_string(sensor.id) + " " + sensor.role + " " + sensor.frame);
  return layout;
}

void appendVertex(std::string& bytes, const MapPoint& point) {
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.p(i));
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.normal(i));
  appendLittleEndian(bytes, point.sigma);
  for (const std::uint8_t value :
       {point.red, point.green, point.blue, point.intensity, point.laser, colouredFlag(point)})
    appendLittleEndian(bytes, value);
  appendLittleEndian(bytes, point.pass);
  appendLittleEndian(bytes, 1e-9 * static_cast<double>(point.stamp));
}

std::vector<urban_nav_core::PcdField> mapPcdFields() {
  return {{"x"},
          {"y"},
          {"z"},
          {"normal_x"},
          {"normal_y"},
          {"normal_z"},
          {"sigma"},
          {"rgb", 4, 'U'},
          {"intensity"},
          {"laser", 1, 'U'},
          {"coloured", 1, 'U'},
          {"pass", 2, 'U'},
          {"stamp", 8, 'F'}};
}

void appendPcdPoint(std::string& bytes, const MapPoint& point) {
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.p(i));
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.normal(i));
  appendLittleEndian(bytes, point.sigma);
  appendLittleEndian(bytes, (std::uint32_t{point.red} << 16U) | (std::uint32_t{point.green} << 8U) | point.blue);
  appendLittleEndian(bytes, static_cast<float>(point.intensity));
  appendLittleEndian(bytes, point.laser);
  appendLittleEndian(bytes, colouredFlag(point));
  appendLittleEndian(bytes, point.pass);
  appendLittleEndian(bytes, 1e-9 * static_cast<double>(point.stamp));
}

std::vector<urban_nav_core::LasAttribute> mapLasAttributes() {
  using Type = urban_nav_core::LasAttribute::Type;
  return {{"sigma", Type::Float, "m, of the distance to surface"},
          {"pass", Type::UShort, "stretch of the path"},
          {"laser", Type::UChar, "sensor id, 255 stereo"},
          {"coloured", Type::UChar, "0: no camera shows it"},
          {"nx", Type::Float, "normal"},
          {"ny", Type::Float, "normal"},
          {"nz", Type::Float, "normal"}};
}

urban_nav_core::LasPoint lasPoint(const MapPoint& point) {
  const auto wide = [](std::uint8_t value) { return static_cast<std::uint16_t>(257 * value); };
  urban_nav_core::LasPoint made;
  made.p = point.p.cast<double>();
  made.intensity = wide(point.intensity);
  made.channel = std::min<std::uint8_t>(point.laser, 3);
  made.source = static_cast<std::uint16_t>(std::min(65535, point.pass + 1));
  made.stamp = point.stamp;
  made.red = wide(point.red);
  made.green = wide(point.green);
  made.blue = wide(point.blue);
  return made;
}

void appendLasAttributes(std::string& bytes, const MapPoint& point) {
  appendLittleEndian(bytes, point.sigma);
  appendLittleEndian(bytes, point.pass);
  appendLittleEndian(bytes, point.laser);
  appendLittleEndian(bytes, colouredFlag(point));
  for (int i = 0; i < 3; ++i) appendLittleEndian(bytes, point.normal(i));
}

}  // namespace laser_mapper
