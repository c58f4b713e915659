// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/stream/bytes.hpp"

#include <cstring>

namespace segway_drivers {

namespace {

constexpr char kHexDigits[] = "0123456789ABCDEF";

int hexDigitValue(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

template <typename Number, typename Bits>
Number numberFromBits(Bits bits) {
  static_assert(sizeof(Number) == sizeof(Bits));
  Number number;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

}  // namespace

std::uint16_t littleWord(const std::uint8_t* bytes) { return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8); }

std::uint32_t littleWord32(const std::uint8_t* bytes) {
  return littleWord(bytes) | static_cast<std::uint32_t>(littleWord(bytes + 2)) << 16;
}

std::uint16_t bigWord(const std::uint8_t* bytes) { return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]); }

std::uint32_t bigWord32(const std::uint8_t* bytes) {
  return static_cast<std::uint32_t>(bigWord(bytes)) << 16 | bigWord(bytes + 2);
}

float littleFloat(const std::uint8_t* bytes) { return numberFromBits<float>(littleWord32(bytes)); }

double littleDouble(const std::uint8_t* bytes) {
  return numberFromBits<double>(littleWord32(bytes) | static_cast<std::uint64_t>(littleWord32(bytes + 4)) << 32);
}

float bigFloat(const std::uint8_t* bytes) { return numberFromBits<float>(bigWord32(bytes)); }

double bigDouble(const std::uint8_t* bytes) {
  return numberFromBits<double>(static_cast<std::uint64_t>(bigWord32(bytes)) << 32 | bigWord32(bytes + 4));
}

void appendLittle(Bytes& bytes, std::uint16_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
}

void appendBig(Bytes& bytes, std::uint16_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
}

void appendBig32(Bytes& bytes, std::uint32_t word) {
  appendBig(bytes, static_cast<std::uint16_t>(word >> 16));
  appendBig(bytes, static_cast<std::uint16_t>(word & 0xFFFF));
}

std::string printHex(ByteView bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kHexDigits[byte >> 4];
    text += kHexDigits[byte & 15];
  }
  return text;
}

std::optional<Bytes> parseHex(std::string_view text) {
  Bytes bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ') continue;
    const int high = hexDigitValue(text[i]), low = i + 1 < text.size() ? hexDigitValue(text[i + 1]) : -1;
    if (high < 0 || low < 0) return std::nullopt;
    bytes.push_back(static_cast<std::uint8_t>(high << 4 | low));
    ++i;
  }
  return bytes;
}

}  // namespace segway_drivers
