// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/tables/lidar_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "blocks/number_columns.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

using urban_nav_core::Beam;
using urban_nav_core::Scan;
using urban_nav_core::Sweep;

namespace {

constexpr std::size_t kMostSweepBytes = std::size_t{1} << 28;
constexpr std::size_t kBeamBytes = 9, kRingBytes = 8;
constexpr double kAzimuthUnit = 2.0 * M_PI / 65536.0, kElevationUnit = M_PI / 65536.0;  // rad
constexpr float kRangeUnit = 0.002F;                                                    // m
constexpr std::int64_t kTimeUnit = 20'000;                                              // ns
constexpr std::int64_t kHalfRange = 32768;

bool isStorable(const Beam& beam, std::int64_t offset) {
  return beam.direction.allFinite() && beam.range > 0.0F && beam.range < 65535.0F * kRangeUnit &&
         std::isfinite(beam.intensity) && offset >= -kHalfRange && offset < kHalfRange;
}

std::int64_t timeOffset(const Beam& beam, std::int64_t reference) {
  const std::int64_t difference = beam.stamp - reference, half = kTimeUnit / 2;
  return (difference + (difference < 0 ? -half : half)) / kTimeUnit;
}

}  // namespace

std::string LidarSweep::pack(const Sweep& sweep) {
  std::map<std::uint16_t, std::vector<const Beam*>> rings;
  for (const Beam& beam : sweep.beams)
    if (isStorable(beam, timeOffset(beam, sweep.reference))) rings[beam.ring].push_back(&beam);
  std::string bytes;
  appendInteger32(bytes, static_cast<std::uint32_t>(rings.size()));
  std::array<std::vector<std::uint32_t>, 5> columns;
  for (const auto& [ring, beams] : rings) {
    appendInteger32(bytes, ring);
    appendInteger32(bytes, static_cast<std::uint32_t>(beams.size()));
    for (const Beam* beam : beams) {
      const Eigen::Vector3d d = beam->direction.cast<double>();
      const auto azimuth = std::lround(std::atan2(d.y(), d.x()) / kAzimuthUnit);
      const auto elevation = std::lround(std::atan2(d.z(), std::hypot(d.x(), d.y())) / kElevationUnit);
      columns[0].push_back(static_cast<std::uint32_t>(azimuth) & 0xffffU);
      columns[1].push_back(static_cast<std::uint32_t>(std::min<std::int64_t>(elevation + kHalfRange, 65535)));
      columns[2].push_back(static_cast<std::uint32_t>(std::lround(beam->range / kRangeUnit)));
      columns[3].push_back(static_cast<std::uint32_t>(timeOffset(*beam, sweep.reference) + kHalfRange));
      columns[4].push_back(static_cast<std::uint32_t>(std::lround(std::clamp(beam->intensity, 0.0F, 255.0F))));
    }
  }
  for (int i = 0; i < 4; ++i) appendColumn(bytes, columns[static_cast<std::size_t>(i)], 2);
  appendColumn(bytes, columns[4], 1);
  return deflated(bytes);
}

std::vector<Scan> LidarSweep::rings() const {
  const auto refuse = [&] {
    throw urban_nav_core::DataError("lidar_sweep", std::to_string(packed.size()) + " bytes are not a sweep", "");
  };
  const std::optional<std::string> bytes = inflated(packed, kMostSweepBytes);
  if (!bytes) refuse();
  ByteReader reader(*bytes);
  const std::size_t count = reader.integer32();
  if (!reader.ok() || count > reader.left() / kRingBytes) refuse();
  std::vector<Scan> scans(count);
  std::size_t beams = 0;
  for (Scan& scan : scans) {
    const std::uint32_t ring = reader.integer32(), in_ring = reader.integer32();
    beams += in_ring;
    if (!reader.ok() || ring > 0xffffU || in_ring == 0 || beams > reader.left() / kBeamBytes) refuse();
    scan.beams.resize(in_ring);
    for (Beam& beam : scan.beams) beam.ring = static_cast<std::uint16_t>(ring);
  }
  if (reader.left() != beams * kBeamBytes) refuse();
  std::string_view rest = std::string_view(*bytes).substr(bytes->size() - reader.left());
  std::array<std::vector<std::uint32_t>, 5> columns;
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = takeColumn(rest, beams, i < 4 ? 2 : 1);
  std::size_t next = 0;
  for (Scan& scan : scans) {
    for (Beam& beam : scan.beams) {
      const double azimuth = kAzimuthUnit * static_cast<double>(static_cast<std::int16_t>(columns[0][next]));
      const double elevation =
          kElevationUnit * (static_cast<double>(columns[1][next]) - static_cast<double>(kHalfRange));
      const double across = std::cos(elevation);
      beam.direction =
          Eigen::Vector3d(across * std::cos(azimuth), across * std::sin(azimuth), std::sin(elevation)).cast<float>();
      beam.range = kRangeUnit * static_cast<float>(columns[2][next]);
      beam.stamp = reference + kTimeUnit * (static_cast<std::int64_t>(columns[3][next]) - kHalfRange);
      beam.intensity = static_cast<float>(columns[4][next]);
      ++next;
    }
    scan.stamp = scan.beams.front().stamp;
  }
  return scans;
}

}  // namespace urban_nav_store
