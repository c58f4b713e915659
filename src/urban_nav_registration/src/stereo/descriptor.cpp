// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/stereo/descriptor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace urban_nav_registration {

using urban_nav_core::ImageView;
using urban_nav_core::Pyramid;

namespace {

constexpr int kGrid = 16, kParts = 4, kDirections = 8;
constexpr float kLargestElement = 0.2F;  // Lowe 2004, section 6.1: limits the effect of single edges under different
                                         // light
constexpr float kLeastContrast = 1.0F;   // grey levels per step, mean over the window
constexpr float kRatio = 0.9F;           // best over second best distance

constexpr int kWideGrid = kGrid + 2;  // one more on each side for the gradient

/// Sampling positions of a row or a column of the grid: pixel and share of the next one.
struct Places {
  std::array<int, kWideGrid> at;
  std::array<float, kWideGrid> share;
  Places(double middle, double step, int size) {
    for (std::size_t i = 0; i < kWideGrid; ++i) {
      const double x = std::clamp(middle + (static_cast<double>(i) - 0.5 * (kWideGrid - 1)) * step, 0.0, size - 1.001);
      at[i] = static_cast<int>(x);
      share[i] = static_cast<float>(x - at[i]);
    }
  }
};

using DescriptorGrid = std::array<float, kGrid * kGrid>;

/// Converts directions of gradients to positions in the histogram, 0...`kDirections`, to 1e-4 of a bin (Abramowitz and
/// Stegun 1964, 4.4.49): the library function would take a third of a descriptor's time.
void computeDirections(const DescriptorGrid& dx, const DescriptorGrid& dy, DescriptorGrid& place) {
  for (std::size_t i = 0; i < place.size(); ++i) {
    const float x = std::abs(dx[i]), y = std::abs(dy[i]);
    const float large = std::max(x, y), small = std::min(x, y);
    const float a = small / std::max(large, 1e-20F), a2 = a * a;
    float turn = a * (0.9998660F + a2 * (-0.3302995F + a2 * (0.1801410F + a2 * (-0.0851330F + a2 * 0.0208351F))));
    constexpr float kPi = 3.14159265F;
    turn = y > x ? 0.5F * kPi - turn : turn;
    turn = dx[i] < 0.0F ? kPi - turn : turn;
    turn = dy[i] < 0.0F ? -turn : turn;
    place[i] = (turn + kPi) * (kDirections / (2.0F * kPi));
  }
}

/// The two parts of the window to which a row or a column of the grid contributes, and the share of the second.
struct Shares {
  std::array<int, kGrid> part{};
  std::array<float, kGrid> second{};
  Shares() {
    for (std::size_t i = 0; i < kGrid; ++i) {
      constexpr float kPerPart = static_cast<float>(kParts) / kGrid;
      const float x = (static_cast<float>(i) + 0.5F) * kPerPart + 0.5F;
      part[i] = static_cast<int>(x);
      second[i] = x - static_cast<float>(part[i]);
    }
  }
};

struct Weights {
  DescriptorGrid value{};
  Weights() {
    for (int j = 0; j < kGrid; ++j)
      for (int i = 0; i < kGrid; ++i) {
        const double x = i - 0.5 * (kGrid - 1), y = j - 0.5 * (kGrid - 1);
        // sigma of half the window (Lowe 2004, section 6.1)
        value[static_cast<std::size_t>(j * kGrid + i)] =
            static_cast<float>(std::exp(-(x * x + y * y) / (2.0 * 0.25 * kGrid * kGrid)));
      }
  }
};

/// Returns grey values at a square grid of points, `step` px apart, around `middle`, by bilinear interpolation.
std::array<float, kWideGrid * kWideGrid> sampleWindow(const ImageView& image, const Eigen::Vector2d& middle,
                                                      double step) {
  const Places columns(middle.x(), step, image.width), rows(middle.y(), step, image.height);
  std::array<float, kWideGrid * kWideGrid> grey;
  for (std::size_t j = 0; j < kWideGrid; ++j) {
    const std::uint8_t *above = image.row(rows.at[j]), *below = above + image.stride;
    for (std::size_t i = 0; i < kWideGrid; ++i) {
      const std::uint8_t *p = above + columns.at[i], *q = below + columns.at[i];
      const float top = static_cast<float>(p[0]) + columns.share[i] * static_cast<float>(p[1] - p[0]);
      const float bottom = static_cast<float>(q[0]) + columns.share[i] * static_cast<float>(q[1] - q[0]);
      grey[j * kWideGrid + i] = top + rows.share[j] * (bottom - top);
    }
  }
  return grey;
}

/// Returns the histograms of gradient directions, weighted by magnitude, for each part of the window.
Eigen::Matrix<float, kDescriptorSize, 1> histograms(const DescriptorGrid& size, const DescriptorGrid& place) {
  static const Weights weights;
  static const Shares shares;
  Eigen::Matrix<float, kDescriptorSize, 1> result;
  // Histograms with a margin of a part on each side, for shares beyond the window.
  std::array<float, (kParts + 2) * (kParts + 2) * kDirections> bins{};
  for (std::size_t j = 0; j < kGrid; ++j)
    for (std::size_t i = 0; i < kGrid; ++i) {
      const std::size_t k = j * kGrid + i;
      const int o = std::min(static_cast<int>(place[k]), kDirections), first = o % kDirections,
                next = (o + 1) % kDirections;
      const float fo = place[k] - static_cast<float>(o), w = size[k] * weights.value[k];
      const float fx = shares.second[i], fy = shares.second[j];
      float* bin = &bins[static_cast<std::size_t>((shares.part[j] * (kParts + 2) + shares.part[i]) * kDirections)];
      constexpr int kBelow = (kParts + 2) * kDirections;
      const auto add = [&](int at, float share) {
        bin[at + first] += share * (1.0F - fo);
        bin[at + next] += share * fo;
      };
      add(0, w * (1.0F - fx) * (1.0F - fy));
      add(kDirections, w * fx * (1.0F - fy));
      add(kBelow, w * (1.0F - fx) * fy);
      add(kBelow + kDirections, w * fx * fy);
    }
  for (int j = 0; j < kParts; ++j)
    for (int i = 0; i < kParts; ++i)
      for (int o = 0; o < kDirections; ++o)
        result[(j * kParts + i) * kDirections + o] =
            bins[static_cast<std::size_t>(((j + 1) * (kParts + 2) + i + 1) * kDirections + o)];
  return result;
}

}  // namespace

Eigen::Matrix<float, kDescriptorSize, 1> describe(const Pyramid& pyramid, const Eigen::Vector2d& centre,
                                                  double window) {
  Eigen::Matrix<float, kDescriptorSize, 1> result = Eigen::Matrix<float, kDescriptorSize, 1>::Zero();
  const int level = std::clamp(static_cast<int>(std::floor(std::log2(window / kGrid))), 0, pyramid.levels() - 1);
  const ImageView& image = pyramid.level(level);
  const double scale = Pyramid::scale(level);
  const std::array<float, kWideGrid* kWideGrid> grey = sampleWindow(image, centre * scale, window / kGrid * scale);
  DescriptorGrid dx, dy, size, place;
  float contrast = 0.0F;
  for (std::size_t j = 0; j < kGrid; ++j)
    for (std::size_t i = 0; i < kGrid; ++i) {
      const float* p = &grey[(j + 1) * kWideGrid + i + 1];
      const std::size_t k = j * kGrid + i;
      dx[k] = 0.5F * (p[1] - p[-1]);
      dy[k] = 0.5F * (p[kWideGrid] - p[-kWideGrid]);
      size[k] = std::sqrt(dx[k] * dx[k] + dy[k] * dy[k]);
      contrast += size[k];
    }
  if (!(contrast > kLeastContrast * kGrid * kGrid)) return result;
  computeDirections(dx, dy, place);

  result = histograms(size, place);
  result /= result.norm();
  result = result.cwiseMin(kLargestElement);
  result /= result.norm();
  return result;
}

namespace {

struct Nearest {
  int which = -1;
  float best = -1.0F, second = -1.0F;  // products of unit vectors: larger is nearer
  void see(int i, float product) {
    if (product > best) {
      second = best;
      best = product;
      which = i;
    } else {
      second = std::max(second, product);
    }
  }
  bool isClear() const { return which >= 0 && 1.0F - best < kRatio * kRatio * (1.0F - second); }
};

}  // namespace

std::vector<DescriptorMatch> mutualNearest(const Descriptors& a, const Descriptors& b) {
  if (a.cols() == 0 || b.cols() == 0) return {};
  const Eigen::MatrixXf products = a.transpose() * b;
  return mutualNearest(products);
}

std::vector<DescriptorMatch> mutualNearest(const Eigen::MatrixXf& products) {
  std::vector<DescriptorMatch> pairs;
  std::vector<Nearest> of_a(static_cast<std::size_t>(products.rows())), of_b(static_cast<std::size_t>(products.cols()));
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

}  // namespace urban_nav_registration
