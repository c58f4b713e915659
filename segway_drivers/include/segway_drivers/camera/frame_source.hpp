// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Requested image stream of a camera.
struct CameraFormat {
  int mode = 3;  ///< number of the Format 7 mode
  int width = 640, height = 480;
  bool raw16 = true;  ///< two bytes per pixel, one of each imager; otherwise one byte
  int packet = 1536;  ///< bytes, which determine the rate
  int speed = 400;    ///< Mbit/s
};

/// An image as received from the bus.
struct CameraFrame {
  Bytes bytes;
  TimeNs arrival = 0;    ///< steady clock, ns
  bool corrupt = false;  ///< packets are missing
};

/// One instant on the bus clock and on the steady clock of the host.
struct CameraCycle {
  double bus_s = 0.0;  ///< s modulo 128
  TimeNs host = 0;     ///< ns
};

/// A camera on an IEEE 1394 bus, in a recording or in a simulation. Not thread-safe.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Returns false and sets `error` if the camera does not exist.
  virtual bool open(std::string& error) = 0;
  virtual std::optional<std::uint32_t> readRegister(std::uint64_t address) = 0;
  virtual bool writeRegister(std::uint64_t address, std::uint32_t value) = 0;
  virtual bool start(const CameraFormat& format, std::string& error) = 0;
  /// Waits up to `timeout` ns. Empty: no image arrived.
  virtual std::optional<CameraFrame> next(TimeNs timeout) = 0;
  virtual std::optional<CameraCycle> readCycle() = 0;
  virtual void stop() = 0;
  /// Returns whether the camera has disappeared.
  virtual bool isGone() const = 0;
  /// Returns whether a recording or simulation has ended.
  virtual bool isFinished() const { return false; }
};

/// Opens a camera of a bus by its GUID in hexadecimal, or the only one whose model begins with `model` if `guid` is
/// empty. Returns null and sets `error` if built without libdc1394.
std::unique_ptr<FrameSource> makeBusCamera(const std::string& guid, const std::string& model, std::string& error);

}  // namespace segway_drivers
