// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Returns the time of the steady clock, ns.
TimeNs steadyTime();
/// Returns real time minus steady time, ns.
TimeNs realTimeOffset();

/// Byte connection to a device. Never blocks longer than requested. Not thread-safe.
class Port {
 public:
  enum class Outcome { Data, Nothing, Gone };
  struct ReadResult {
    Outcome outcome = Outcome::Nothing;
    std::size_t size = 0;
    TimeNs time = 0;  ///< immediately after the read, steady clock
  };

  virtual ~Port() = default;
  /// Waits up to `timeout` ns for bytes and reads the available ones. Gone: the device has disappeared.
  virtual ReadResult read(std::uint8_t* buffer, std::size_t size, TimeNs timeout) = 0;
  /// Returns false if not all bytes could be written immediately.
  virtual bool write(ByteView bytes) = 0;
  virtual void setBaud(int baud) = 0;
  /// Returns settings that could not be applied, such as low latency; empty if none.
  virtual std::string remark() const { return {}; }
};

/// Opens a serial port in raw mode for exclusive use, without flow control, with low latency if the kernel supports
/// it. Returns null and sets `error` if the port cannot be opened.
std::unique_ptr<Port> openSerialPort(const std::string& path, std::string& error);
/// Connects to a TCP server, waiting up to a second. Returns null and sets `error` on failure.
std::unique_ptr<Port> openTcpPort(const std::string& host, int port, std::string& error);
/// Opens a CAN interface such as can0 of SocketCAN for the messages of an RMP; bytes are those of its USB packets.
/// Returns null and sets `error` if the kernel has no CAN or the interface is missing.
std::unique_ptr<Port> openCanPort(const std::string& interface, std::string& error);

}  // namespace segway_drivers
