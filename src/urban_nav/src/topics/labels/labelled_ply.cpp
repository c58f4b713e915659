// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labelled_ply.hpp"

#include <algorithm>
#include <fstream>

#include "laser_mapper/map_files.hpp"
#include "topics/labels/labelled_map.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr std::size_t kVerticesAtOnce = 65536;

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

/// Returns labelledMapLayout() with the comments of an unlabelled file prepended.
urban_nav_core::PlyLayout labelledLike(const std::string& header) {
  const std::string prefix = "comment ";
  const std::size_t own = laser_mapper::mapLayout().comments.size();
  urban_nav_core::PlyLayout layout = labelledMapLayout();
  std::vector<std::string> comments;
  urban_nav_core::forEachLine(header, [&](std::string_view line, int) {
    if (line.substr(0, prefix.size()) == prefix) comments.emplace_back(line.substr(prefix.size()));
  });
  comments.insert(comments.end(), layout.comments.begin() + static_cast<std::ptrdiff_t>(own), layout.comments.end());
  layout.comments = std::move(comments);
  return layout;
}

}  // namespace

void addLabelsToPly(const std::string& path, const std::vector<scene_labeler::PointLabel>& labels) {
  const urban_nav_core::PlyLayout layout = laser_mapper::mapLayout();
  const std::size_t vertex = layout.vertexBytes();
  std::ifstream file(path, std::ios::binary);
  const std::string header = readHeader(file);
  if (withoutComments(header) != withoutComments(urban_nav_core::plyHeader(layout, labels.size())))
    throw urban_nav_core::DataError(path, "is not the map of this run", "map.ply of stage lasers");
  urban_nav_core::PlyWriter writer(path, labelledLike(header));
  for (std::size_t begin = 0; begin < labels.size(); begin += kVerticesAtOnce) {
    const std::size_t count = std::min(kVerticesAtOnce, labels.size() - begin);
    std::string block(count * vertex, '\0'), made;
    if (!file.read(block.data(), static_cast<std::streamsize>(block.size())))
      throw urban_nav_core::DataError(path, "is incomplete", "a complete map.ply");
    for (std::size_t i = 0; i < count; ++i) {
      made.append(block, i * vertex, vertex);
      appendPointLabel(made, labels[begin + i]);
    }
    writer.append(made);
  }
  writer.commit();
}

}  // namespace urban_nav
