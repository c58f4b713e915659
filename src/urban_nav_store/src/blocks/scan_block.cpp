// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/scan_block.hpp"

#include <cmath>

#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

using urban_nav_core::Beam;
using urban_nav_core::Scan;

namespace {

constexpr std::size_t kMostScanBytes = std::size_t{1} << 29;
constexpr std::size_t kBeam = 28, kScan = 12;  // bytes before compression

std::uint64_t asUnsigned(std::int64_t value) { return static_cast<std::uint64_t>(value); }

template <typename Take>
void forEachBeam(const std::vector<Scan>& scans, const Take& take) {
  for (const Scan& scan : scans)
    for (const Beam& beam : scan.beams) take(scan, beam);
}

}  // namespace

std::string packScans(const std::vector<Scan>& scans) {
  std::string bytes;
  appendInteger32(bytes, static_cast<std::uint32_t>(scans.size()));
  for (const Scan& scan : scans) {
    appendInteger(bytes, asUnsigned(scan.stamp));
    appendInteger32(bytes, static_cast<std::uint32_t>(scan.beams.size()));
  }
  for (const Scan& scan : scans) {  // nearly constant step between beams
    std::uint64_t last = asUnsigned(scan.stamp);
    for (const Beam& beam : scan.beams) {
      appendInteger(bytes, asUnsigned(beam.stamp) - last);
      last = asUnsigned(beam.stamp);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
    forEachBeam(scans, [&](const Scan&, const Beam& beam) { appendFloat(bytes, beam.direction(axis)); });
  forEachBeam(scans, [&](const Scan&, const Beam& beam) { appendFloat(bytes, beam.range); });
  forEachBeam(scans, [&](const Scan&, const Beam& beam) { appendFloat(bytes, beam.intensity); });
  return deflated(bytes);
}

std::optional<std::vector<Scan>> unpackScans(std::string_view packed) {
  const std::optional<std::string> bytes = inflated(packed, kMostScanBytes);
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  const std::size_t count = reader.integer32();
  if (!reader.ok() || count * kScan > reader.left()) return std::nullopt;
  std::vector<Scan> scans(count);
  std::size_t beams = 0;
  for (Scan& scan : scans) {
    scan.stamp = static_cast<std::int64_t>(reader.integer());
    const std::size_t in_scan = reader.integer32();
    beams += in_scan;
    if (!reader.ok() || beams * kBeam > reader.left()) return std::nullopt;
    scan.beams.resize(in_scan);
  }
  for (Scan& scan : scans) {
    std::uint64_t last = asUnsigned(scan.stamp);
    for (Beam& beam : scan.beams) beam.stamp = static_cast<std::int64_t>(last += reader.integer());
  }
  for (int axis = 0; axis < 3; ++axis)
    for (Scan& scan : scans)
      for (Beam& beam : scan.beams) beam.direction(axis) = reader.real32();
  for (Scan& scan : scans)
    for (Beam& beam : scan.beams) beam.range = reader.real32();
  for (Scan& scan : scans)
    for (Beam& beam : scan.beams) beam.intensity = reader.real32();
  if (!reader.complete()) return std::nullopt;
  for (const Scan& scan : scans)
    for (const Beam& beam : scan.beams)
      if (!beam.direction.allFinite() || !std::isfinite(beam.range) || !std::isfinite(beam.intensity))
        return std::nullopt;
  return scans;
}

}  // namespace urban_nav_store
