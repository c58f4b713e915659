// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/ubx.hpp"

#include <algorithm>
#include <cmath>

namespace segway_drivers {

namespace {

constexpr std::uint8_t kUbxSync1 = 0xB5, kUbxSync2 = 0x62;
constexpr std::size_t kUbxHead = 6, kUbxChecksum = 2;  // bytes
constexpr std::uint8_t kUbxNav = 0x01, kUbxPvt = 0x07;
constexpr std::size_t kUbxOldPvt = 84;  // bytes of the payload
constexpr std::uint8_t kRtcmSync = 0xD3;
constexpr std::size_t kRtcmHead = 3, kRtcmChecksum = 3;  // bytes
constexpr std::uint32_t kCrc24Polynomial = 0x1864CFB;

std::int32_t signedWord32(const std::uint8_t* bytes) { return static_cast<std::int32_t>(littleWord32(bytes)); }

/// Returns the time of a NAV-PVT to the nearest millisecond; its nanoseconds may be negative.
std::string ubxTime(const std::uint8_t* data) {
  constexpr std::int64_t kDay = 86'400'000;  // ms
  const unsigned valid = data[11];
  const auto days = daysOfDate(littleWord(data + 4), data[6], data[7]);
  const bool is_known = (valid & 3U) == 3U && days && data[8] < 24 && data[9] < 60 && data[10] < 61;
  if (!is_known) return {};
  std::int64_t ms = 3'600'000LL * data[8] + 60'000LL * data[9] + 1000LL * data[10];
  ms += std::llround(1e-6 * signedWord32(data + 16));
  const std::int64_t shift = ms < 0 ? -1 : ms >= kDay ? 1 : 0;
  return printUtc(*days + shift, ms - shift * kDay);
}

}  // namespace

FrameProbe probeUbxFrame(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != kUbxSync1 || (bytes.size > 1 && bytes[1] != kUbxSync2)) return {Kind::NoFrame, 0};
  if (bytes.size < kUbxHead) return {Kind::Incomplete, 0};
  const std::size_t size = kUbxHead + littleWord(bytes.data + 4) + kUbxChecksum;
  if (size > kUbxLongestFrame) return {Kind::NoFrame, 0};
  if (bytes.size < size) return {Kind::Incomplete, size};
  unsigned a = 0, b = 0;
  for (std::size_t i = 2; i + kUbxChecksum < size; ++i) b += a += bytes[i];
  const bool good = bytes[size - 2] == (a & 0xFFU) && bytes[size - 1] == (b & 0xFFU);
  return {good ? Kind::Frame : Kind::BadChecksum, size};
}

std::string ubxName(ByteView frame) {
  std::string name = printHex(frame.sub(2, 2));
  std::replace(name.begin(), name.end(), ' ', '-');
  return "ubx " + name;
}

std::optional<GpsFix> decodeUbxFix(ByteView frame) {
  if (frame[2] != kUbxNav || frame[3] != kUbxPvt || frame.size < kUbxHead + kUbxOldPvt + kUbxChecksum)
    return std::nullopt;
  const std::uint8_t* data = frame.data + kUbxHead;
  const unsigned kind = data[20], flags = data[21], carrier = flags >> 6U, flags3 = littleWord(data + 78);
  GpsFix fix;
  fix.source = "ubx";
  fix.utc = ubxTime(data);
  fix.satellites = data[23];
  fix.differential = (flags & 2U) != 0;
  fix.carrier = carrier == 2 ? GpsFix::Carrier::Fixed : carrier == 1 ? GpsFix::Carrier::Float : GpsFix::Carrier::None;
  const double longitude = 1e-7 * signedWord32(data + 24), latitude = 1e-7 * signedWord32(data + 28);
  if (std::abs(latitude) > 90.0 || std::abs(longitude) > 180.0) return std::nullopt;
  const bool is_good = (flags & 1U) != 0 && (flags3 & 1U) == 0;
  if (is_good && kind >= 2 && kind <= 4) fix.mode = kind == 2 ? GpsFix::Mode::Fix2D : GpsFix::Mode::Fix3D;
  if (fix.mode == GpsFix::Mode::None) return fix;
  fix.latitude = latitude;
  fix.longitude = longitude;
  if (fix.mode == GpsFix::Mode::Fix3D) fix.height = 1e-3 * signedWord32(data + 32);
  fix.sigma_e = fix.sigma_n = 1e-3 * littleWord32(data + 40) / std::sqrt(2.0);
  fix.sigma_u = 1e-3 * littleWord32(data + 44);
  fix.climb = -1e-3 * signedWord32(data + 56);
  fix.speed = 1e-3 * signedWord32(data + 60);
  const double track = std::fmod(1e-5 * signedWord32(data + 64), 360.0);
  fix.track = track < 0.0 ? track + 360.0 : track;
  return fix;
}

FrameProbe probeRtcmFrame(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != kRtcmSync || (bytes.size > 1 && (bytes[1] & 0xFCU) != 0)) return {Kind::NoFrame, 0};
  if (bytes.size < kRtcmHead) return {Kind::Incomplete, 0};
  const std::size_t size = kRtcmHead + (bigWord(bytes.data + 1) & 0x3FFU) + kRtcmChecksum;
  if (bytes.size < size) return {Kind::Incomplete, size};
  std::uint32_t crc = 0;
  for (std::size_t i = 0; i < size; ++i) {  // including the checksum, which gives zero
    crc ^= static_cast<std::uint32_t>(bytes[i]) << 16U;
    for (int bit = 0; bit < 8; ++bit) crc = (crc << 1U) ^ ((crc & 0x800000U) != 0 ? kCrc24Polynomial : 0U);
  }
  return {(crc & 0xFFFFFFU) == 0 ? Kind::Frame : Kind::BadChecksum, size};
}

std::string rtcmName(ByteView frame) {
  if (frame.size < kRtcmHead + 2 + kRtcmChecksum) return "rtcm";
  return "rtcm " + std::to_string(bigWord(frame.data + kRtcmHead) >> 4U);
}

}  // namespace segway_drivers
