// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/sampled_scans.hpp"

#include <algorithm>
#include <cmath>

#include "laser_mapper/mixed_pixels.hpp"

namespace laser_mapper {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kScanSpacing = 40'000'000, kWindow = 1'000'000'000;
constexpr std::size_t kSampledBeamStep = 2;
constexpr double kFarthest = 20.0;  // m: farther beams are too sparse to determine a plane

void appendScan(const Parameters& parameters, const Scan& scan, std::uint8_t laser, SampledScans& samples) {
  MixedPixelModel model;
  model.range_sigma = static_cast<float>(parameters.range_sigma);
  const std::vector<std::uint8_t> mixed = findMixedPixels(scan, model);
  SampledScans::Scan sampled;
  sampled.middle = scan.beams[scan.beams.size() / 2].stamp;
  sampled.laser = laser;
  sampled.window = static_cast<std::uint32_t>(
      std::clamp(sampled.middle - samples.begin, StampNs{0}, samples.end - samples.begin - 1) / kWindow);
  sampled.first = static_cast<std::uint32_t>(samples.beams.size());
  for (std::size_t i = 0; i < scan.beams.size(); i += kSampledBeamStep) {
    const urban_nav_core::Beam& beam = scan.beams[i];
    const double range = static_cast<double>(beam.range);
    if (mixed[i] != 0 || range < parameters.min_range || range > std::min(parameters.max_range, kFarthest)) continue;
    samples.beams.push_back({beam.range * beam.direction,
                             static_cast<float>(urban_nav_core::secondsBetween(sampled.middle, beam.stamp)),
                             static_cast<std::uint32_t>(samples.scans.size())});
  }
  sampled.last = static_cast<std::uint32_t>(samples.beams.size());
  if (sampled.last > sampled.first) samples.scans.push_back(sampled);
}

}  // namespace

SampledScans sampleScans(const Parameters& parameters, urban_nav_store::Store& store,
                         const urban_nav_store::SessionId& session, const std::vector<MountedLaser>& lasers,
                         StampNs begin, StampNs end) {
  SampledScans samples;
  samples.begin = begin;
  samples.end = end;
  for (StampNs second = begin; second < end; second += kWindow)
    for (std::size_t laser = 0; laser < lasers.size(); ++laser) {
      StampNs last = second - kScanSpacing;
      store.scans().forEach(session, lasers[laser].frame, second, std::min(second + kWindow, end) - 1,
                            [&](const Scan& scan) {
                              if (scan.beams.empty() || scan.stamp - last < kScanSpacing) return;
                              last = scan.stamp;
                              appendScan(parameters, scan, static_cast<std::uint8_t>(laser), samples);
                            });
    }
  return samples;
}

}  // namespace laser_mapper
