// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_viewer.hpp"

#include <algorithm>
#include <cmath>

#include "base/page.hpp"
#include "base/web_files.hpp"
#include "topics/lasers/report_tiles.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using laser_mapper::MapPoint;
using urban_nav_core::Vector3d;

namespace {

constexpr double kSteps16 = 65535.0;
constexpr float kSigmaByte = 0.5e-3F;         // m
constexpr float kDisplacementByte = 0.5e-3F;  // m

/// Ranges of the values stored as 16-bit integers in the page.
struct ViewerBox {
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  urban_nav_core::StampNs first = 0, last = 0;
};

ViewerBox boxAroundPoints(const std::vector<MapPoint>& points) {
  ViewerBox box;
  box.first = box.last = points.front().stamp;
  for (const MapPoint& point : points) {
    box.low = box.low.cwiseMin(point.p.cast<double>());
    box.high = box.high.cwiseMax(point.p.cast<double>());
    box.first = std::min(box.first, point.stamp);
    box.last = std::max(box.last, point.stamp);
  }
  box.high = box.high.cwiseMax(box.low + Vector3d::Constant(1e-3));
  return box;
}

void append16(std::vector<unsigned char>& bytes, double share) {
  const auto value = static_cast<unsigned>(std::lround(std::clamp(share, 0.0, 1.0) * kSteps16));
  bytes.push_back(static_cast<unsigned char>(value & 255U));
  bytes.push_back(static_cast<unsigned char>(value >> 8U));
}

/// Packs each point: x, y, z and time in 16 bits, then red, green, blue, reflectance, laser, pass, sigma and
/// displacement between passes (255: unknown) in bytes.
std::vector<unsigned char> packPoints(const std::vector<MapPoint>& points, const ViewerBox& box) {
  std::vector<unsigned char> bytes;
  bytes.reserve(16 * points.size());
  const double duration = std::max(1e-9, urban_nav_core::secondsBetween(box.first, box.last));
  for (const MapPoint& point : points) {
    for (int axis = 0; axis < 3; ++axis)
      append16(bytes, (static_cast<double>(point.p(axis)) - box.low(axis)) / (box.high(axis) - box.low(axis)));
    append16(bytes, urban_nav_core::secondsBetween(box.first, point.stamp) / duration);
  }
  for (const MapPoint& point : points) {
    const auto sigma = static_cast<unsigned char>(std::lround(std::clamp(point.sigma / kSigmaByte, 0.0F, 255.0F)));
    const auto pass = static_cast<unsigned char>(point.pass & 255U);
    const auto displacement = static_cast<unsigned char>(
        point.displacement < 0.0F ? 255L : std::lround(std::min(point.displacement / kDisplacementByte, 254.0F)));
    bytes.insert(bytes.end(),
                 {point.red, point.green, point.blue, point.intensity, point.laser, pass, sigma, displacement});
  }
  return bytes;
}

std::string listNumbers(const Vector3d& v) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) text += (axis > 0 ? "," : "") + urban_nav_core::printNumber(v(axis));
  return text;
}

}  // namespace

void MapViewer::add(const std::vector<MapPoint>& points) {
  for (const MapPoint& point : points) points_.add(point);
}

std::string MapViewer::render() const {
  const std::vector<MapPoint>& shown = points_.items();
  if (shown.empty()) return "";
  const ViewerBox box = boxAroundPoints(shown);
  std::string paths;
  for (const std::vector<Vector3d>& path : paths_) {
    paths += paths.empty() ? "[" : ",[";
    for (std::size_t i = 0; i < path.size(); ++i)
      paths += (i > 0 ? "," : "") + listNumbers((path[i] * 1e3).array().round().matrix() * 1e-3);
    paths += "]";
  }
  std::string html = "<div class=\"map-view\" id=\"map-view-" + std::to_string(number_) + "\" data-points=\"" +
                     std::to_string(shown.size()) + "\" data-low=\"" + listNumbers(box.low) + "\" data-high=\"" +
                     listNumbers(box.high) + "\" data-first=\"" + urban_nav_core::printStamp(box.first) +
                     "\" data-seconds=\"" +
                     urban_nav_core::printNumber(urban_nav_core::secondsBetween(box.first, box.last)) +
                     "\" data-paths=\"[" + paths + "]\">";
  html +=
      R"html(<p>Colour <select><option value="pictures">pictures</option><option value="reflectance">reflectance</option>)html"
      R"html(<option value="height">height</option><option value="pass">pass</option><option value="sensor">sensor</option>)html"
      R"html(<option value="sigma">sigma</option><option value="quality">agreement of passes</option></select> <output>drag: turn; shift and drag: move; wheel: zoom</output></p>)html"
      R"html(<canvas tabindex="0" aria-label="Map" style="width:100%;height:min(70vh,40rem);touch-action:none;background:#fafafa"></canvas>)html";
  html += "<script type=\"application/octet-stream\">" + base64(packPoints(shown, box)) + "</script>";
  if (!tiles_.empty())
    html += "<script type=\"application/json\" data-folder=\"" + std::string(kReportTiles) + "\" data-number=\"" +
            std::to_string(number_) + "\">" + tiles_ + "</script>";
  html += "</div>\n";
  // Each view includes the scripts, which initialise the last view on the page so far.
  return html + "<script>" + webFiles({"camera.js", "points.js", "tiles.js", "tile_view.js", "report_map.js"}) +
         "urbanNav.showReportMap([...document.querySelectorAll(\".map-view\")].pop());</script>";
}

}  // namespace urban_nav
