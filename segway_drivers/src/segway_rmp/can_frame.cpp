// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/segway_rmp/can_frame.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/numbers.hpp"

namespace segway_drivers {

namespace {

std::uint8_t computeRmpChecksum(ByteView bytes) {
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  for (int i = 0; i < 2; ++i) sum = (sum & 0xFFU) + (sum >> 8);
  return static_cast<std::uint8_t>((0x100U - (sum & 0xFFU)) & 0xFFU);
}

}  // namespace

Bytes makeRmpPacket(const CanFrame& frame) {
  Bytes packet = {0xF0, 0x55, 0, 0, 0, 0};
  appendBig(packet, frame.id);
  packet.push_back(0);
  packet.insert(packet.end(), frame.data.begin(), frame.data.end());
  packet.push_back(computeRmpChecksum(packet));
  return packet;
}

Bytes makeRmpBasePacket(const CanFrame& frame) {
  Bytes packet = {
      0xF0, 0x55, 0xAA, 0, static_cast<std::uint8_t>(frame.id >> 3), static_cast<std::uint8_t>((frame.id & 7) << 5),
      0,    0,    0};
  packet.insert(packet.end(), frame.data.begin(), frame.data.end());
  packet.push_back(computeRmpChecksum(packet));
  return packet;
}

FrameProbe probeRmpPacket(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != 0xF0) return {Kind::NoFrame, 0};
  if (bytes.size > 1 && bytes[1] != 0x55) return {Kind::NoFrame, 0};
  if (bytes.size > 2 && bytes[2] != 0xAA && bytes[2] != 0xBB) return {Kind::NoFrame, 0};
  if (bytes.size < kRmpPacketSize) return {Kind::Incomplete, kRmpPacketSize};
  const bool good = computeRmpChecksum(bytes.sub(0, kRmpPacketSize - 1)) == bytes[kRmpPacketSize - 1];
  return {good ? Kind::Frame : Kind::BadChecksum, kRmpPacketSize};
}

std::optional<CanFrame> splitRmpPacket(ByteView packet) {
  if (packet[2] != 0xAA) return std::nullopt;
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>((packet[4] << 3 | packet[5] >> 5) & 0xFFF);
  std::copy(packet.data + 9, packet.data + 17, frame.data.begin());
  return frame;
}

std::optional<CandumpLine> parseCandumpLine(std::string_view line) {
  const auto words = urban_nav_core::splitBlanks(line);
  if (words.size() < 3 || words[0].size() < 3 || words[0].front() != '(' || words[0].back() != ')') return std::nullopt;
  const std::string_view time = words[0].substr(1, words[0].size() - 2);
  const std::size_t dot = time.find('.');
  if (dot == std::string_view::npos || time.size() - dot - 1 != 6) return std::nullopt;
  const auto seconds = urban_nav_core::parseInteger(time.substr(0, dot)),
             micros = urban_nav_core::parseInteger(time.substr(dot + 1));
  const std::size_t hash = words[2].find('#');
  if (!seconds || !micros || *seconds < 0 || *seconds > 9'000'000'000 || *micros < 0 || hash == std::string_view::npos)
    return std::nullopt;
  const std::string_view id_text = words[2].substr(0, hash);
  if (id_text.empty() || id_text.size() > 3) return std::nullopt;
  const auto id = parseHex(std::string(4 - id_text.size(), '0') + std::string(id_text));
  const auto data = parseHex(words[2].substr(hash + 1));
  if (!id || !data || data->size() != 8) return std::nullopt;
  CandumpLine result;
  result.time = *seconds * 1'000'000'000 + *micros * 1000;
  result.frame.id = bigWord(id->data());
  std::copy(data->begin(), data->end(), result.frame.data.begin());
  return result;
}

}  // namespace segway_drivers
