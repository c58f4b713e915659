// SPDX-License-Identifier: BSD-3-Clause Pyramid, FAST and Harris (1241x376) and the remap (752x376) beside OpenCV's, on
// one core, with the texture of a street.
#include <benchmark/benchmark.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/image/corner_grid.hpp"
#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/image/harris.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace {

using namespace urban_nav_core;

constexpr int kLevels = 3;

/// Noise of several scales, smooth in places, with sharp edges: some 2 % of the pixels are corners at threshold 12.
cv::Mat image() {
  cv::setNumThreads(1);
  cv::Mat sum(376, 1241, CV_32F, cv::Scalar(110.0));
  cv::theRNG().state = 7;
  for (const double sigma : {1.5, 3.0, 6.0, 20.0}) {
    cv::Mat octave(sum.size(), CV_32F);
    cv::randn(octave, 0.0, 1.0);
    cv::GaussianBlur(octave, octave, cv::Size(), sigma);
    sum += octave * (14.0 * sigma);
  }
  for (int i = 0; i < 60; ++i) {
    const cv::Point corner(cv::theRNG().uniform(0, 1200), cv::theRNG().uniform(0, 340));
    cv::rectangle(sum, corner, corner + cv::Point(cv::theRNG().uniform(10, 90), cv::theRNG().uniform(10, 60)),
                  cv::Scalar(cv::theRNG().uniform(20.0, 230.0)), cv::FILLED);
  }
  cv::Mat noise(sum.size(), CV_32F), result;
  cv::randn(noise, 0.0, 2.0);
  cv::Mat(sum + noise).convertTo(result, CV_8U);
  return result;
}

ImageView view(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

void pyramidOurs(benchmark::State& state) {
  const cv::Mat input = image();
  Pyramid pyramid(kLevels);
  while (state.KeepRunning()) {
    pyramid.build(view(input));
    benchmark::DoNotOptimize(pyramid.level(kLevels - 1).data);
  }
}

void pyramidOpenCv(benchmark::State& state) {
  const cv::Mat input = image();
  std::vector<cv::Mat> levels(kLevels);
  while (state.KeepRunning()) {
    input.copyTo(levels[0]);
    for (std::size_t l = 1; l < kLevels; ++l) cv::pyrDown(levels[l - 1], levels[l]);
    benchmark::DoNotOptimize(levels.back().data);
  }
}

void fastOurs(benchmark::State& state) {
  const cv::Mat input = image();
  Pyramid pyramid(kLevels);
  pyramid.build(view(input));
  Fast fast;
  std::size_t corners = 0;
  while (state.KeepRunning()) {
    corners = 0;
    for (int l = 0; l < kLevels; ++l) {
      corners +=
          fast.detect(pyramid.level(l), static_cast<int>(state.range(0)), Fast::Suppression::LocalMaximum).size();
    }
  }
  state.counters["corners"] = static_cast<double>(corners);
}

void fastOpenCv(benchmark::State& state) {
  std::vector<cv::Mat> levels{image()};
  for (int l = 1; l < kLevels; ++l) {
    cv::Mat next;
    cv::pyrDown(levels.back(), next);
    levels.push_back(next);
  }
  std::vector<cv::KeyPoint> found;
  std::size_t corners = 0;
  while (state.KeepRunning()) {
    corners = 0;
    for (const cv::Mat& level : levels) {
      cv::FAST(level, found, static_cast<int>(state.range(0)), true);
      corners += found.size();
    }
  }
  state.counters["corners"] = static_cast<double>(corners);
}

void cornersWithHarris(benchmark::State& state) {
  const cv::Mat input = image();
  Pyramid pyramid(kLevels);
  pyramid.build(view(input));
  Fast fast;
  CornerCap cap(CornerQuota{});
  CornerGrid grid;
  std::vector<Corner> corners;
  std::size_t kept = 0;
  while (state.KeepRunning()) {
    kept = 0;
    for (int l = 0; l < kLevels; ++l) {
      const ImageView& level = pyramid.level(l);
      corners = fast.detect(level, static_cast<int>(state.range(0)), Fast::Suppression::LocalMaximum);
      cap.apply(corners, level.width, level.height);
      for (const Corner& corner : corners) {
        const bool is_inside = corner.u >= kHarrisMargin && corner.v >= kHarrisMargin &&
                               corner.u < level.width - kHarrisMargin && corner.v < level.height - kHarrisMargin;
        if (is_inside) benchmark::DoNotOptimize(structureTensor(level, corner.u, corner.v).harris());
      }
      grid.assign(corners, level.width, level.height);
      kept += grid.size();
    }
  }
  state.counters["corners"] = static_cast<double>(kept);
}

void harrisOpenCv(benchmark::State& state) {
  const cv::Mat input = image();
  cv::Mat response;
  while (state.KeepRunning()) {
    cv::cornerHarris(input, response, 7, 3, kHarrisK);
    benchmark::DoNotOptimize(response.data);
  }
}

/// A raw camera like EuRoC's, 752x480.
RawCamera rawCamera() {
  return {{458.654, 457.296, 367.215, 248.375, 752, 480},
          Distortion({-0.283, 0.074, 0.0002, 0.00002, 0.0, 0.0, 0.0, 0.0})};
}

void remapOurs(benchmark::State& state) {
  const cv::Mat input = image()(cv::Rect(0, 0, 752, 376)).clone();
  RawCamera camera = rawCamera();
  camera.pinhole.height = input.rows;
  const RectifyMap map(camera, Matrix3d::Identity(), camera.pinhole);
  std::vector<std::uint8_t> out;
  while (state.KeepRunning()) benchmark::DoNotOptimize(map.remap(view(input), out).data);
}

void remapOpenCv(benchmark::State& state) {
  const cv::Mat input = image()(cv::Rect(0, 0, 752, 376)).clone();
  const Pinhole p = rawCamera().pinhole;
  const cv::Matx33d K(p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1);
  const auto& k = rawCamera().distortion.coefficients();
  cv::Mat map1, map2, out;
  cv::initUndistortRectifyMap(K, std::vector<double>(k.begin(), k.end()), cv::noArray(), K, input.size(), CV_16SC2,
                              map1, map2);
  while (state.KeepRunning()) {
    cv::remap(input, out, map1, map2, cv::INTER_LINEAR);
    benchmark::DoNotOptimize(out.data);
  }
}

}  // namespace

BENCHMARK(pyramidOurs)->Unit(benchmark::kMicrosecond);
BENCHMARK(pyramidOpenCv)->Unit(benchmark::kMicrosecond);
BENCHMARK(fastOurs)->Arg(5)->Arg(12)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK(fastOpenCv)->Arg(5)->Arg(12)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK(cornersWithHarris)->Arg(5)->Arg(12)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK(harrisOpenCv)->Unit(benchmark::kMicrosecond);
BENCHMARK(remapOurs)->Unit(benchmark::kMicrosecond);
BENCHMARK(remapOpenCv)->Unit(benchmark::kMicrosecond);
BENCHMARK_MAIN();
