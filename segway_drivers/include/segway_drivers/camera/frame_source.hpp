// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Stream of images that a camera is asked for.
struct CameraFormat {
  int mode = 3;  ///< number of the Format 7 mode
  int width = 640, height = 480;
  bool raw16 = true;  ///< two bytes a pixel, one of each imager; otherwise one byte
  int packet = 1536;  ///< bytes, which set the rate
  int speed = 400;    ///< Mbit/s
};

/// An image as it came from the bus.
struct CameraFrame {
  Bytes bytes;
  TimeNs arrival = 0;    ///< steady clock, ns
  bool corrupt = false;  ///< packets are missing
};

/// One instant by the clock of the bus and by the steady clock of the host.
struct CameraCycle {
  double bus_s = 0.0;  ///< s modulo 128
  TimeNs host = 0;     ///< ns
};

/// A camera on an IEEE 1394 bus, a recording or a simulation. Not thread-safe.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Returns false and sets `error` if there is no such camera.
  virtual bool open(std::string& error) = 0;
  virtual std::optional<std::uint32_t> readRegister(std::uint64_t address) = 0;
  virtual bool writeRegister(std::uint64_t address, std::uint32_t value) = 0;
  virtual bool start(const CameraFormat& format, std::string& error) = 0;
  /// Waits up to `timeout` ns. Empty: no image came.
  virtual std::optional<CameraFrame> next(TimeNs timeout) = 0;
  virtual std::optional<CameraCycle> readCycle() = 0;
  virtual void stop() = 0;
  /// Whether the camera has vanished.
  virtual bool isGone() const = 0;
  /// Whether no image will ever come: the end of a recording or of a simulation.
  virtual bool isFinished() const { return false; }
};

/// Camera of a bus by its GUID in hexadecimal, or the only one whose model begins with `model` if `guid` is empty.
/// Returns null and sets `error` if built without libdc1394.
std::unique_ptr<FrameSource> makeBusCamera(const std::string& guid, const std::string& model, std::string& error);

}  // namespace segway_drivers
