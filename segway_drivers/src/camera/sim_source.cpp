// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/sim_source.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "segway_drivers/camera/bus_time.hpp"
#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kRing = 400'000'000;  // ns, lifetime of a frame in the ring buffer
constexpr std::uint64_t kSimPattern = 0x1040, kSimDataFormat = 0x1048, kSimEmbedded = 0x12F8, kSimSensor = 0x1F28,
                        kSimBaseSerial = 0x1F20, kSimHeadSerial = 0x1F80;
constexpr std::size_t kLadybugSequenceAt = 0x20;
constexpr double kTicksPerSecond = 24.576e6;

std::uint32_t busTimeWord(double seconds) {
  const auto ticks = static_cast<std::uint64_t>(std::llround(seconds * kTicksPerSecond)) % (128U * 24'576'000U);
  const auto whole = static_cast<std::uint32_t>(ticks / 24'576'000U),
             rest = static_cast<std::uint32_t>(ticks % 24'576'000U);
  return whole << 25 | (rest / 3072U) << 12 | rest % 3072U;
}

void putBig32(Bytes& bytes, std::size_t at, std::uint32_t word) {
  if (at + 4 > bytes.size()) return;
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(word >> (24 - 8 * i));
}

}  // namespace

SimClock realSimClock() {
  return {steadyTime, [](TimeNs until) {
            const timespec wake{static_cast<time_t>(until / 1'000'000'000), static_cast<long>(until % 1'000'000'000)};
            clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
          }};
}

SimSource::SimSource(FrameReader read, SimCameraOptions options, SimClock clock)
    : read_(std::move(read)), options_(std::move(options)), clock_(std::move(clock)) {
  powerOn();
}

double SimSource::elapsed() const { return begin_ ? 1e-9 * static_cast<double>(clock_.now() - *begin_) : 0.0; }

bool SimSource::isFaulty(SimCameraFault::Kind kind, double t) const {
  return std::any_of(options_.faults.begin(), options_.faults.end(), [&](const SimCameraFault& fault) {
    return fault.kind == kind && t >= fault.start && t < fault.start + fault.duration;
  });
}

bool SimSource::isOffBus(double t) const {
  return isFaulty(SimCameraFault::Kind::Unplug, t) || isFaulty(SimCameraFault::Kind::Power, t);
}

bool SimSource::isGone() const { return isOffBus(elapsed()); }

void SimSource::powerOn() {
  registers_ = {{kSimPattern, options_.pattern}, {kSimDataFormat, 0},
                {kSimEmbedded, 0x80000000},      {kSimSensor, 0x1},
                {kSimBaseSerial, 0x00ABCDEF},    {kSimHeadSerial, 0x00FEDCBA}};
  sequence_ = 0;
}

double SimSource::busTime(double elapsed_s) const {
  const double time = std::fmod(options_.bus_begin + elapsed_s * (1.0 + options_.bus_skew), kBusTimeWrap);
  return time < 0.0 ? time + kBusTimeWrap : time;
}

bool SimSource::open(std::string& error) {
  streams_ = false;
  if (!begin_) begin_ = options_.begin ? options_.begin() : clock_.now();
  if (!begin_) {
    error = "the session of the simulated devices has not started";
    return false;
  }
  if (isGone()) {
    error = "camera not found on the simulated bus";
    return false;
  }
  if (was_off_) powerOn();
  was_off_ = false;
  return true;
}

std::optional<std::uint32_t> SimSource::readRegister(std::uint64_t address) {
  const auto found = registers_.find(address);
  if (isGone() || found == registers_.end()) return std::nullopt;
  return found->second;
}

bool SimSource::writeRegister(std::uint64_t address, std::uint32_t value) {
  if (isGone()) return false;
  registers_[address] = value;
  return true;
}

bool SimSource::start(const CameraFormat&, std::string& error) {
  if (isGone()) {
    error = "the camera disappeared from the simulated bus";
    return false;
  }
  streams_ = true;
  started_ = clock_.now();
  in_ring_ = std::max(in_ring_, started_);
  return true;
}

TimeNs SimSource::dueTime(const SimFrame& frame) const {
  return begin_.value_or(0) + static_cast<TimeNs>(1e9 * (frame.time + options_.transfer));
}

/// A camera exposes while its driver works, whereas a recording is decoded by the thread of the driver. The time of
/// decoding is therefore added to the arrival of the frame: a slow machine delays the session without loss.
void SimSource::read() {
  const TimeNs begin = clock_.now();
  waiting_ = read_();
  if (waiting_) in_ring_ = std::max(in_ring_, dueTime(*waiting_)) + (clock_.now() - begin);
}

std::optional<CameraFrame> SimSource::next(TimeNs timeout) {
  const TimeNs asked = clock_.now(), deadline = asked + timeout;
  while (true) {
    if (isFaulty(SimCameraFault::Kind::Power, elapsed())) was_off_ = true;
    if (!waiting_ && !finished_) read();
    finished_ = finished_ || !waiting_;
    const TimeNs due = waiting_ && begin_ ? dueTime(*waiting_) : deadline + 1;
    if (due > deadline || !streams_ || isGone()) {
      clock_.sleep(deadline);
      return std::nullopt;
    }
    if (due > clock_.now()) clock_.sleep(due);
    SimFrame frame = std::move(*waiting_);
    waiting_.reset();
    const bool lost = isGone() || isOffBus(frame.time) || isFaulty(SimCameraFault::Kind::Silence, frame.time) ||
                      due < started_ || (!options_.is_paced && asked > in_ring_ + kRing);
    if (!lost) embed(frame);
    ++sequence_;
    if (lost) continue;
    return CameraFrame{std::move(frame.bytes), clock_.now(), isFaulty(SimCameraFault::Kind::Corrupt, frame.time)};
  }
}

void SimSource::embed(SimFrame& frame) const {
  const std::uint32_t time = busTimeWord(busTime(frame.time));
  if (options_.model == SimCameraOptions::Model::Ladybug2) {
    putBig32(frame.bytes, 0, time);
    putBig32(frame.bytes, kLadybugSequenceAt, sequence_);
    return;
  }
  if (registers_.at(kSimDataFormat) != 0x80000000)
    for (std::size_t i = 0; i + 1 < frame.bytes.size(); i += 2) std::swap(frame.bytes[i], frame.bytes[i + 1]);
  if ((registers_.at(kSimEmbedded) & 0x47U) != 0x47U) return;
  putBig32(frame.bytes, 0, time);
  putBig32(frame.bytes, 4, 0x82000100);
  putBig32(frame.bytes, 8, 0x82000200);
  putBig32(frame.bytes, 12, sequence_);
}

std::optional<CameraCycle> SimSource::readCycle() {
  if (isGone() || !begin_) return std::nullopt;
  // One reading of the clock for both, since the thread may be preempted between two.
  const TimeNs now = clock_.now();
  return CameraCycle{busTime(1e-9 * static_cast<double>(now - *begin_)), now};
}

}  // namespace segway_drivers
