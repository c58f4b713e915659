// SPDX-License-Identifier: BSD-3-Clause
// Time per patch: coarse comparison, warp, alignment in the same and in a larger view, stereo alignment with slopes.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "urban_nav_core/image/patch.hpp"

namespace {

using namespace urban_nav_core;

constexpr int kSize = 64;

/// Waves of several lengths, shifted and scaled about the middle.
std::vector<std::uint8_t> picture(double shift, double scale) {
  std::vector<std::uint8_t> pixels;
  for (int v = 0; v < kSize; ++v)
    for (int u = 0; u < kSize; ++u) {
      const double x = (u - 32 - shift) / scale, y = (v - 32) / scale;
      pixels.push_back(static_cast<std::uint8_t>(128.0 + 35.0 * std::sin(0.9 * x + 0.3 * y) +
                                                 30.0 * std::sin(0.5 * y - 0.2 * x) +
                                                 25.0 * std::sin(0.35 * x + 1.1 * y)));
    }
  return pixels;
}

ImageView view(const std::vector<std::uint8_t>& pixels) { return {pixels.data(), kSize, kSize, kSize}; }

void meanRemovedSadOfAPatch(benchmark::State& state) {
  const auto pixels = picture(0.0, 1.0);
  const SadPatch patch = sadPatch(view(pixels), 30, 30);
  int u = 20;
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(meanRemovedSad(patch, view(pixels), u, 31));
    u = 20 + (u + 1) % 20;
  }
}
BENCHMARK(meanRemovedSadOfAPatch);

void rowOfSads(benchmark::State& state) {
  const auto pixels = picture(0.0, 1.0);
  const SadPatch patch = sadPatch(view(pixels), 30, 30);
  int sads[48];
  while (state.KeepRunning()) {
    meanRemovedSads(patch, view(pixels), 6, 31, 48, sads);
    benchmark::DoNotOptimize(sads[0]);
  }
}
BENCHMARK(rowOfSads);

void warp(benchmark::State& state) {
  const auto pixels = picture(0.0, 1.0);
  const auto source = *cutSource(view(pixels), 32, 32);
  const Eigen::Matrix2d A = 0.01 * static_cast<double>(state.range(0)) * Eigen::Matrix2d::Identity();
  PatchTemplate made;
  while (state.KeepRunning()) benchmark::DoNotOptimize(warpTemplate(source, A, made));
}
BENCHMARK(warp)->Arg(80)->Arg(100)->Arg(130);

void align(benchmark::State& state) {
  const double scale = 0.01 * static_cast<double>(state.range(0));
  const auto first = picture(0.0, 1.0), second = picture(0.4, scale);
  PatchTemplate made;
  warpTemplate(*cutSource(view(first), 32, 32), Eigen::Matrix2d(scale * Eigen::Matrix2d::Identity()), made);
  while (state.KeepRunning()) benchmark::DoNotOptimize(alignPatch(view(second), made, {32.0, 32.0}));
}
BENCHMARK(align)->Arg(100)->Arg(130);

void across(benchmark::State& state) {
  const auto left = picture(0.0, 1.0), right = picture(-2.4, 1.0);
  const auto source = *cutSource(view(left), 32, 32);
  PatchTemplate made;
  while (state.KeepRunning()) benchmark::DoNotOptimize(alignAcross(view(right), source, {30.0, 32.0}, 0.05, made));
}
BENCHMARK(across);

}  // namespace

BENCHMARK_MAIN();
