// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/lms291/telegram.hpp"

namespace segway_drivers {

namespace {

constexpr std::uint8_t kLmsStx = 0x02, kLmsDeviceAddress = 0x80;
constexpr std::size_t kLmsHeader = 4, kLmsOverhead = 6;

/// Returns whether a scan with only ranges (B0h) can have this length: with none, one or both of the index bytes.
bool isLmsRangeLength(std::size_t length, std::size_t ranges) {
  return length >= 4 + 2 * ranges && length <= 6 + 2 * ranges;
}

/// Returns whether a scan with reflectivities (C4h) can have this length: one to `ranges` of them, and one or two index
/// bytes.
bool isLmsReflectivityLength(std::size_t length, std::size_t ranges) {
  const std::size_t fixed = 3 + 2 * ranges + 6;
  return length >= fixed + 3 && length <= fixed + ranges + 3;
}

/// Checks the payload length by command byte. `payload`: bytes that have arrived, at least the command.
bool isLmsLength(ByteView payload, std::size_t length) {
  const std::size_t ranges = payload.size >= 3 ? littleWord(payload.data + 1) & 0x3FFU : 0;
  switch (payload[0]) {
    case 0x90: return length <= 80;
    case 0x91:
    case 0x92: return length <= 3;
    case 0xA0: return length == 3;
    case 0xB0: return payload.size < 3 ? length >= 4 : isLmsRangeLength(length, ranges);
    case 0xB1: return length >= 20 && length <= 200;
    case 0xB2: return length <= 200;
    case 0xBA: return length <= 80;
    case 0xBB: return length <= 8;
    case 0xC4: return payload.size < 3 ? length >= 12 : isLmsReflectivityLength(length, ranges);
    case 0xF4: return length >= 20 && length <= 48;
    case 0xF7: return length >= 3 && length <= 48;
    default: return payload[0] >= 0x80;
  }
}

}  // namespace

std::uint16_t computeLmsCrc(ByteView bytes) {
  unsigned crc = 0, previous = 0;
  for (const std::uint8_t byte : bytes) {
    crc = ((crc << 1) & 0xFFFFU) ^ ((crc & 0x8000U) != 0 ? 0x8005U : 0U);
    crc ^= byte | previous << 8;
    previous = byte;
  }
  return static_cast<std::uint16_t>(crc);
}

Bytes makeLmsTelegram(ByteView payload) {
  Bytes telegram = {kLmsStx, 0x00};
  appendLittle(telegram, static_cast<std::uint16_t>(payload.size));
  telegram.insert(telegram.end(), payload.begin(), payload.end());
  appendLittle(telegram, computeLmsCrc(telegram));
  return telegram;
}

FrameProbe probeLmsTelegram(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != kLmsStx) return {Kind::NoFrame, 0};
  if (bytes.size < 2) return {Kind::Incomplete, 0};
  if (bytes[1] != kLmsDeviceAddress) return {Kind::NoFrame, 0};
  if (bytes.size < 5) return {Kind::Incomplete, 0};
  const std::size_t length = littleWord(bytes.data + 2);
  if (length < 2 || length > kLmsMaxTelegram - kLmsOverhead) return {Kind::NoFrame, 0};
  if (!isLmsLength(bytes.sub(kLmsHeader, bytes.size - kLmsHeader), length)) return {Kind::NoFrame, 0};
  const std::size_t size = length + kLmsOverhead;
  if (bytes.size < size) return {Kind::Incomplete, size};
  const bool good = computeLmsCrc(bytes.sub(0, size - 2)) == littleWord(bytes.data + size - 2);
  return {good ? Kind::Frame : Kind::BadChecksum, size};
}

ByteView lmsPayload(ByteView telegram) { return telegram.sub(kLmsHeader, telegram.size - kLmsOverhead); }

}  // namespace segway_drivers
