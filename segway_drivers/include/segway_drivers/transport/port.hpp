// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Time of the steady clock, ns.
TimeNs steadyTime();
/// Real time minus steady time, ns.
TimeNs realTimeOffset();

/// Byte connection to a device. Never blocks longer than asked. Not thread-safe.
class Port {
 public:
  enum class Outcome { Data, Nothing, Gone };
  struct ReadResult {
    Outcome outcome = Outcome::Nothing;
    std::size_t size = 0;
    TimeNs time = 0;  ///< right after the read, steady clock
  };

  virtual ~Port() = default;
  /// Waits up to `timeout` ns for bytes and reads what is there. Gone: the device has vanished.
  virtual ReadResult read(std::uint8_t* buffer, std::size_t size, TimeNs timeout) = 0;
  /// Returns false if not all bytes could be written at once.
  virtual bool write(ByteView bytes) = 0;
  virtual void setBaud(int baud) = 0;
  /// What could not be set as wished, such as low latency; empty if all was.
  virtual std::string remark() const { return {}; }
};

/// Opens a serial port in raw mode for exclusive use, without flow control, with low latency where the kernel offers
/// it. Returns null and sets `error` if the port cannot be opened.
std::unique_ptr<Port> openSerialPort(const std::string& path, std::string& error);
/// Connects to a TCP server, waiting up to a second. Returns null and sets `error` on failure.
std::unique_ptr<Port> openTcpPort(const std::string& host, int port, std::string& error);
/// Opens a CAN interface such as can0 of SocketCAN for the messages of an RMP; bytes are those of its USB packets.
/// Returns null and sets `error` where the kernel has no CAN or the interface is missing.
std::unique_ptr<Port> openCanPort(const std::string& interface, std::string& error);

}  // namespace segway_drivers
