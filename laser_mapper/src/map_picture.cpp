// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace laser_mapper {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

namespace {

constexpr float kPaper = 250.0F;
constexpr float kPathBlue = 40.0F, kPathGreen = 40.0F, kPathRed = 220.0F;
constexpr double kPointEdge = 0.06;   // m, size of a point in perspective
constexpr int kLargestSplat = 4;      // px
constexpr double kBeyondSide = 1e-3;  // share of the drawn pixels beyond a side
constexpr int kPictureEdge = 12;      // px

/// First and last pixel.
struct Interval {
  int first = 0, last = 0;
  void add(int pixel) {
    first = std::min(first, pixel);
    last = std::max(last, pixel);
  }
  void widen(int edge, int size) {
    first = std::max(0, first - edge);
    last = std::min(size - 1, last + edge);
  }
};

/// Returns the interval with at most `beyond` drawn pixels on either side; everything if nothing was drawn.
Interval trimmedEnds(const std::vector<std::size_t>& drawn, std::size_t beyond) {
  Interval ends{0, static_cast<int>(drawn.size()) - 1};
  std::size_t before = 0, after = 0;
  while (ends.first < ends.last && (before += drawn[static_cast<std::size_t>(ends.first)]) <= beyond) ++ends.first;
  while (ends.first < ends.last && (after += drawn[static_cast<std::size_t>(ends.last)]) <= beyond) --ends.last;
  return ends.first < ends.last ? ends : Interval{0, static_cast<int>(drawn.size()) - 1};
}

struct Box {
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  void add(const Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
};

Box boxAround(const std::vector<Vector3d>& path) {
  Box box;
  for (const Vector3d& p : path) box.add(p);
  if (path.empty()) box.low = box.high = Vector3d::Zero();
  return box;
}

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)); }

/// Lighting from above and from the side, so that walls of different directions differ.
float lightOn(const MapPoint& point) {
  if (point.normal.squaredNorm() < 0.5F) return 0.8F;
  const Eigen::Vector3f light = Eigen::Vector3f(0.35F, -0.5F, 0.8F).normalized();
  return 0.62F + 0.38F * std::max(0.0F, point.normal.dot(light));
}

}  // namespace

MapView viewFromAbove(const std::vector<Vector3d>& path, double margin, int longest) {
  const Box box = boxAround(path);
  const Vector3d size = box.high - box.low + Vector3d::Constant(2.0 * margin), centre = 0.5 * (box.low + box.high);
  MapView view;
  view.px_per_m = std::min(20.0, longest / std::max(size.x(), size.y()));
  view.width = std::max(1, static_cast<int>(std::ceil(size.x() * view.px_per_m)));
  view.height = std::max(1, static_cast<int>(std::ceil(size.y() * view.px_per_m)));
  Matrix3d R;
  R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const Vector3d eye(centre.x(), centre.y(), box.high.z() + 1000.0);
  view.T_camera_map = Pose(R, -(R * eye));
  return view;
}

MapView viewInPerspective(const std::vector<Vector3d>& path, int width, int height) {
  const Box box = boxAround(path);
  const Vector3d centre = 0.5 * (box.low + box.high);
  const double radius = 0.5 * (box.high - box.low).norm() + 15.0;
  MapView view;
  view.width = width;
  view.height = height;
  view.focal_px = 0.9 * width;
  const Vector3d eye = centre + 1.25 * radius * Vector3d(-0.55, -0.75, 0.55);
  const Vector3d forward = (centre - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Matrix3d R;
  R.row(0) = right.transpose();
  R.row(1) = forward.cross(right).transpose();
  R.row(2) = forward.transpose();
  view.T_camera_map = Pose(R, -(R * eye));
  return view;
}

MapPicture::MapPicture(const MapView& view)
    : view_(view),
      R_(view.T_camera_map.R()),
      pixels_(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height)),
      path_(pixels_.size(), 0) {}

bool MapPicture::project(const Vector3d& p, double& u, double& v, double& depth) const {
  const Vector3d q = R_ * p + view_.T_camera_map.t();
  depth = q.z();
  if (!(depth > view_.near && depth < view_.far)) return false;
  const double scale = view_.focal_px > 0.0 ? view_.focal_px / depth : view_.px_per_m;
  u = 0.5 * view_.width + scale * q.x();
  v = 0.5 * view_.height + scale * q.y();
  return u > -10.0 && v > -10.0 && u < view_.width + 10.0 && v < view_.height + 10.0;
}

void MapPicture::put(int u, int v, const Pixel& pixel) {
  if (u < 0 || v < 0 || u >= view_.width || v >= view_.height) return;
  Pixel& at =
      pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(u)];
  if (at.depth == 0.0F || pixel.depth < at.depth) at = pixel;
}

void MapPicture::draw(const std::vector<MapPoint>& points) {
  for (const MapPoint& point : points) {
    double u = 0.0, v = 0.0, depth = 0.0;
    if (!project(point.p.cast<double>(), u, v, depth)) continue;
    const float light = lightOn(point);
    const Pixel pixel{static_cast<float>(depth), light * point.blue, light * point.green, light * point.red};
    const double edge = kPointEdge * (view_.focal_px > 0.0 ? view_.focal_px / depth : view_.px_per_m);
    const int size = std::clamp(static_cast<int>(std::lround(edge)), 1, kLargestSplat);
    const int u0 = static_cast<int>(std::floor(u)) - size / 2, v0 = static_cast<int>(std::floor(v)) - size / 2;
    for (int dv = 0; dv < size; ++dv)
      for (int du = 0; du < size; ++du) put(u0 + du, v0 + dv, pixel);
  }
}

void MapPicture::drawPath(const std::vector<Vector3d>& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double length = (path[i + 1] - path[i]).norm();
    const int steps = std::clamp(static_cast<int>(length / 0.05), 1, 1000);
    for (int step = 0; step < steps; ++step) {
      double u = 0.0, v = 0.0, depth = 0.0;
      if (!project(path[i] + (path[i + 1] - path[i]) * (step / static_cast<double>(steps)), u, v, depth)) continue;
      for (int dv = 0; dv < 2; ++dv)
        for (int du = 0; du < 2; ++du) {
          const int x = static_cast<int>(u) + du, y = static_cast<int>(v) + dv;
          if (x < 0 || y < 0 || x >= view_.width || y >= view_.height) continue;
          path_[static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(x)] = 1;
        }
    }
  }
}

/// Darkens the far side of depth edges (eye-dome lighting, Boucheny 2009), which shows shape without colour.
void MapPicture::shadeEdges(std::vector<Pixel>& pixels) const {
  const std::vector<Pixel> before = pixels;
  for (int v = 1; v + 1 < view_.height; ++v)
    for (int u = 1; u + 1 < view_.width; ++u) {
      const auto at = [&](int x, int y) -> const Pixel& {
        return before[static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) +
                      static_cast<std::size_t>(x)];
      };
      const float depth = at(u, v).depth;
      if (depth == 0.0F) continue;
      float sum = 0.0F;
      for (const auto& [du, dv] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
        const float other = at(u + du, v + dv).depth;
        if (other == 0.0F) continue;
        const float step = view_.focal_px > 0.0 ? std::log2(depth / other) * 60.0F : 0.3F * (depth - other);
        sum += std::clamp(step, 0.0F, 1.0F);
      }
      const float shade = std::exp(-0.35F * sum);
      Pixel& pixel =
          pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(u)];
      pixel.blue *= shade;
      pixel.green *= shade;
      pixel.red *= shade;
    }
}

PictureBox MapPicture::shownBox() const {
  const auto columns = static_cast<std::size_t>(view_.width), rows = static_cast<std::size_t>(view_.height);
  std::vector<std::size_t> by_column(columns, 0), by_row(rows, 0);
  std::size_t all = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_[i].depth == 0.0F) continue;
    ++by_column[i % columns];
    ++by_row[i / columns];
    ++all;
  }
  const auto beyond = static_cast<std::size_t>(kBeyondSide * static_cast<double>(all));
  Interval u = trimmedEnds(by_column, beyond), v = trimmedEnds(by_row, beyond);
  for (std::size_t i = 0; i < path_.size(); ++i) {
    if (path_[i] == 0) continue;
    u.add(static_cast<int>(i % columns));
    v.add(static_cast<int>(i / columns));
  }
  u.widen(kPictureEdge, view_.width);
  v.widen(kPictureEdge, view_.height);
  return {u.first, v.first, u.last - u.first + 1, v.last - v.first + 1};
}

/// Returns the shaded pixels; depth is 0 where nothing was drawn.
std::vector<MapPicture::Pixel> MapPicture::finishedPixels() const {
  std::vector<Pixel> pixels = pixels_;
  for (int v = 1; v + 1 < view_.height; ++v)  // fills a pixel between two others
    for (int u = 1; u + 1 < view_.width; ++u) {
      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(u);
      if (pixels_[i].depth != 0.0F) continue;
      const auto row = static_cast<std::size_t>(view_.width);
      for (const auto& [a, b] : {std::pair(i - 1, i + 1), std::pair(i - row, i + row)})
        if (pixels_[a].depth != 0.0F && pixels_[b].depth != 0.0F) {
          pixels[i] = pixels_[a].depth < pixels_[b].depth ? pixels_[b] : pixels_[a];
          break;
        }
    }
  shadeEdges(pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (path_[i] != 0) pixels[i] = {1.0F, kPathBlue, kPathGreen, kPathRed};
    else if (pixels[i].depth == 0.0F) pixels[i] = {0.0F, kPaper, kPaper, kPaper};
  }
  return pixels;
}

urban_nav_registration::Picture MapPicture::finish(const PictureBox& box) const {
  const std::vector<Pixel> pixels = finishedPixels();
  urban_nav_registration::Picture picture;
  picture.width = box.width;
  picture.height = box.height;
  picture.bgr.reserve(3 * static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  for (int v = box.v0; v < box.v0 + box.height; ++v)
    for (int u = box.u0; u < box.u0 + box.width; ++u) {
      const Pixel& pixel =
          pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(u)];
      for (const float value : {pixel.blue, pixel.green, pixel.red}) picture.bgr.push_back(toByte(value));
    }
  return picture;
}

std::vector<std::uint8_t> MapPicture::finishRgba(const PictureBox& box) const {
  const std::vector<Pixel> pixels = finishedPixels();
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height));
  for (int v = box.v0; v < box.v0 + box.height; ++v)
    for (int u = box.u0; u < box.u0 + box.width; ++u) {
      const Pixel& pixel =
          pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(u)];
      const bool is_drawn = pixel.depth != 0.0F;
      for (const float value : {pixel.red, pixel.green, pixel.blue}) rgba.push_back(is_drawn ? toByte(value) : 0);
      rgba.push_back(is_drawn ? 255 : 0);
    }
  return rgba;
}

}  // namespace laser_mapper
