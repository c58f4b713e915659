// SPDX-License-Identifier: BSD-3-Clause
#include "stages/labels/labelled_ply.hpp"

#include <algorithm>
#include <fstream>

#include "laser_mapper/map_files.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr std::size_t vertices_at_once = 65536;

/// Reads up to the line end_header; fewer bytes if there is no such line among the first 64.
std::string readHeader(std::istream& file) {
  std::string header, line;
  for (int i = 0; i < 64 && std::getline(file, line); ++i) {
    header += line + "\n";
    if (line == "end_header") break;
  }
  return header;
}

std::string withoutComments(const std::string& header) {
  std::string kept;
  urban_nav_core::forEachLine(header, [&](std::string_view line, int) {
    if (line.substr(0, 7) != "comment") kept += std::string(line) + "\n";
  });
  return kept;
}

void appendPointLabel(std::string& bytes, const scene_labeler::PointLabel& label) {
  urban_nav_core::appendLittleEndian(bytes, static_cast<std::uint8_t>(label.label));
  urban_nav_core::appendLittleEndian(bytes, static_cast<float>(label.probability) / 255.0F);
  urban_nav_core::appendLittleEndian(bytes, static_cast<std::uint8_t>(label.is_unsure ? 1 : 0));
}

}  // namespace

void addLabelsToPly(const std::string& path, const std::vector<scene_labeler::PointLabel>& labels) {
  using urban_nav_core::PlyType;
  urban_nav_core::PlyLayout layout = laser_mapper::mapLayout();
  const std::size_t vertex = layout.vertexBytes();
  std::ifstream file(path, std::ios::binary);
  if (withoutComments(readHeader(file)) != withoutComments(urban_nav_core::plyHeader(layout, labels.size())))
    throw urban_nav_core::DataError(path, "is not the map of this run", "map.ply of stage lasers");
  layout.properties.push_back({"label", PlyType::UChar});
  layout.properties.push_back({"label_probability", PlyType::Float});
  layout.properties.push_back({"unsure", PlyType::UChar});
  layout.comments.emplace_back(
      "label 0 other, 1 grass, 2 paved, 3 dirt_path, 4 textured_wall, 5 smooth_wall, 6 foliage, 7 vehicle, 8 wall, 255 "
      "none");
  urban_nav_core::PlyWriter writer(path, layout);
  for (std::size_t begin = 0; begin < labels.size(); begin += vertices_at_once) {
    const std::size_t count = std::min(vertices_at_once, labels.size() - begin);
    std::string block(count * vertex, '\0'), made;
    if (!file.read(block.data(), static_cast<std::streamsize>(block.size())))
      throw urban_nav_core::DataError(path, "ends too early", "a whole map.ply");
    for (std::size_t i = 0; i < count; ++i) {
      made.append(block, i * vertex, vertex);
      appendPointLabel(made, labels[begin + i]);
    }
    writer.append(made);
  }
  writer.commit();
}

}  // namespace urban_nav
