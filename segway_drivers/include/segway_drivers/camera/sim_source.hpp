// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "segway_drivers/camera/frame_source.hpp"

namespace segway_drivers {

/// Frame of a simulated camera without embedded words.
struct SimFrame {
  double time = 0.0;  ///< s since the start of the session
  Bytes bytes;
  TimeNs recorded = 0;  ///< stamp in the recording, ns
};

/// Returns the frames of a session in order of time, and nothing after the last.
using FrameReader = std::function<std::optional<SimFrame>()>;

/// Fault of a simulated camera for an interval of time, s since the start of the session.
struct SimCameraFault {
  enum class Kind {
    Unplug,   ///< the camera disappears from the bus
    Silence,  ///< no frame arrives
    Corrupt,  ///< packets are missing in each frame
    Power     ///< the camera is off; registers and counter are reset
  } kind = Kind::Silence;
  double start = 0.0, duration = 1.0;
};

/// Clock of a simulation: real or stepped.
struct SimClock {
  std::function<TimeNs()> now;
  std::function<void(TimeNs)> sleep;  ///< until a time
};
/// The steady clock of this machine.
SimClock realSimClock();
/// Options of a simulated IEEE 1394 camera.
struct SimCameraOptions {
  enum class Model { Bumblebee2, Ladybug2 } model = Model::Bumblebee2;
  std::uint32_t pattern = 0x59595959;  ///< register 0x1040, "YYYY"
  double transfer = 0.02;              ///< s from the middle of the exposure to the arrival
  double bus_begin = 0.0;              ///< s, bus time at the start of the session
  double bus_skew = 0.0;               ///< bus seconds per second minus 1
  /// Returns the start of the session on the clock, ns; empty while unknown: the camera does not exist yet. Called
  /// until known. Without the function a session starts when the camera is first opened.
  std::function<std::optional<TimeNs>()> begin;
  bool is_paced = false;  ///< `read` waits until a frame is requested; late frames are not lost in the ring buffer
  std::vector<SimCameraFault> faults;
};

/// A camera on a simulated bus: registers, frames at their times, and the bus clock, which wraps after 128 s. A frame
/// contains the embedded words selected by its register. `read` returns the frames in order of time, and nothing after
/// the last; its duration delays frames. Frames not fetched within 0.4 s are lost, as in a ring buffer, unless the
/// session is paced; frames before the start of the stream are lost too. Not thread-safe.
class SimSource : public FrameSource {
 public:
  SimSource(FrameReader read, SimCameraOptions options, SimClock clock);

  bool open(std::string& error) override;
  std::optional<std::uint32_t> readRegister(std::uint64_t address) override;
  bool writeRegister(std::uint64_t address, std::uint32_t value) override;
  bool start(const CameraFormat& format, std::string& error) override;
  std::optional<CameraFrame> next(TimeNs timeout) override;
  std::optional<CameraCycle> readCycle() override;
  void stop() override { streams_ = false; }
  bool isGone() const override;
  bool isFinished() const override { return finished_; }

 private:
  double elapsed() const;
  bool isFaulty(SimCameraFault::Kind kind, double t) const;
  bool isOffBus(double t) const;
  double busTime(double elapsed_s) const;
  void powerOn();
  void embed(SimFrame& frame) const;
  TimeNs dueTime(const SimFrame& frame) const;
  void read();

  FrameReader read_;
  SimCameraOptions options_;
  SimClock clock_;
  std::optional<TimeNs> begin_;
  std::optional<SimFrame> waiting_;
  TimeNs started_ = 0, in_ring_ = 0;  // start of the stream; time of the newest frame
  std::map<std::uint64_t, std::uint32_t> registers_;
  std::uint32_t sequence_ = 0;
  bool streams_ = false, finished_ = false, was_off_ = false;
};

}  // namespace segway_drivers
