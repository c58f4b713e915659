// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/simulated_base.hpp"

#include <array>
#include <cmath>

namespace urban_nav_sim {

namespace {

constexpr double kBasePeriod = 0.01, kBaseMemory = 0.4;  // s
constexpr int kBaseBaud = 460800;
constexpr double kBaseTrack = 0.54, kFullTurn = 6.283185307179586;
constexpr std::size_t kPacketSize = 18;

std::uint8_t packetChecksum(const DeviceBytes& bytes, std::size_t size) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += bytes[i];
  sum = (sum & 0xFFU) + (sum >> 8);
  sum = (sum & 0xFFU) + (sum >> 8);
  return static_cast<std::uint8_t>(-static_cast<int>(sum & 0xFFU) & 0xFF);
}

void appendPacket(DeviceBytes& bytes, unsigned id, const std::array<unsigned, 4>& words) {
  DeviceBytes packet = {
      0xF0, 0x55, 0xAA, 0, static_cast<std::uint8_t>(id >> 3), static_cast<std::uint8_t>((id & 7U) << 5), 0, 0, 0};
  for (const unsigned word : words) {
    packet.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFFU));
    packet.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  }
  packet.push_back(packetChecksum(packet, packet.size()));
  bytes.insert(bytes.end(), packet.begin(), packet.end());
}

unsigned counts(double value) { return static_cast<unsigned>(static_cast<int>(std::lround(value))); }
unsigned lowWord(unsigned value) { return value & 0xFFFFU; }
unsigned highWord(unsigned value) { return value >> 16; }

}  // namespace

SimulatedBase::SimulatedBase(std::vector<WheelReading> readings, const DeviceOptions& options)
    : SimulatedDevice(options, 0.0, kBaseBaud), readings_(std::move(readings)) {}

void SimulatedBase::boot() {
  forward_ = yaw_ = 0.0;
  servo_frames_ = 0;
  pending_.clear();
}

bool SimulatedBase::measure(double t) {
  const double rate = 1.0 + clock().skew;
  while (static_cast<double>(cycle_) * kBasePeriod / rate <= t) {
    const double time = static_cast<double>(cycle_) * kBasePeriod;
    while (next_ < readings_.size() && readings_[next_].time <= time) {
      velocity_ = readings_[next_].velocity;
      yaw_rate_ = readings_[next_].yaw_rate;
      ++next_;
    }
    forward_ += velocity_ * kBasePeriod;
    yaw_ += yaw_rate_ * kBasePeriod;
    if (now() - commanded_at_ > kBaseMemory) command_velocity_ = command_turn_ = 0;
    sendMeasurement(cyclePackets(), time / rate, cycle_);
    ++cycle_;
    ++servo_frames_;
    if (next_ >= readings_.size()) return false;
  }
  return true;
}

DeviceBytes SimulatedBase::cyclePackets() const {
  const double per_degree = 7.8 * 360.0 / kFullTurn, half = 0.5 * kBaseTrack;
  const unsigned left = counts(332.0 * (velocity_ - half * yaw_rate_)),
                 right = counts(332.0 * (velocity_ + half * yaw_rate_));
  const unsigned left_travel = counts(33215.0 * (forward_ - half * yaw_)),
                 right_travel = counts(33215.0 * (forward_ + half * yaw_));
  const unsigned forward = counts(33215.0 * forward_), yaw = counts(112644.0 * yaw_ / kFullTurn);
  DeviceBytes bytes;
  appendPacket(bytes, 0x400, {0, 0, 0, 0});
  appendPacket(bytes, 0x401, {0, 0, 0, 0});
  appendPacket(bytes, 0x402, {left, right, counts(per_degree * yaw_rate_), servo_frames_ & 0xFFFFU});
  appendPacket(bytes, 0x403,
               {lowWord(left_travel), highWord(left_travel), lowWord(right_travel), highWord(right_travel)});
  appendPacket(bytes, 0x404, {lowWord(forward), highWord(forward), lowWord(yaw), highWord(yaw)});
  appendPacket(bytes, 0x405, {0, 0, 0, 0});
  appendPacket(bytes, 0x406, {mode_, 0, 900, 288});
  appendPacket(bytes, 0x407, {command_velocity_, command_turn_, 0, 0});
  return bytes;
}

void SimulatedBase::takeByte(std::uint8_t byte) {
  pending_.push_back(byte);
  while (!pending_.empty() && (pending_[0] != 0xF0 || (pending_.size() > 1 && pending_[1] != 0x55)))
    pending_.erase(pending_.begin());
  if (pending_.size() < kPacketSize) return;
  if (packetChecksum(pending_, kPacketSize - 1) != pending_[kPacketSize - 1]) {
    pending_.erase(pending_.begin());
    return;
  }
  const auto word = [this](std::size_t at) { return pending_[at] * 256U + pending_[at + 1]; };
  if (word(6) == 0x413 && fault(DeviceFaultKind::Nak) == nullptr) {
    command_velocity_ = word(9);
    command_turn_ = word(11);
    commanded_at_ = now();
    if (word(13) == 0x10) mode_ = word(15);
    if (word(13) == 0x32 && (word(15) & 4U) != 0) yaw_ = 0.0;
    if (word(13) == 0x32 && (word(15) & 8U) != 0) forward_ = 0.0;
  }
  pending_.clear();
}

}  // namespace urban_nav_sim
