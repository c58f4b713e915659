// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/float_scan_block.hpp"

#include "urban_nav_store/bytes.hpp"

namespace urban_nav_store {

using urban_nav_core::Beam;
using urban_nav_core::Scan;

std::optional<std::vector<Scan>> takeFloatScans(std::string_view bytes) {
  constexpr std::size_t kBeam = 28, kScan = 12;  // bytes
  ByteReader reader(bytes);
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
    auto last = static_cast<std::uint64_t>(scan.stamp);
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
  return scans;
}

}  // namespace urban_nav_store
