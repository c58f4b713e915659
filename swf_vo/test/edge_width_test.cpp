// SPDX-License-Identifier: BSD-3-Clause
#include "edge_width.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace swf_vo {
namespace {

using urban_nav_core::ImageView;

constexpr int kEdgeImageWidth = 400, kEdgeImageHeight = 300;

/// Edges of all contrasts every `apart` pixels along both axes, with a Gaussian blur.
std::vector<std::uint8_t> edges(double sigma_x, double sigma_y, double contrast = 100.0, double noise = 1.0,
                                double apart = 40.0) {
  std::mt19937 seed(1);
  std::normal_distribution<double> grey(0.0, noise);
  const auto edge = [&](double x, double sigma) {
    const double phase = x / apart - std::floor(x / apart) - 0.5;
    return 0.5 * std::erf(phase * apart / (std::sqrt(2.0) * sigma)) - phase;
  };
  std::vector<std::uint8_t> pixels(kEdgeImageWidth * kEdgeImageHeight);
  for (int v = 0; v < kEdgeImageHeight; ++v)
    for (int u = 0; u < kEdgeImageWidth; ++u)
      pixels[static_cast<std::size_t>(v * kEdgeImageWidth + u)] = static_cast<std::uint8_t>(std::clamp(
          128.0 + contrast * (edge(u + 0.3 * v, sigma_x) + edge(v + 0.3 * u, sigma_y)) + grey(seed), 0.0, 255.0));
  return pixels;
}

Eigen::Vector2d of(const std::vector<std::uint8_t>& pixels) {
  return edgeVariance({pixels.data(), kEdgeImageWidth, kEdgeImageHeight, kEdgeImageWidth});
}

// The effect is largest for equal straight edges, which have no curvature at their steepest positions.
TEST(EdgeVariance, GrowsByWhatTheLensAdds) {
  for (const double sigma : {1.5, 2.0, 3.0}) {
    const Eigen::Vector2d seen = of(edges(sigma, sigma));
    EXPECT_GT(seen.minCoeff(), 0.5 * sigma * sigma) << sigma;
    EXPECT_LT(seen.maxCoeff(), 3.0 * sigma * sigma) << sigma;
  }
  EXPECT_LT(of(edges(0.5, 0.5)).maxCoeff(), 1.0);
}

TEST(EdgeVariance, IsIndependentOfContrastAndSmoothAreas) {
  const Eigen::Vector2d usual = of(edges(0.5, 0.5));
  EXPECT_TRUE(widening(of(edges(0.5, 0.5, 30.0)), usual).isZero());
  EXPECT_TRUE(widening(of(edges(0.5, 0.5, 100.0, 1.0, 90.0)), usual).isZero()) << "smooth walls are not blurred";
  EXPECT_TRUE(widening(of(edges(0.5, 0.5, 100.0, 6.0)), usual).isZero()) << "nor is noise";
  EXPECT_GT(widening(of(edges(2.0, 2.0)), usual).minCoeff(), 0.0);
}

TEST(EdgeVariance, OfAnImageWithoutContrastIsNothing) {
  const std::vector<std::uint8_t> flat(kEdgeImageWidth * kEdgeImageHeight, 90);
  EXPECT_TRUE(of(flat).isZero());
  EXPECT_TRUE(edgeVariance({flat.data(), 2, 2, 2}).isZero());
}

TEST(Widening, IsNoneForWhatScenesDifferBy) {
  const Eigen::Vector2d sharp(0.4, 0.4), soft(3.0, 4.0);
  EXPECT_TRUE(widening({0.7, 1.3}, sharp).isZero());
  EXPECT_TRUE(widening({5.0, 7.0}, soft).isZero());
  EXPECT_EQ(widening({0.4, 4.4}, sharp), Eigen::Vector2d(0.0, 4.0));
}

}  // namespace
}  // namespace swf_vo
