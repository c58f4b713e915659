// SPDX-License-Identifier: BSD-3-Clause
#include "texture.hpp"

#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "distribution.hpp"

namespace urban_nav_sim::bench {
namespace {

constexpr int kBlock = 16;                       // px
constexpr double kTextured = 2.5;                // levels a pixel
constexpr int kBurnt = 250;                      // levels
constexpr int kFastThreshold = 20;               // grey levels
constexpr double kFrame = 512 * 384;             // px
constexpr std::size_t kEvery = 61;               // a prime, so that all columns are sampled
constexpr double kBlack = 15.0, kWhite = 240.0;  // levels beyond which noise is clipped

cv::Mat computeGradient(const cv::Mat& image) {
  cv::Mat dx, dy, length;
  cv::Sobel(image, dx, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(image, dy, CV_32F, 0, 1, 3, 1.0 / 8.0);
  cv::magnitude(dx, dy, length);
  return length;
}

double twoOctavesUp(const cv::Mat& levels) {
  cv::Mat half, quarter;
  cv::pyrDown(levels, half);
  cv::pyrDown(half, quarter);
  return cv::mean(computeGradient(quarter))[0] / std::max(cv::mean(computeGradient(levels))[0], 1e-9);
}

/// Returns the means of complete blocks, row by row.
std::vector<double> averageBlocks(const cv::Mat& values) {
  std::vector<double> means;
  for (int v = 0; v + kBlock <= values.rows; v += kBlock) {
    for (int u = 0; u + kBlock <= values.cols; u += kBlock)
      means.push_back(cv::mean(values(cv::Rect(u, v, kBlock, kBlock)))[0]);
  }
  return means;
}

double estimateNoise(const cv::Mat& image) {
  const cv::Matx33f mask(1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::Mat rest;
  cv::filter2D(image, rest, CV_32F, mask);
  const std::vector<double> mean = averageBlocks(image), left = averageBlocks(cv::abs(rest));
  Values seen;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (mean[i] > kBlack && mean[i] < kWhite) seen.push_back(left[i] * std::sqrt(M_PI / 2.0) / 6.0);
  }
  return quantile(seen, 0.1);
}

}  // namespace

Texture measureTexture(const cv::Mat& image) {
  cv::Mat levels;
  image.convertTo(levels, CV_32F);
  const cv::Mat gradient = computeGradient(levels);

  Texture texture;
  const std::vector<double> blocks = averageBlocks(gradient);
  for (const double block : blocks) texture.textured_blocks += block > kTextured ? 1.0 : 0.0;
  texture.textured_blocks /= static_cast<double>(blocks.size());
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image, corners, kFastThreshold);
  texture.corners = static_cast<double>(corners.size()) * kFrame / static_cast<double>(image.total());
  texture.two_octaves_up = twoOctavesUp(levels);
  texture.above = twoOctavesUp(levels.rowRange(0, levels.rows / 2));
  texture.below = twoOctavesUp(levels.rowRange(levels.rows / 2, levels.rows));
  texture.white = static_cast<double>(cv::countNonZero(image >= kBurnt)) / static_cast<double>(image.total());
  texture.noise = estimateNoise(levels);
  const auto* first = gradient.ptr<float>();
  for (std::size_t i = 0; i < gradient.total(); i += kEvery)
    texture.gradients.push_back(std::log2(1.0 + static_cast<double>(first[i])));
  return texture;
}

}  // namespace urban_nav_sim::bench
