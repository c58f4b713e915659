// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/unknown_stream.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace segway_drivers {

namespace {

constexpr std::size_t kLongestForeign = 4096;  // bytes of a frame
constexpr double kMostlyText = 0.9;            // share of printable bytes

/// Rule of a protocol: returns the size of a complete frame at the head of the bytes, 0 without one.
using ForeignRule = std::size_t (*)(ByteView bytes);

/// SiRF binary protocol, section 2: A0 A2, length, payload, sum of its bytes in fifteen bits, B0 B3.
std::size_t sirfFrame(ByteView b) {
  if (b.size < 8 || b[0] != 0xA0 || b[1] != 0xA2) return 0;
  const std::size_t length = bigWord(b.data + 2), size = length + 8;
  if (size > kLongestForeign || b.size < size || b[size - 2] != 0xB0 || b[size - 1] != 0xB3) return 0;
  unsigned sum = 0;
  for (std::size_t i = 0; i < length; ++i) sum += b[4 + i];
  return (sum & 0x7FFFU) == bigWord(b.data + size - 4) ? size : 0;
}

/// Trimble TSIP: DLE, identifier, data with DLE doubled, DLE, ETX. Identifiers of reports are 40 to 5F, 6D, 82 to 84
/// and 8F (Copernicus II manual, appendix A).
std::size_t tsipFrame(ByteView b) {
  if (b.size < 5 || b[0] != 0x10) return 0;
  const bool is_report =
      (b[1] >= 0x40 && b[1] <= 0x5F) || b[1] == 0x6D || (b[1] >= 0x82 && b[1] <= 0x84) || b[1] == 0x8F || b[1] == 0x13;
  if (!is_report) return 0;
  for (std::size_t i = 2; i + 1 < b.size && i < kLongestForeign; ++i) {
    if (b[i] != 0x10) continue;
    if (b[i + 1] == 0x03) return i + 2;
    if (b[i + 1] != 0x10) return 0;
    ++i;
  }
  return 0;
}

/// Trimble RT17, GSOF and other packets of the data collector format: STX, status, type, length, data, sum, ETX.
std::size_t trimcommFrame(ByteView b) {
  if (b.size < 6 || b[0] != 0x02) return 0;
  const std::size_t length = b[3], size = length + 6;
  if (b.size < size || b[size - 1] != 0x03) return 0;
  unsigned sum = 0;
  for (std::size_t i = 1; i < length + 4; ++i) sum += b[i];
  return (sum & 0xFFU) == b[size - 2] ? size : 0;
}

/// NovAtel OEM binary: AA 44 12 with the length of the header, or AA 44 13 with a short one; without the checksum.
std::size_t novatelFrame(ByteView b) {
  if (b.size < 16 || b[0] != 0xAA || b[1] != 0x44 || (b[2] != 0x12 && b[2] != 0x13)) return 0;
  const bool is_short = b[2] == 0x13;
  const std::size_t size = (is_short ? 12U + b[3] : std::size_t{b[3]} + littleWord(b.data + 8)) + 4;
  return size <= kLongestForeign && b.size >= size && size > 16 ? size : 0;
}

/// Septentrio SBF: "$@", CRC, identifier, length, a multiple of four.
std::size_t sbfFrame(ByteView b) {
  if (b.size < 8 || b[0] != 0x24 || b[1] != 0x40) return 0;
  const std::size_t size = littleWord(b.data + 6);
  return size >= 8 && size % 4 == 0 && size <= kLongestForeign && b.size >= size ? size : 0;
}

/// SkyTraq binary: A0 A1, length, payload, XOR of its bytes, CR, LF.
std::size_t skytraqFrame(ByteView b) {
  if (b.size < 7 || b[0] != 0xA0 || b[1] != 0xA1) return 0;
  const std::size_t length = bigWord(b.data + 2), size = length + 7;
  if (size > kLongestForeign || b.size < size || b[size - 2] != 0x0D || b[size - 1] != 0x0A) return 0;
  unsigned sum = 0;
  for (std::size_t i = 0; i < length; ++i) sum ^= b[4 + i];
  return sum == b[size - 3] ? size : 0;
}

/// UBX with wrong checksums, as after loss of bytes: the next frame begins at the end of this one.
std::size_t ubxFrame(ByteView b) {
  if (b.size < 8 || b[0] != 0xB5 || b[1] != 0x62) return 0;
  const std::size_t size = 8U + littleWord(b.data + 4);
  return size <= kLongestForeign ? std::min(size, b.size) : 0;
}

struct ForeignProtocol {
  const char* text;
  ForeignRule rule;
};

constexpr std::array<ForeignProtocol, 7> kForeign = {{
    {"SiRF binary, which is not read: switch the receiver to NMEA", sirfFrame},
    {"Trimble TSIP, which is not read: switch the receiver to NMEA", tsipFrame},
    {"Trimble RT17 or GSOF, which is not read: switch the receiver to NMEA", trimcommFrame},
    {"NovAtel binary, which is not read: switch the receiver to NMEA", novatelFrame},
    {"Septentrio SBF, which is not read: switch the receiver to NMEA", sbfFrame},
    {"SkyTraq binary, which is not read: switch the receiver to NMEA", skytraqFrame},
    {"UBX whose checksums are wrong: bytes were lost or changed on the line", ubxFrame},
}};

/// Returns the number of bytes in frames by a rule.
std::size_t framedBytes(ByteView bytes, ForeignRule rule) {
  std::size_t framed = 0;
  for (std::size_t at = 0; at < bytes.size;) {
    const std::size_t size = rule(bytes.sub(at, bytes.size - at));
    framed += size;
    at += std::max<std::size_t>(size, 1);
  }
  return framed;
}

/// Returns the number of lines that begin like sentences: "$GP", "$GN", "!AIVDM".
std::size_t countSentences(ByteView bytes) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 6 < bytes.size; ++i) {
    const bool begins =
        (bytes[i] == '$' || bytes[i] == '!') && (i == 0 || bytes[i - 1] == '\n' || bytes[i - 1] == '\r');
    const bool is_name = begins && std::all_of(bytes.data + i + 1, bytes.data + i + 6, [](std::uint8_t c) {
                           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                         });
    count += is_name ? 1 : 0;
  }
  return count;
}

}  // namespace

std::string describeUnknownStream(ByteView bytes) {
  if (bytes.size == 0) return "nothing: it is empty";
  const auto is_text = [](std::uint8_t c) { return (c >= 0x20 && c < 0x7F) || c == '\n' || c == '\r' || c == '\t'; };
  const auto text = static_cast<double>(std::count_if(bytes.begin(), bytes.end(), is_text));
  if (text >= kMostlyText * static_cast<double>(bytes.size)) {
    if (countSentences(bytes) > 0) return "NMEA whose checksums are wrong or missing";
    return "text, but not NMEA";
  }
  const char* best = nullptr;
  std::size_t most = 0;
  for (const ForeignProtocol& protocol : kForeign) {
    const std::size_t framed = framedBytes(bytes, protocol.rule);
    if (framed <= most) continue;
    most = framed;
    best = protocol.text;
  }
  if (best != nullptr && 4 * most >= bytes.size) return best;  // noise has few or no frames
  return "a wrong line rate (4800, 9600, 38400 and 115200 Bd are usual), or a protocol that is not known";
}

}  // namespace segway_drivers
