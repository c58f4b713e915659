// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/garmin.hpp"

#include <cmath>

namespace segway_drivers {

namespace {

constexpr std::uint8_t kGarminDle = 0x10, kGarminEtx = 0x03, kGarminPvt = 0x33;
constexpr std::size_t kGarminLongest = 2 * 258 + 4;  // bytes, if all are doubled
constexpr std::size_t kGarminPvtSize = 64;
constexpr double kGarminDegree = 180.0 / 3.14159265358979323846;
constexpr std::int64_t kGarminEpoch = 7304;                                 // days from 1970 to 31 December 1989
constexpr std::int64_t kRolloverDays = 7168;                                // 1024 weeks
constexpr std::int64_t kDaysOf2017 = 17167;                                 // introduction of leap second 18
constexpr double kGarminHalfCircular = 1.1774, kGarminHalfNormal = 0.6745;  // 50 % levels in sigmas

}  // namespace

FrameProbe probeGarminPacket(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != kGarminDle) return {Kind::NoFrame, 0};
  if (bytes.size > 1 && (bytes[1] == kGarminDle || bytes[1] == kGarminEtx)) return {Kind::NoFrame, 0};
  std::size_t count = 0, expected = 0;
  unsigned sum = 0;
  for (std::size_t i = 1; i < bytes.size && i < kGarminLongest; ++i) {
    if (bytes[i] == kGarminDle) {
      if (i + 1 == bytes.size) return {Kind::Incomplete, 0};
      ++i;
      if (bytes[i] == kGarminEtx) {
        const bool whole = count >= 3 && count == expected;
        if (!whole) return {Kind::NoFrame, 0};
        return {(sum & 0xFFU) == 0 ? Kind::Frame : Kind::BadChecksum, i + 1};
      }
      if (bytes[i] != kGarminDle) return {Kind::NoFrame, 0};
    }
    ++count;
    sum += bytes[i];
    if (count == 2) expected = bytes[i] + 3U;
    if (count >= 2 && count > expected) return {Kind::NoFrame, 0};
  }
  return {bytes.size < kGarminLongest ? Kind::Incomplete : Kind::NoFrame, 0};
}

GarminPacket splitGarminPacket(ByteView packet) {
  GarminPacket result;
  for (std::size_t i = 1; i + 2 < packet.size; ++i) {
    result.data.push_back(packet[i]);
    if (packet[i] == kGarminDle) ++i;
  }
  result.id = result.data.front();
  result.data.erase(result.data.begin(), result.data.begin() + 2);
  result.data.pop_back();
  return result;
}

std::optional<GpsFix> decodeGarminFix(const GarminPacket& packet) {
  if (packet.id != kGarminPvt || packet.data.size() != kGarminPvtSize) return std::nullopt;
  const std::uint8_t* data = packet.data.data();
  GpsFix fix;
  fix.source = "garmin";
  const unsigned kind = littleWord(data + 16);
  const double week_s = littleDouble(data + 18), leap_s = static_cast<std::int16_t>(littleWord(data + 58));
  const double latitude = kGarminDegree * littleDouble(data + 26), longitude = kGarminDegree * littleDouble(data + 34);
  const double east = littleFloat(data + 42), north = littleFloat(data + 46), up = littleFloat(data + 50);
  const double height = littleFloat(data), horizontal = littleFloat(data + 8), vertical = littleFloat(data + 12);
  for (const double value : {week_s, latitude, longitude, east, north, up, height, horizontal, vertical})
    if (!std::isfinite(value)) return std::nullopt;
  if (std::abs(latitude) > 90.0 || std::abs(longitude) > 180.0 || week_s < 0.0 || week_s > 604801.0)
    return std::nullopt;

  const std::int64_t ms = std::llround(1000.0 * (week_s - leap_s));
  const std::int64_t day_ms = 86'400'000, whole_days = ms >= 0 ? ms / day_ms : -1;
  std::int64_t days = kGarminEpoch + littleWord32(data + 60) + whole_days;
  if (days > 60000) return std::nullopt;
  if (leap_s >= 18 && days < kDaysOf2017) {
    days += kRolloverDays;
    fix.week_corrected = true;
  }
  fix.utc = printUtc(days, ms - whole_days * day_ms);
  fix.differential = kind == 4 || kind == 5;
  fix.mode = kind == 2 || kind == 4   ? GpsFix::Mode::Fix2D
             : kind == 3 || kind == 5 ? GpsFix::Mode::Fix3D
                                      : GpsFix::Mode::None;
  if (fix.mode == GpsFix::Mode::None) return fix;
  fix.latitude = latitude;
  fix.longitude = longitude;
  fix.height = height;
  fix.sigma_e = fix.sigma_n = horizontal / kGarminHalfCircular;
  fix.sigma_u = vertical / kGarminHalfNormal;
  fix.speed = std::hypot(east, north);
  const double track = kGarminDegree * std::atan2(east, north);
  fix.track = track < 0.0 ? track + 360.0 : track;
  fix.climb = up;
  return fix;
}

}  // namespace segway_drivers
