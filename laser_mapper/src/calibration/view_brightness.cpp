// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/view_brightness.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace laser_mapper {

using urban_nav_core::ImageView;
using urban_nav_core::Pyramid;

namespace {

constexpr double kDarkest = 6.0, kBrightest = 245.0;

double between(const ImageView& image, int u, int v, double fu, double fv) {
  const std::uint8_t *above = image.row(v) + u, *below = image.row(v + 1) + u;
  return (1.0 - fv) * ((1.0 - fu) * above[0] + fu * above[1]) + fv * ((1.0 - fu) * below[0] + fu * below[1]);
}

}  // namespace

std::optional<ViewBrightness> brightnessAt(const Pyramid& pyramid, int level, const Eigen::Vector2d& pixel) {
  if (level >= pyramid.levels()) return std::nullopt;
  const ImageView& image = pyramid.level(level);
  const Eigen::Vector2d at = Pyramid::scale(level) * pixel;
  const int u = static_cast<int>(std::floor(at.x())), v = static_cast<int>(std::floor(at.y()));
  if (u < 1 || v < 1 || u + 2 >= image.width || v + 2 >= image.height) return std::nullopt;
  const double fu = at.x() - u, fv = at.y() - v;
  const double value = between(image, u, v, fu, fv);
  if (!(value > kDarkest && value < kBrightest)) return std::nullopt;
  const Eigen::Vector2d slope(between(image, u + 1, v, fu, fv) - between(image, u - 1, v, fu, fv),
                              between(image, u, v + 1, fu, fv) - between(image, u, v - 1, fu, fv));
  return ViewBrightness{std::log(value), 0.5 * Pyramid::scale(level) / value * slope};
}

Pyramid greyPyramid(const urban_nav_registration::Picture& picture, int levels) {
  std::vector<std::uint8_t> grey(picture.bgr.size() / 3);
  for (std::size_t i = 0; i < grey.size(); ++i)
    grey[i] = static_cast<std::uint8_t>(
        std::lround(0.114 * picture.bgr[3 * i] + 0.587 * picture.bgr[3 * i + 1] + 0.299 * picture.bgr[3 * i + 2]));
  Pyramid pyramid(levels);
  pyramid.build({grey.data(), picture.width, picture.height, picture.width});
  return pyramid;
}

}  // namespace laser_mapper
