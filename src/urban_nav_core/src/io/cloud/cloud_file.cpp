// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_file.hpp"

#include <algorithm>
#include <limits>

#include "formats.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr double kFarthest = 1e9;    // m: larger coordinates are invalid
constexpr double kFarAway = 1000.0;  // m: the resolution of float is 0.06 mm there

bool beginsWith(std::string_view content, std::string_view word) { return content.substr(0, word.size()) == word; }

/// Returns whether the first line that is not a comment belongs to a PCD header: VERSION may be missing, as in PCL.
bool isPcd(std::string_view content) {
  if (beginsWith(content, "# .PCD")) return true;
  for (cloud_formats::HeaderLines lines(content); const auto line = lines.next();) {
    const std::string_view text = trimmed(*line);
    if (text.empty() || text.front() == '#') continue;
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    return word == "VERSION" || word == "FIELDS" || word == "COLUMNS" || word == "SIZE" || word == "WIDTH";
  }
  return false;
}

cloud_formats::Vertices parseVertices(std::string_view content, const std::string& name) {
  if (beginsWith(content, "LASF")) return cloud_formats::parseLas(content, name);
  const std::string text = cloud_formats::decodeContent(content);
  if (!text.empty()) content = text;
  if (beginsWith(content, "ply\n") || beginsWith(content, "ply\r")) return cloud_formats::parsePly(content, name);
  return isPcd(content) ? cloud_formats::parsePcd(content, name) : cloud_formats::parsePoints(content, name);
}

float toFloat(double value) {
  constexpr double kLimit = std::numeric_limits<float>::max();
  if (value > kLimit || value < -kLimit) return std::numeric_limits<float>::infinity();
  return static_cast<float>(value);
}

std::vector<Eigen::Vector3f> relativeTo(const Eigen::Vector3d& offset, const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3f> made;
  made.reserve(points.size());
  for (const Eigen::Vector3d& point : points) made.emplace_back((point - offset).unaryExpr(&toFloat));
  return made;
}

/// Returns the median of the finite points by axis; zero if there are none.
template <class Points>
Eigen::Vector3d medianPoint(const Points& points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const auto& point : points)
      if (point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest)
        values.push_back(static_cast<double>(point[axis]));
    if (values.empty()) continue;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    middle[axis] = *at;
  }
  return middle;
}

}  // namespace

CloudFile readCloud(const std::string& path) { return parseCloud(readBytes(path), path); }

CloudFile parseCloud(std::string_view content, const std::string& name) {
  if (cloud_formats::isGzip(content)) {
    const std::string plain = cloud_formats::gunzip(content, name);
    if (cloud_formats::isGzip(plain)) throw UserError(name, "a gzip file within a gzip file", "PLY, PCD, LAS or CSV");
    return parseCloud(plain, name);
  }
  const cloud_formats::Vertices vertices = parseVertices(content, name);
  CloudFile file;
  const Eigen::Vector3d middle = medianPoint(vertices.points);
  if (middle.cwiseAbs().maxCoeff() > kFarAway) file.offset = middle;
  file.cloud.points = relativeTo(file.offset, vertices.points);
  file.cloud.origins = relativeTo(file.offset, vertices.origins);
  return file;
}

void recentre(CloudFile& file) {
  const Eigen::Vector3d middle = medianPoint(file.cloud.points);
  const Eigen::Vector3f shift = middle.cast<float>();
  for (auto* points : {&file.cloud.points, &file.cloud.origins})
    for (Eigen::Vector3f& point : *points) point -= shift;
  file.offset += middle;
}

}  // namespace urban_nav_core
