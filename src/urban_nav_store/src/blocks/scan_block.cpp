// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/scan_block.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "blocks/float_scan_block.hpp"
#include "blocks/number_columns.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

using urban_nav_core::Beam;
using urban_nav_core::Scan;

namespace {

constexpr std::size_t kMostScanBytes = std::size_t{1} << 29;
/// Begins a block in this encoding; blocks of older versions begin with the number of scans, which is far smaller.
constexpr std::uint32_t kMark = 0xffffff02U;
constexpr std::size_t kScan = 12, kDirection = 12, kStep = 8, kValue = 4;  // bytes before compression
constexpr std::size_t kBeam = kStep + 3 * kValue;
constexpr std::uint32_t kRangesPerMetre = 1000, kIntensitiesPerUnit = 1;  // of scanners that output integers
constexpr std::int64_t kLargest = std::int64_t{1} << 30;

using Beams = std::vector<const Beam*>;

std::uint64_t asUnsigned(std::int64_t value) { return static_cast<std::uint64_t>(value); }

std::uint32_t toBits(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

float dequantised(std::int64_t steps, std::uint32_t per_unit) {
  return static_cast<float>(static_cast<double>(steps) / static_cast<double>(per_unit));
}

/// Returns the values as integers in steps of 1 / per_unit; empty unless they give all values bit-exactly.
std::vector<std::int64_t> quantised(const std::vector<float>& values, std::uint32_t per_unit) {
  std::vector<std::int64_t> steps;
  for (const float value : values) {
    const double scaled = static_cast<double>(value) * static_cast<double>(per_unit);
    if (!(std::abs(scaled) < static_cast<double>(kLargest))) return {};
    steps.push_back(std::llround(scaled));
    if (toBits(dequantised(steps.back(), per_unit)) != toBits(value)) return {};
  }
  return steps;
}

/// Directions that occur in a block, in the order of their first beams, and the index of that of each beam.
struct Directions {
  std::vector<Eigen::Vector3f> distinct;
  std::vector<std::size_t> of_beam;
};

Directions findDirections(const Beams& beams) {
  Directions found;
  std::unordered_map<std::string, std::size_t> known;
  for (const Beam* beam : beams) {
    const std::string bits(reinterpret_cast<const char*>(beam->direction.data()), kDirection);
    const auto [place, is_new] = known.emplace(bits, found.distinct.size());
    if (is_new) found.distinct.push_back(beam->direction);
    found.of_beam.push_back(place->second);
  }
  return found;
}

/// Predicts values of beams: by that of the last beam in the same direction, which of a robot at rest differs by the
/// noise; in a new direction, by the beam before; of the first beam, as 0.
class Predictor {
 public:
  explicit Predictor(std::size_t directions) : last_(directions, kNone) {}
  std::int64_t predict(std::size_t direction) const { return last_[direction] == kNone ? newest_ : last_[direction]; }
  void observe(std::size_t direction, std::int64_t value) { newest_ = last_[direction] = value; }

 private:
  static constexpr std::int64_t kNone = std::int64_t{1} << 40;
  std::vector<std::int64_t> last_;
  std::int64_t newest_ = 0;
};

void appendValues(std::string& bytes, const std::vector<float>& values, const Directions& directions,
                  std::uint32_t per_unit) {
  const std::vector<std::int64_t> steps = quantised(values, per_unit);
  const bool is_exact = steps.size() == values.size();
  appendInteger32(bytes, is_exact ? per_unit : 0);
  if (!is_exact) {
    for (const float value : values) appendFloat(bytes, value);
    return;
  }
  Predictor predictor(directions.distinct.size());
  std::vector<std::uint64_t> residuals;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    residuals.push_back(toUnsigned(steps[i] - predictor.predict(directions.of_beam[i])));
    predictor.observe(directions.of_beam[i], steps[i]);
  }
  appendPlanes(bytes, residuals, kValue);
}

std::optional<std::vector<float>> takeValues(std::string_view& bytes, const Directions& directions) {
  const std::size_t count = directions.of_beam.size();
  if (bytes.size() < kValue + count * kValue) return std::nullopt;
  ByteReader reader(bytes);
  const std::uint32_t per_unit = reader.integer32();
  std::vector<float> values;
  if (per_unit == 0) {
    for (std::size_t i = 0; i < count; ++i) values.push_back(reader.real32());
    bytes.remove_prefix(kValue + count * kValue);
    return values;
  }
  bytes.remove_prefix(kValue);
  Predictor predictor(directions.distinct.size());
  const std::vector<std::uint64_t> residuals = takePlanes(bytes, count, kValue);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t direction = directions.of_beam[i];
    const std::int64_t steps = predictor.predict(direction) + toSigned(residuals[i]);
    if (std::abs(steps) > kLargest) return std::nullopt;
    predictor.observe(direction, steps);
    values.push_back(dequantised(steps, per_unit));
  }
  return values;
}

/// Appends the distinct directions, and of each beam the step of the index from the beam before in its scan, less one:
/// 0 for a scanner without gaps.
void appendDirections(std::string& bytes, const std::vector<Scan>& scans, const Directions& directions) {
  appendInteger32(bytes, static_cast<std::uint32_t>(directions.distinct.size()));
  for (int axis = 0; axis < 3; ++axis)
    for (const Eigen::Vector3f& direction : directions.distinct) appendFloat(bytes, direction(axis));
  std::vector<std::uint64_t> steps;
  for (const Scan& scan : scans) {
    std::int64_t last = -1;
    for (std::size_t i = 0; i < scan.beams.size(); ++i) {
      const auto index = static_cast<std::int64_t>(directions.of_beam[steps.size()]);
      steps.push_back(toUnsigned(index - last - 1));
      last = index;
    }
  }
  appendPlanes(bytes, steps, kValue);
}

std::optional<Directions> takeDirections(std::string_view& bytes, const std::vector<Scan>& scans, std::size_t beams) {
  Directions directions;
  ByteReader reader(bytes);
  const std::size_t count = reader.integer32();
  if (!reader.ok() || count > reader.left() / kDirection || reader.left() - count * kDirection < beams * kValue)
    return std::nullopt;
  directions.distinct.resize(count);
  for (int axis = 0; axis < 3; ++axis)
    for (Eigen::Vector3f& direction : directions.distinct) direction(axis) = reader.real32();
  bytes.remove_prefix(kValue + count * kDirection);
  const std::vector<std::uint64_t> steps = takePlanes(bytes, beams, kValue);
  for (const Scan& scan : scans) {
    std::int64_t last = -1;
    for (std::size_t i = 0; i < scan.beams.size(); ++i) {
      last += 1 + toSigned(steps[directions.of_beam.size()]);
      if (last < 0 || last >= static_cast<std::int64_t>(count)) return std::nullopt;
      directions.of_beam.push_back(static_cast<std::size_t>(last));
    }
  }
  return directions;
}

/// Reads the stamps and the numbers of beams of scans whose beams follow. Returns the number of all beams.
std::optional<std::size_t> takeHeads(std::string_view& bytes, std::vector<Scan>& scans) {
  ByteReader reader(bytes);
  reader.integer32();  // kMark
  const std::size_t count = reader.integer32();
  if (!reader.ok() || count > reader.left() / kScan) return std::nullopt;
  scans.resize(count);
  std::size_t beams = 0;
  for (Scan& scan : scans) {
    scan.stamp = static_cast<std::int64_t>(reader.integer());
    const std::size_t in_scan = reader.integer32();
    beams += in_scan;
    if (!reader.ok() || beams > reader.left() / kBeam) return std::nullopt;
    scan.beams.resize(in_scan);
  }
  bytes.remove_prefix(bytes.size() - reader.left());
  return beams;
}

void takeStamps(std::string_view& bytes, std::vector<Scan>& scans, std::size_t beams) {
  const std::vector<std::uint64_t> steps = takePlanes(bytes, beams, kStep);
  std::size_t i = 0;
  for (Scan& scan : scans) {
    std::uint64_t last = asUnsigned(scan.stamp);
    for (Beam& beam : scan.beams) beam.stamp = static_cast<std::int64_t>(last += steps[i++]);
  }
}

bool areFinite(const std::vector<Scan>& scans) {
  for (const Scan& scan : scans)
    for (const Beam& beam : scan.beams)
      if (!beam.direction.allFinite() || !std::isfinite(beam.range) || !std::isfinite(beam.intensity)) return false;
  return true;
}

std::optional<std::vector<Scan>> takeScans(std::string_view bytes) {
  std::vector<Scan> scans;
  const std::optional<std::size_t> beams = takeHeads(bytes, scans);
  if (!beams) return std::nullopt;
  takeStamps(bytes, scans, *beams);
  const std::optional<Directions> directions = takeDirections(bytes, scans, *beams);
  if (!directions) return std::nullopt;
  const auto ranges = takeValues(bytes, *directions);
  const auto intensities = ranges ? takeValues(bytes, *directions) : std::nullopt;
  if (!intensities || !bytes.empty()) return std::nullopt;
  std::size_t i = 0;
  for (Scan& scan : scans)
    for (Beam& beam : scan.beams) {
      beam.direction = directions->distinct[directions->of_beam[i]];
      beam.range = (*ranges)[i];
      beam.intensity = (*intensities)[i++];
    }
  return scans;
}

}  // namespace

std::string packScans(const std::vector<Scan>& scans) {
  std::string bytes;
  appendInteger32(bytes, kMark);
  appendInteger32(bytes, static_cast<std::uint32_t>(scans.size()));
  Beams beams;
  std::vector<std::uint64_t> steps;
  for (const Scan& scan : scans) {
    appendInteger(bytes, asUnsigned(scan.stamp));
    appendInteger32(bytes, static_cast<std::uint32_t>(scan.beams.size()));
    std::uint64_t last = asUnsigned(scan.stamp);  // nearly constant step between beams
    for (const Beam& beam : scan.beams) {
      beams.push_back(&beam);
      steps.push_back(asUnsigned(beam.stamp) - last);
      last = asUnsigned(beam.stamp);
    }
  }
  appendPlanes(bytes, steps, kStep);
  const Directions directions = findDirections(beams);
  appendDirections(bytes, scans, directions);
  std::vector<float> ranges, intensities;
  for (const Beam* beam : beams) {
    ranges.push_back(beam->range);
    intensities.push_back(beam->intensity);
  }
  appendValues(bytes, ranges, directions, kRangesPerMetre);
  appendValues(bytes, intensities, directions, kIntensitiesPerUnit);
  return deflated(bytes);
}

std::optional<std::vector<Scan>> unpackScans(std::string_view packed) {
  const std::optional<std::string> bytes = inflated(packed, kMostScanBytes);
  if (!bytes) return std::nullopt;
  std::optional<std::vector<Scan>> scans =
      ByteReader(*bytes).integer32() == kMark ? takeScans(*bytes) : takeFloatScans(*bytes);
  if (!scans || !areFinite(*scans)) return std::nullopt;
  return scans;
}

}  // namespace urban_nav_store
