// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/lms291/scan.hpp"

#include <limits>

namespace segway_drivers {

namespace {

constexpr std::size_t kLmsCodeCount = 10;

bool isOpenAir(unsigned code) { return code == 1 || code == 6 || code == 9; }

/// Decodes the ranges of `count` words. A word within 9 of 2^bits is a code.
void decodeLmsRanges(const std::uint8_t* words, std::size_t count, int bits, double unit, LmsScan& scan) {
  const unsigned limit = 1U << bits;
  scan.ranges.reserve(count);
  scan.codes.assign(kLmsCodeCount, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned value = littleWord(words + 2 * i) & (limit - 1);
    const unsigned code = limit - value < kLmsCodeCount ? limit - value : 0;
    ++scan.codes[code];
    if (code == 0) scan.ranges.push_back(static_cast<float>(unit * value));
    else if (isOpenAir(code)) scan.ranges.push_back(std::numeric_limits<float>::infinity());
    else scan.ranges.push_back(std::numeric_limits<float>::quiet_NaN());
  }
}

std::optional<LmsScan> decodeLmsReflectivityScan(ByteView payload, std::size_t count, int bits, double unit) {
  const std::size_t after_ranges = 3 + 2 * count;
  if (payload.size < after_ranges + 6) return std::nullopt;
  const std::uint8_t* header = payload.data + after_ranges;
  const std::size_t values = littleWord(header) & 0x3FFU, first = littleWord(header + 2), last = littleWord(header + 4);
  const std::size_t fixed = after_ranges + 6 + values;
  if (payload.size != fixed + 2 && payload.size != fixed + 3) return std::nullopt;
  if (first < 1 || last < first || last - first + 1 != values || last > count) return std::nullopt;
  LmsScan scan;
  decodeLmsRanges(payload.data + 3, count, bits, unit, scan);
  scan.reflectivities.assign(count, 0);
  for (std::size_t i = 0; i < values; ++i) scan.reflectivities[first - 1 + i] = header[6 + i];
  scan.index = payload[payload.size - 2];
  scan.status = payload[payload.size - 1];
  return scan;
}

}  // namespace

std::optional<LmsRangeFormat> LmsRangeFormat::fromConfiguration(std::uint8_t measuring_mode, std::uint8_t unit) {
  if (unit > 1) return std::nullopt;
  switch (measuring_mode) {
    case 0x00:
    case 0x01:
    case 0x02: return LmsRangeFormat{13, unit == 1};
    case 0x03:
    case 0x04: return LmsRangeFormat{14, unit == 1};
    case 0x05:
    case 0x06: return LmsRangeFormat{15, unit == 1};
    case 0x0F: return LmsRangeFormat{16, unit == 1};
    default: return std::nullopt;
  }
}

double LmsRangeFormat::maxRange() const { return ((1 << bits) - 10) * (millimetres ? 0.001 : 0.01); }

std::optional<LmsScan> decodeLmsScan(ByteView payload, const LmsRangeFormat& format) {
  if (payload.size < 4 || (payload[0] != 0xB0 && payload[0] != 0xC4)) return std::nullopt;
  const unsigned word = littleWord(payload.data + 1);
  const std::size_t count = word & 0x3FFU;
  const bool partial = (word & 0x2000U) != 0;
  const unsigned unit_bits = word >> 14;
  if (partial || count == 0 || unit_bits > 1) return std::nullopt;
  const double unit = unit_bits == 1 ? 0.001 : 0.01;
  if (payload[0] == 0xC4) return decodeLmsReflectivityScan(payload, count, format.bits, unit);
  const std::size_t fixed = 4 + 2 * count;
  if (payload.size < fixed || payload.size > fixed + 2) return std::nullopt;
  LmsScan scan;
  decodeLmsRanges(payload.data + 3, count, format.bits, unit, scan);
  if (payload.size > fixed) scan.index = payload[payload.size - 2];
  scan.status = payload[payload.size - 1];
  return scan;
}

}  // namespace segway_drivers
