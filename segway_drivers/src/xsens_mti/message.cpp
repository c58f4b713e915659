// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/xsens_mti/message.hpp"

namespace segway_drivers {

namespace {

constexpr std::uint8_t kMtiPreamble = 0xFA, kMtiBus = 0xFF, kMtiExtended = 0xFF;
constexpr std::size_t kMtiMaxData = 2048;

/// Returns whether the message can have this number of data bytes; any for unlisted identifiers.
bool isMtiLength(std::uint8_t mid, std::size_t length) {
  switch (mid) {
    case 0x11:
    case 0x31:
    case 0x3E:
    case 0x41: return length <= 4;
    case 0x42: return length >= 1 && length <= 2;
    case 0x01: return length >= 4 && length <= 8;
    case 0x32: return length >= 2 && length <= 254;
    case 0x36: return length >= 4;
    default: return true;
  }
}

}  // namespace

Bytes makeMtiMessage(MtiMid mid, ByteView data) {
  Bytes message = {kMtiPreamble, kMtiBus, static_cast<std::uint8_t>(mid)};
  if (data.size < kMtiExtended) {
    message.push_back(static_cast<std::uint8_t>(data.size));
  } else {
    message.push_back(kMtiExtended);
    appendBig(message, static_cast<std::uint16_t>(data.size));
  }
  message.insert(message.end(), data.begin(), data.end());
  unsigned sum = 0;
  for (std::size_t i = 1; i < message.size(); ++i) sum += message[i];
  message.push_back(static_cast<std::uint8_t>(0x100U - (sum & 0xFFU)));
  return message;
}

FrameProbe probeMtiMessage(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  if (bytes[0] != kMtiPreamble) return {Kind::NoFrame, 0};
  if (bytes.size < 2) return {Kind::Incomplete, 0};
  if (bytes[1] != kMtiBus) return {Kind::NoFrame, 0};
  if (bytes.size < 4) return {Kind::Incomplete, 0};
  std::size_t length = bytes[3], header = 4;
  if (length == kMtiExtended) {
    if (bytes.size < 6) return {Kind::Incomplete, 0};
    length = bigWord(bytes.data + 4);
    header = 6;
    if (length < kMtiExtended || length > kMtiMaxData) return {Kind::NoFrame, 0};
  }
  if (!isMtiLength(bytes[2], length)) return {Kind::NoFrame, 0};
  const std::size_t size = header + length + 1;
  if (bytes.size < size) return {Kind::Incomplete, size};
  unsigned sum = 0;
  for (std::size_t i = 1; i < size; ++i) sum += bytes[i];
  return {(sum & 0xFFU) == 0 ? Kind::Frame : Kind::BadChecksum, size};
}

MtiMessage splitMtiMessage(ByteView message) {
  const std::size_t header = message[3] == kMtiExtended ? 6 : 4;
  return {message[2], message.sub(header, message.size - header - 1)};
}

Bytes mtiGoToConfigCommand() { return makeMtiMessage(MtiMid::GoToConfig); }
Bytes mtiGoToMeasurementCommand() { return makeMtiMessage(MtiMid::GoToMeasurement); }
Bytes mtiDeviceIdCommand() { return makeMtiMessage(MtiMid::DeviceId); }
Bytes mtiResetCommand() { return makeMtiMessage(MtiMid::Reset); }

Bytes mtiOutputModeCommand(std::uint16_t mode) {
  Bytes data;
  appendBig(data, mode);
  return makeMtiMessage(MtiMid::OutputMode, data);
}

Bytes mtiOutputSettingsCommand(std::uint32_t settings) {
  Bytes data;
  appendBig32(data, settings);
  return makeMtiMessage(MtiMid::OutputSettings, data);
}

Bytes mtiPeriodCommand(std::uint16_t counts) {
  Bytes data;
  appendBig(data, counts);
  return makeMtiMessage(MtiMid::Period, data);
}

}  // namespace segway_drivers
