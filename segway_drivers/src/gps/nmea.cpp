// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/nmea.hpp"

#include <algorithm>

#include "urban_nav_core/io/numbers.hpp"

namespace segway_drivers {

namespace {

constexpr std::size_t kNmeaLongest = 250;  // bytes; 82 by the standard, longer in practice
constexpr char kNmeaDigits[] = "0123456789ABCDEF";

int nmeaDigit(std::uint8_t c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

}  // namespace

Bytes makeNmeaSentence(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<std::uint8_t>(c);
  std::string text = "$" + std::string(body) + "*";
  text += kNmeaDigits[sum >> 4 & 15U];
  text += kNmeaDigits[sum & 15U];
  text += "\r\n";
  return Bytes(text.begin(), text.end());
}

FrameProbe probeNmeaSentence(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != '$') return {Kind::NoFrame, 0};
  unsigned sum = 0;
  std::size_t star = 0;
  for (std::size_t i = 1; i < bytes.size && i < kNmeaLongest; ++i) {
    const std::uint8_t c = bytes[i];
    if (c == '\n' || c == '\r') {
      if (c == '\r' && i + 1 == bytes.size) return {Kind::Incomplete, 0};
      const std::size_t size = c == '\r' && bytes[i + 1] == '\n' ? i + 2 : i + 1;
      const bool complete = star > 0 && i - star == 3;
      const int stated = complete ? nmeaDigit(bytes[star + 1]) * 16 + nmeaDigit(bytes[star + 2]) : -1;
      const bool good = complete && nmeaDigit(bytes[star + 1]) >= 0 && nmeaDigit(bytes[star + 2]) >= 0 &&
                        stated == static_cast<int>(sum);
      return {good ? Kind::Frame : Kind::BadChecksum, size};
    }
    if (c < 0x20 || c > 0x7E || c == '$') return {Kind::NoFrame, 0};
    if (c == '*') star = i;
    else if (star == 0) sum ^= c;
  }
  return {bytes.size < kNmeaLongest ? Kind::Incomplete : Kind::NoFrame, 0};
}

NmeaSentence splitNmeaSentence(ByteView sentence) {
  const std::string_view text(reinterpret_cast<const char*>(sentence.data), sentence.size);
  const std::string_view body = text.substr(1, text.find('*') - 1);
  NmeaSentence result;
  result.fields = urban_nav_core::splitAt(body, ',');
  result.kind = result.fields.front();
  result.fields.erase(result.fields.begin());
  if (result.kind.size() == 5 && result.kind.front() != 'P') result.kind.remove_prefix(2);
  return result;
}

}  // namespace segway_drivers
