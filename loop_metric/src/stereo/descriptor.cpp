// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/descriptor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace loop_metric {

using urban_nav_core::ImageView;
using urban_nav_core::Pyramid;

namespace {

constexpr int grid = 16, parts = 4, directions = 8;
constexpr float largest_element = 0.2F;  // Lowe 2004, section 6.1: so that no single edge under other light decides
constexpr float least_contrast = 1.0F;   // grey levels a step, mean over the window
constexpr float ratio = 0.9F;            // of distances, best over second best

float readAt(const ImageView& image, double x, double y) {
  x = std::clamp(x, 0.0, image.width - 1.001);
  y = std::clamp(y, 0.0, image.height - 1.001);
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const float fx = static_cast<float>(x - u), fy = static_cast<float>(y - v);
  const std::uint8_t *p = image.row(v) + u, *q = p + image.stride;
  const float top = static_cast<float>(p[0]) + fx * static_cast<float>(p[1] - p[0]);
  const float bottom = static_cast<float>(q[0]) + fx * static_cast<float>(q[1] - q[0]);
  return top + fy * (bottom - top);
}

struct Weights {
  std::array<float, grid * grid> value{};
  Weights() {
    for (int j = 0; j < grid; ++j)
      for (int i = 0; i < grid; ++i) {
        const double x = i - 0.5 * (grid - 1), y = j - 0.5 * (grid - 1);
        // sigma of half the window (Lowe 2004, section 6.1)
        value[static_cast<std::size_t>(j * grid + i)] =
            static_cast<float>(std::exp(-(x * x + y * y) / (2.0 * 0.25 * grid * grid)));
      }
  }
};

}  // namespace

Eigen::Matrix<float, descriptor_size, 1> describe(const Pyramid& pyramid, const Eigen::Vector2d& centre,
                                                  double window) {
  static const Weights weights;
  Eigen::Matrix<float, descriptor_size, 1> made = Eigen::Matrix<float, descriptor_size, 1>::Zero();
  const int level = std::clamp(static_cast<int>(std::floor(std::log2(window / grid))), 0, pyramid.levels() - 1);
  const ImageView& image = pyramid.level(level);
  const double scale = Pyramid::scale(level), step = window / grid * scale;
  const Eigen::Vector2d middle = centre * scale;

  constexpr int wide = grid + 2;
  std::array<float, wide * wide> grey;
  for (int j = 0; j < wide; ++j)
    for (int i = 0; i < wide; ++i)
      grey[static_cast<std::size_t>(j * wide + i)] =
          readAt(image, middle.x() + (i - 0.5 * (wide - 1)) * step, middle.y() + (j - 0.5 * (wide - 1)) * step);

  // Histograms with a margin of a part on each side, for what is shared out beyond the window.
  std::array<float, (parts + 2) * (parts + 2) * directions> bins{};
  float contrast = 0.0F;
  for (int j = 0; j < grid; ++j)
    for (int i = 0; i < grid; ++i) {
      const float* p = &grey[static_cast<std::size_t>((j + 1) * wide + i + 1)];
      const float dx = 0.5F * (p[1] - p[-1]), dy = 0.5F * (p[wide] - p[-wide]);
      const float size = std::sqrt(dx * dx + dy * dy);
      contrast += size;
      const float angle = (std::atan2(dy, dx) + 3.14159265F) * (directions / 6.2831853F);
      const int o = static_cast<int>(angle);
      const float fo = angle - static_cast<float>(o);
      constexpr float per_part = static_cast<float>(parts) / grid;
      const float x = (static_cast<float>(i) + 0.5F) * per_part + 0.5F,
                  y = (static_cast<float>(j) + 0.5F) * per_part + 0.5F;
      const int u = static_cast<int>(x), v = static_cast<int>(y);
      const float fx = x - static_cast<float>(u), fy = y - static_cast<float>(v);
      const float w = size * weights.value[static_cast<std::size_t>(j * grid + i)];
      for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) {
          const float share = w * (a == 1 ? fx : 1.0F - fx) * (b == 1 ? fy : 1.0F - fy);
          float* bin = &bins[static_cast<std::size_t>(((v + b) * (parts + 2) + u + a) * directions)];
          bin[o % directions] += share * (1.0F - fo);
          bin[(o + 1) % directions] += share * fo;
        }
    }
  if (!(contrast > least_contrast * grid * grid)) return made;
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i < parts; ++i)
      for (int o = 0; o < directions; ++o)
        made[(j * parts + i) * directions + o] =
            bins[static_cast<std::size_t>(((j + 1) * (parts + 2) + i + 1) * directions + o)];
  made /= made.norm();
  made = made.cwiseMin(largest_element);
  made /= made.norm();
  return made;
}

namespace {

struct Nearest {
  int which = -1;
  float best = -1.0F, second = -1.0F;  // products of unit vectors: the larger the nearer
  void see(int i, float product) {
    if (product > best) {
      second = best;
      best = product;
      which = i;
    } else {
      second = std::max(second, product);
    }
  }
  bool isClear() const { return which >= 0 && 1.0F - best < ratio * ratio * (1.0F - second); }
};

}  // namespace

std::vector<Pair> mutualNearest(const Descriptors& a, const Descriptors& b) {
  std::vector<Pair> pairs;
  if (a.cols() == 0 || b.cols() == 0) return pairs;
  const Eigen::MatrixXf products = a.transpose() * b;
  std::vector<Nearest> of_a(static_cast<std::size_t>(a.cols())), of_b(static_cast<std::size_t>(b.cols()));
  for (Eigen::Index j = 0; j < products.cols(); ++j)
    for (Eigen::Index i = 0; i < products.rows(); ++i) {
      const float product = products(i, j);
      if (!(product > 0.0F)) continue;
      of_a[static_cast<std::size_t>(i)].see(static_cast<int>(j), product);
      of_b[static_cast<std::size_t>(j)].see(static_cast<int>(i), product);
    }
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (!of_a[i].isClear()) continue;
    const auto j = static_cast<std::size_t>(of_a[i].which);
    if (of_b[j].which == static_cast<int>(i) && of_b[j].isClear())
      pairs.push_back({static_cast<int>(i), of_a[i].which});
  }
  return pairs;
}

}  // namespace loop_metric
