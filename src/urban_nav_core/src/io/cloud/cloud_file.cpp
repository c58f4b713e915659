// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_file.hpp"

#include "formats.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kLargest = std::size_t{4} << 30U;  // bytes of an unpacked file: 200 million points

bool beginsWith(std::string_view content, std::string_view word) { return content.substr(0, word.size()) == word; }

}  // namespace

PointCloud readCloud(const std::string& path) { return parseCloud(readTextFile(path), path); }

PointCloud parseCloud(std::string_view content, const std::string& name) {
  if (cloud_formats::isGzip(content)) {
    const std::string plain = cloud_formats::gunzip(content, name, kLargest);
    if (cloud_formats::isGzip(plain)) throw UserError(name, "a gzip file within a gzip file", "PLY, PCD or CSV");
    return parseCloud(plain, name);
  }
  if (beginsWith(content, "ply\n") || beginsWith(content, "ply\r")) return cloud_formats::parsePly(content, name);
  if (beginsWith(content, "# .PCD") || beginsWith(content, "VERSION")) return cloud_formats::parsePcd(content, name);
  return cloud_formats::parsePoints(content, name);
}

}  // namespace urban_nav_core
