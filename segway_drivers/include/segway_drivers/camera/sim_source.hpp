// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "segway_drivers/camera/frame_source.hpp"

namespace segway_drivers {

/// Frame of a simulated camera without the words that the camera embeds.
struct SimFrame {
  double time = 0.0;  ///< s since the session began
  Bytes bytes;
  TimeNs recorded = 0;  ///< stamp in the recording, ns
};

/// Gives the frames of a session in order of time, and nothing after the last.
using FrameReader = std::function<std::optional<SimFrame>()>;

/// What can go wrong with a simulated camera for some time, s since the session began.
struct SimCameraFault {
  enum class Kind {
    Unplug,   ///< the camera vanishes from the bus
    Silence,  ///< no frame comes
    Corrupt,  ///< packets are missing in each frame
    Power     ///< the camera is off; its registers and its counter begin again
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

struct SimCameraOptions {
  enum class Model { Bumblebee2, Ladybug2 } model = Model::Bumblebee2;
  std::uint32_t pattern = 0x59595959;  ///< register 0x1040, "YYYY"
  double transfer = 0.02;              ///< s from the middle of the exposure to the arrival
  double bus_begin = 0.0;              ///< s, time of the bus when the session begins
  double bus_skew = 0.0;               ///< bus seconds per second less 1
  /// Begin of the session by the clock, ns; empty while it has none: there is no camera yet. Asked until it has one.
  /// Without the function a session begins when the camera is first opened.
  std::function<std::optional<TimeNs>()> begin;
  bool is_paced = false;  ///< `read` waits until a frame is wanted: what is late is not lost in the ring of buffers
  std::vector<SimCameraFault> faults;
};

/// A camera on a simulated bus: a map of registers, frames at their times, and the clock of the bus, which wraps after
/// 128 s. A frame holds the embedded words that its register asks for. `read` gives the frames in order of time, and
/// nothing after the last; its own duration delays frames. Frames that nobody fetched for 0.4 s are lost, as in a ring
/// of buffers, unless the session is paced, and so are those from before the stream was started. Not thread-safe.
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
  TimeNs started_ = 0, in_ring_ = 0;  // of the stream; of the newest frame
  std::map<std::uint64_t, std::uint32_t> registers_;
  std::uint32_t sequence_ = 0;
  bool streams_ = false, finished_ = false, was_off_ = false;
};

}  // namespace segway_drivers
