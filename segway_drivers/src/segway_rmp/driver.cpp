// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/segway_rmp/driver.hpp"

#include <algorithm>
#include <cmath>

#include "segway_drivers/segway_rmp/units.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kRmpCommandPeriod = 20'000'000, kRmpStalled = 200'000'000, kRmpLost = 1'000'000'000;  // ns
constexpr TimeNs kRmpUnheeded = 500'000'000;
constexpr int kRmpBaud = 460800;

}  // namespace

RmpDriver::RmpDriver(const Options& options) : stream_(options.latency), guard_(options.limits) {
  stream_.on_frame = [this](const RmpStampedFrame& frame) { takeFrame(frame); };
}

void RmpDriver::begin(TimeNs now) {
  setBaud(kRmpBaud);
  stream_.clear();
  odometry_.restart();
  now_ = last_frame_ = now;
  next_command_ = now;
  setState(DriverState::Identifying);
}

void RmpDriver::feed(ByteView chunk, const ChunkArrival& arrival) {
  now_ = std::max(now_, arrival.time);
  stream_.feed(chunk, arrival);
}

void RmpDriver::takeFrame(const RmpStampedFrame& frame) {
  last_frame_ = now_;
  guard_.reportBase(now_);
  setState(DriverState::Streaming);
  if (frame.frame.id == 0x404) odometry_.add(frame.frame, frame.arrival);
  if (frame.frame.id == 0x406 && identity().empty()) setIdentity("RMP, mode " + std::to_string(frame.frame.word(0)));
  if (frame.frame.id == 0x407) {
    const double in_force = *(*decodeRmpValues(frame.frame))[0];
    if (std::abs(commanded_) < 0.05 || in_force != 0.0) unheeded_since_ = now_;
    if (now_ - unheeded_since_ > kRmpUnheeded) {
      report(true, "commands are ignored: check whether the base was switched on before the computer");
      unheeded_since_ = now_;
    }
  }
  if (on_frame) on_frame(frame);
}

void RmpDriver::tick(TimeNs now) {
  now_ = now;
  stream_.expire(now);
  if (now >= next_command_) {
    const RmpCommand command = guard_.step(now);
    commanded_ = command.velocity;
    write(makeRmpPacket(makeRmpVelocity(command.velocity, command.turn_rate)));
    next_command_ = std::max(next_command_ + kRmpCommandPeriod, now - kRmpCommandPeriod);
  }
  const TimeNs silent = now - last_frame_;
  if (silent > kRmpStalled && state() == DriverState::Streaming) setState(DriverState::Stalled, "no message for 0.2 s");
  if (silent > kRmpLost && state() == DriverState::Stalled) odometry_.restart();
}

}  // namespace segway_drivers
