// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/simulated_imu.hpp"

#include <cmath>
#include <cstring>
#include <string>

namespace urban_nav_sim {

namespace {

constexpr int kImuBaud = 115200;
constexpr double kImuLeastDelay = 2.5;    // ms, with orientation
constexpr double kImuReplyDelay = 0.005;  // s

DeviceBytes imuMessage(std::uint8_t mid, const DeviceBytes& data) {
  DeviceBytes message = {0xFA, 0xFF, mid, static_cast<std::uint8_t>(data.size())};
  message.reserve(data.size() + 5);  // GCC 12 warns of insert() here
  for (const std::uint8_t byte : data) message.push_back(byte);
  unsigned sum = 0;
  for (std::size_t i = 1; i < message.size(); ++i) sum += message[i];
  message.push_back(static_cast<std::uint8_t>(-static_cast<int>(sum & 0xFFU) & 0xFF));
  return message;
}

void appendImuFloat(DeviceBytes& bytes, double value) {
  const auto single = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof(bits));
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift & 0xFFU));
}

/// Returns sensor to NWU (x north, y west, z up) from sensor to ENU: a rotation by -90 deg about z from the left.
std::array<double, 4> nwuFromEnu(const std::array<double, 4>& q) {
  const double h = std::sqrt(0.5);
  return {h * (q[0] + q[3]), h * (q[1] + q[2]), h * (q[2] - q[1]), h * (q[3] - q[0])};
}

}  // namespace

SimulatedImu::SimulatedImu(std::vector<ImuReading> readings, const DeviceOptions& options)
    : SimulatedDevice(options, kImuLeastDelay, kImuBaud), readings_(std::move(readings)) {
  if (findDeviceFault(options.faults, DeviceFaultKind::Mode, 0.0) != nullptr) mode_ = {0, 2};
}

void SimulatedImu::boot() {
  counter_ = 0;
  measures_ = true;
  pending_.clear();
  sendNow(imuMessage(0x3E, {}));
}

bool SimulatedImu::measure(double t) {
  const double rate = 1.0 + clock().skew;
  while (next_ < readings_.size() && readings_[next_].time / rate <= t) {
    const ImuReading& reading = readings_[next_++];
    const bool restart = fault(DeviceFaultKind::Clock) != nullptr;
    if (restart && !restarted_) counter_ = 0;
    restarted_ = restart;
    if (measures_ && fault(DeviceFaultKind::Gap) == nullptr) {
      DeviceBytes data;
      if ((mode_[1] & 2U) != 0)
        for (const auto* vector : {&reading.acceleration, &reading.rate, &reading.field})
          for (const double value : *vector) appendImuFloat(data, value);
      if ((mode_[1] & 4U) != 0)
        for (const double value : nwuFromEnu(reading.orientation)) appendImuFloat(data, value);
      if ((settings_[3] & 3U) == 1) {
        data.push_back(static_cast<std::uint8_t>(counter_ >> 8 & 0xFFU));
        data.push_back(static_cast<std::uint8_t>(counter_ & 0xFFU));
      }
      sendMeasurement(imuMessage(0x32, data), reading.time / rate, sequence_);
    }
    ++counter_;
    ++sequence_;
  }
  return next_ < readings_.size();
}

void SimulatedImu::takeByte(std::uint8_t byte) {
  if (pending_.empty() && byte != 0xFA) return;
  pending_.push_back(byte);
  if (pending_.size() < 4) return;
  const std::size_t size = pending_[3] + 5U;
  if (pending_.size() < size) return;
  unsigned sum = 0;
  for (std::size_t i = 1; i < size; ++i) sum += pending_[i];
  const std::uint8_t mid = pending_[2];
  const DeviceBytes data(pending_.begin() + 4, pending_.end() - 1);
  pending_.clear();
  if ((sum & 0xFFU) == 0) answer(mid, data);
}

void SimulatedImu::answer(std::uint8_t mid, const DeviceBytes& data) {
  const auto reply = [&](const DeviceBytes& content) {
    sendReply(imuMessage(static_cast<std::uint8_t>(mid + 1), content), kImuReplyDelay);
  };
  if (fault(DeviceFaultKind::Nak) != nullptr) {
    sendReply(imuMessage(0x42, {0x04}), kImuReplyDelay);
    return;
  }
  const std::string product = "MTi-28A53G35";
  switch (mid) {
    case 0x30:
      measures_ = false;
      reply({});
      break;
    case 0x10:
      measures_ = true;
      reply({});
      break;
    case 0x00: reply({0x00, 0x30, 0x12, 0x34}); break;
    case 0x1C: reply(DeviceBytes(product.begin(), product.end())); break;
    case 0x12: reply({2, 4, 1}); break;
    case 0x04: answerSetting(mid, period_, data); break;
    case 0xD0: answerSetting(mid, mode_, data); break;
    case 0xD2: answerSetting(mid, settings_, data); break;
    case 0xD4: answerSetting(mid, skip_, data); break;
    case 0x40:
      reply({});
      boot();
      break;
    case 0x3F: measures_ = false; break;
    default: sendReply(imuMessage(0x42, {0x04}), kImuReplyDelay); break;
  }
}

void SimulatedImu::answerSetting(std::uint8_t mid, DeviceBytes& setting, const DeviceBytes& data) {
  const bool writes = data.size() == setting.size();
  if (writes) setting = data;
  sendReply(imuMessage(static_cast<std::uint8_t>(mid + 1), writes ? DeviceBytes() : setting), kImuReplyDelay);
}

}  // namespace urban_nav_sim
