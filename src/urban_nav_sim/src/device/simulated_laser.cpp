// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/simulated_laser.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace urban_nav_sim {

namespace {

constexpr int kSlowBaud = 9600, kFastBaud = 500000;
constexpr double kLaserLeastDelay = 3.33 + 1.0;  // ms, the scan and the first byte after it
constexpr double kReplyDelay = 0.01;             // s
constexpr std::uint8_t kLaserStatus = 0x10;
constexpr unsigned kOpenAir = 0x7FFF, kLargestRange = 0x7FF6;

std::uint16_t sickCrc(const DeviceBytes& bytes) {
  unsigned crc = 0, last = 0;
  for (const std::uint8_t byte : bytes) {
    const bool carry = (crc & 0x8000U) != 0;
    crc = crc << 1 & 0xFFFFU;
    if (carry) crc ^= 0x8005U;
    crc ^= byte | last << 8;
    last = byte;
  }
  return static_cast<std::uint16_t>(crc);
}

void appendSick(DeviceBytes& bytes, unsigned word) {
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFFU));
}

DeviceBytes sickTelegram(const DeviceBytes& payload) {
  DeviceBytes telegram = {0x02, 0x80};
  appendSick(telegram, static_cast<unsigned>(payload.size()));
  telegram.insert(telegram.end(), payload.begin(), payload.end());
  appendSick(telegram, sickCrc(telegram));
  return telegram;
}

unsigned rangeWord(float range) {
  if (!std::isfinite(range) || range <= 0.0F) return kOpenAir;
  return std::min(static_cast<unsigned>(std::lround(1000.0 * range)), kLargestRange);
}

DeviceBytes scanPayload(const LaserReading& reading, bool with_reflectivities, std::int64_t counter) {
  const auto count = static_cast<unsigned>(reading.ranges.size());
  DeviceBytes payload = {static_cast<std::uint8_t>(with_reflectivities ? 0xC4 : 0xB0)};
  appendSick(payload, 0x4000U | count);
  for (const float range : reading.ranges) appendSick(payload, rangeWord(range));
  if (with_reflectivities) {
    appendSick(payload, count);
    appendSick(payload, 1);
    appendSick(payload, count);
    for (std::size_t i = 0; i < count; ++i) {
      const float value = i < reading.reflectivities.size() ? reading.reflectivities[i] : 0.0F;
      payload.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F)));
    }
  }
  payload.push_back(static_cast<std::uint8_t>(counter & 0xFF));
  payload.push_back(kLaserStatus);
  return payload;
}

}  // namespace

SimulatedLaser::SimulatedLaser(std::vector<LaserReading> readings, const DeviceOptions& options)
    : SimulatedDevice(options, kLaserLeastDelay, kSlowBaud), readings_(std::move(readings)), configuration_(34, 0) {
  configuration_[5] = 0x05;
  configuration_[6] = 0x01;
  if (findDeviceFault(options.faults, DeviceFaultKind::Mode, 0.0) != nullptr) configuration_[5] = 0x3F;
  if (findDeviceFault(options.faults, DeviceFaultKind::Streaming, 0.0) != nullptr) {
    streams_ = true;
    setBaud(kFastBaud);
  }
}

void SimulatedLaser::boot() {
  setBaud(kSlowBaud);
  streams_ = installation_ = false;
  pending_.clear();
  const std::string text = "LMS291;S14;X1.15";
  DeviceBytes payload = {0x90};
  payload.insert(payload.end(), text.begin(), text.end());
  payload.push_back(kLaserStatus);
  sendNow(sickTelegram(payload));
}

/// Skips measurements once per fault, while the counters continue.
void SimulatedLaser::skipGap() {
  const DeviceFault* gap = fault(DeviceFaultKind::Gap);
  if (gap == nullptr || gap_done_) {
    gap_done_ = gap != nullptr;
    return;
  }
  gap_done_ = true;
  const auto lost = std::min(static_cast<std::size_t>(gap->value.value_or(1.0)), readings_.size() - next_);
  next_ += lost;
  sequence_ += static_cast<std::int64_t>(lost);
  counter_ += static_cast<std::int64_t>(lost);
}

bool SimulatedLaser::measure(double t) {
  const double rate = 1.0 + clock().skew;
  skipGap();
  while (next_ < readings_.size() && readings_[next_].time / rate <= t) {
    const LaserReading& reading = readings_[next_++];
    if (fault(DeviceFaultKind::Clock) == nullptr) {
      restarted_ = false;
    } else if (!restarted_) {
      restarted_ = true;
      counter_ = 0;
    }
    if (streams_ && baud() == kFastBaud)
      sendMeasurement(sickTelegram(scanPayload(reading, with_reflectivities_, counter_)), reading.time / rate,
                      sequence_);
    ++sequence_;
    ++counter_;
  }
  return next_ < readings_.size();
}

void SimulatedLaser::takeByte(std::uint8_t byte) {
  if (pending_.empty() && byte != 0x02) return;
  pending_.push_back(byte);
  if (pending_.size() == 2 && byte != 0x00) pending_.clear();
  if (pending_.size() < 4) return;
  const std::size_t length = pending_[2] + 256U * pending_[3];
  if (length == 0 || length > 100) {
    pending_.clear();
    return;
  }
  if (pending_.size() < length + 6) return;
  const DeviceBytes telegram(pending_.begin(), pending_.end() - 2);
  const unsigned stated = pending_[pending_.size() - 2] + 256U * pending_.back();
  pending_.clear();
  if (stated != sickCrc(telegram) || fault(DeviceFaultKind::Nak) != nullptr) {
    sendReply({0x15}, kReplyDelay);
    return;
  }
  answer(DeviceBytes(telegram.begin() + 4, telegram.end()));
}

void SimulatedLaser::reply(DeviceBytes payload) {
  payload.push_back(kLaserStatus);
  DeviceBytes bytes = {0x06};
  const DeviceBytes telegram = sickTelegram(payload);
  bytes.insert(bytes.end(), telegram.begin(), telegram.end());
  sendReply(std::move(bytes), kReplyDelay);
}

void SimulatedLaser::answer(const DeviceBytes& payload) {
  const std::string type = "LMS291;S14;X1.15    ";
  switch (payload[0]) {
    case 0x10: reply({0x91}); break;
    case 0x20: answerMode(payload); break;
    case 0x31: {
      DeviceBytes status(153, 0);
      status[0] = 0xB1;
      status[8] = streams_ ? 0x50 : 0x25;
      status[107] = 90;
      status[109] = 50;
      status[116] = baud() == kFastBaud ? 0x01 : 0x67;
      status[117] = 0x80;
      status[122] = configuration_[6];
      reply(status);
      break;
    }
    case 0x32: reply({0xB2}); break;
    case 0x3A: {
      DeviceBytes text = {0xBA};
      text.insert(text.end(), type.begin(), type.end());
      reply(text);
      break;
    }
    case 0x74: {
      DeviceBytes data = {0xF4};
      data.insert(data.end(), configuration_.begin(), configuration_.end());
      reply(data);
      break;
    }
    case 0x77: {
      const bool accepted = installation_ && payload.size() == configuration_.size() + 1;
      if (accepted) configuration_.assign(payload.begin() + 1, payload.end());
      DeviceBytes data = {0xF7, static_cast<std::uint8_t>(accepted ? 1 : 0)};
      data.insert(data.end(), configuration_.begin(), configuration_.end());
      reply(data);
      break;
    }
    default: reply({0x92}); break;
  }
}

void SimulatedLaser::answerMode(const DeviceBytes& payload) {
  if (payload.size() < 2) {
    reply({0xA0, 0x02});
    return;
  }
  const std::string password(payload.begin() + 2, payload.end());
  std::uint8_t result = 0;
  int rate = baud();
  switch (payload[1]) {
    case 0x00:
      installation_ = password == "SICK_LMS";
      result = installation_ ? 0 : 1;
      break;
    case 0x25: streams_ = installation_ = false; break;
    case 0x24:
    case 0x50:
      streams_ = true;
      installation_ = false;
      with_reflectivities_ = payload[1] == 0x50;
      break;
    case 0x48: rate = kFastBaud; break;
    case 0x40: rate = 38400; break;
    case 0x41: rate = 19200; break;
    case 0x42: rate = kSlowBaud; break;
    default: result = 2; break;
  }
  reply({0xA0, result});
  setBaud(rate);
}

}  // namespace urban_nav_sim
