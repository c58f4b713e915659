// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/simulated_device.hpp"

#include <cmath>

namespace urban_nav_sim {

namespace {

DeviceTime deviceNanoseconds(double seconds) { return static_cast<DeviceTime>(std::llround(1e9 * seconds)); }

}  // namespace

SimulatedDevice::SimulatedDevice(DeviceOptions options, double least_delay_ms, int baud)
    : options_(std::move(options)), random_(options_.seed), baud_(baud) {
  delay_ = options_.delay.value_or(DelayModel{DelayModel::Kind::Constant, least_delay_ms, 0.0, least_delay_ms});
}

void SimulatedDevice::start(DeviceTime now) { start_ = now_ = now; }

bool SimulatedDevice::isPlugged(DeviceTime now) const {
  return findDeviceFault(options_.faults, DeviceFaultKind::Unplug, 1e-9 * static_cast<double>(now - start_)) == nullptr;
}

void SimulatedDevice::watchPower() {
  const DeviceFault* power = fault(DeviceFaultKind::Power);
  if (power != nullptr) {
    off_ = true;
    boots_at_ = power->start + power->duration + power->value.value_or(1.0);
    line_.clear();
  } else if (off_ && now_s_ >= boots_at_) {
    off_ = false;
    boot();
  }
}

void SimulatedDevice::receive(const DeviceBytes& bytes, int host_baud, DeviceTime now) {
  now_ = now;
  now_s_ = 1e-9 * static_cast<double>(now - start_);
  watchPower();
  if (off_ || host_baud != baud_) return;
  for (const std::uint8_t byte : bytes) takeByte(byte);
}

DeviceBytes SimulatedDevice::transmit(int host_baud, DeviceTime now) {
  now_ = now;
  now_s_ = 1e-9 * static_cast<double>(now - start_);
  watchPower();
  if (const DeviceFault* rate = fault(DeviceFaultKind::Baud)) baud_ = static_cast<int>(rate->value.value_or(9600));
  measured_all_ = !measure(now_s_);
  return line_.take(host_baud, now);
}

void SimulatedDevice::sendMeasurement(DeviceBytes frame, double t, std::int64_t sequence) {
  truth_.push_back({sequence, start_ + deviceNanoseconds(t)});
  if (off_ || fault(DeviceFaultKind::Silence) != nullptr) return;
  const DeviceFault* longer = fault(DeviceFaultKind::Delay);
  const double least = delay_.min_ms + (longer != nullptr ? longer->value.value_or(5.0) : 0.0);
  const double excess = delay_.drawExcess(random_, 1e3 * t + least);
  line_.push(damage(std::move(frame)), start_ + deviceNanoseconds(t + 1e-3 * least), baud_,
             deviceNanoseconds(1e-3 * excess));
}

void SimulatedDevice::sendNow(DeviceBytes bytes) {
  if (!off_) line_.push(std::move(bytes), now_, baud_);
}

void SimulatedDevice::sendReply(DeviceBytes reply, double delay_s) {
  if (off_) return;
  const DeviceFault* late = fault(DeviceFaultKind::Late);
  if (late != nullptr) delay_s += 1e-3 * late->value.value_or(200.0);
  line_.push(std::move(reply), now_ + deviceNanoseconds(delay_s), baud_);
}

DeviceBytes SimulatedDevice::damage(DeviceBytes frame) {
  const auto draw = [this] { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); };
  const DeviceFault* flip = fault(DeviceFaultKind::Flip);
  if (flip != nullptr && draw() < flip->value.value_or(0.01))
    frame[random_() % frame.size()] ^= static_cast<std::uint8_t>(1U << random_() % 8);
  const DeviceFault* cut = fault(DeviceFaultKind::Cut);
  if (cut != nullptr && draw() < cut->value.value_or(0.1)) frame.resize(1 + random_() % (frame.size() - 1));
  DeviceBytes before;
  if (const DeviceFault* garbage = fault(DeviceFaultKind::Garbage)) {
    before.resize(static_cast<std::size_t>(garbage->value.value_or(100.0)));
    for (std::uint8_t& byte : before) byte = static_cast<std::uint8_t>(random_() % 4 == 0 ? frame[0] : random_());
  }
  if (fault(DeviceFaultKind::Length) != nullptr) before.insert(before.end(), {frame[0], frame[1], 0xFF, 0xFF});
  frame.insert(frame.begin(), before.begin(), before.end());
  return frame;
}

}  // namespace urban_nav_sim
