// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr std::size_t kMtiMaxMessage = 2048 + 7;  // bytes, with an extended length

/// Message identifiers of an XSens MT device. The answer to a request has the identifier of the request plus 1.
enum class MtiMid : std::uint8_t {
  DeviceId = 0x00,
  Period = 0x04,
  Configuration = 0x0C,
  GoToMeasurement = 0x10,
  FirmwareRevision = 0x12,
  BaudRate = 0x18,
  ProductCode = 0x1C,
  GoToConfig = 0x30,
  Data = 0x32,
  Data2 = 0x36,
  WakeUp = 0x3E,
  WakeUpAck = 0x3F,
  Reset = 0x40,
  Error = 0x42,
  OutputConfiguration = 0xC0,
  OutputMode = 0xD0,
  OutputSettings = 0xD2,
  OutputSkipFactor = 0xD4,
  ErrorMode = 0xDA,
};

/// Returns a message to the device: preamble, bus identifier, message identifier, length, `data`, checksum.
Bytes makeMtiMessage(MtiMid mid, ByteView data = {});
/// Framing rule of messages in both directions.
FrameProbe probeMtiMessage(ByteView bytes);

/// Parts of a complete message.
struct MtiMessage {
  std::uint8_t mid = 0;
  ByteView data;
};
MtiMessage splitMtiMessage(ByteView message);

Bytes mtiGoToConfigCommand();
Bytes mtiGoToMeasurementCommand();
Bytes mtiDeviceIdCommand();
Bytes mtiOutputModeCommand(std::uint16_t mode);
Bytes mtiOutputSettingsCommand(std::uint32_t settings);
/// `counts` of 1/115200 s.
Bytes mtiPeriodCommand(std::uint16_t counts);
Bytes mtiResetCommand();

}  // namespace segway_drivers
