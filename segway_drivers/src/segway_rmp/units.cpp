// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/segway_rmp/units.hpp"

#include <algorithm>
#include <cmath>

namespace segway_drivers {

namespace {

constexpr double kRmpDegree = 3.14159265358979323846 / 180.0;
constexpr double kRmpMaxVelocityCounts = 1176, kRmpMaxTurnCounts = 1024;
constexpr std::uint16_t kRmpCommandId = 0x413;

double signedWord(const CanFrame& frame, std::size_t i) { return static_cast<std::int16_t>(frame.word(i)); }
double signedPair(const CanFrame& frame, std::size_t i) { return static_cast<std::int32_t>(frame.pair(i)); }

std::uint16_t saturatedCounts(double counts, double limit) {
  if (!std::isfinite(counts)) return 0;
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(std::clamp(counts, -limit, limit))));
}

void setWord(CanFrame& frame, std::size_t i, std::uint16_t word) {
  frame.data[2 * i] = static_cast<std::uint8_t>(word >> 8);
  frame.data[2 * i + 1] = static_cast<std::uint8_t>(word & 0xFF);
}

}  // namespace

std::optional<std::array<std::optional<double>, 4>> decodeRmpValues(const CanFrame& frame, const RmpUnits& units) {
  std::array<std::optional<double>, 4> values;
  const double angle = kRmpDegree / units.per_degree;
  switch (frame.id) {
    case 0x400:
    case 0x680: break;
    case 0x401:
      for (std::size_t i = 0; i < 4; ++i) values[i] = angle * signedWord(frame, i);
      break;
    case 0x402:
      values = {signedWord(frame, 0) / units.per_mps, signedWord(frame, 1) / units.per_mps,
                angle * signedWord(frame, 2), 0.01 * frame.word(3)};
      break;
    case 0x403:
      values = {signedPair(frame, 0) / units.per_metre, signedPair(frame, 2) / units.per_metre, {}, {}};
      break;
    case 0x404:
      values = {signedPair(frame, 0) / units.per_metre,
                360.0 * kRmpDegree * signedPair(frame, 2) / units.per_revolution,
                {},
                {}};
      break;
    case 0x405:
      values = {signedWord(frame, 0) / units.per_newton_metre, signedWord(frame, 1) / units.per_newton_metre, {}, {}};
      break;
    case 0x406: values = {frame.word(0), frame.word(1), 1.4 + 0.0125 * frame.word(2), 0.25 * frame.word(3)}; break;
    case 0x407:
      values = {signedWord(frame, 0) / units.per_mps, signedWord(frame, 1) / kRmpMaxTurnCounts, {}, {}};
      break;
    default: return std::nullopt;
  }
  return values;
}

CanFrame makeRmpVelocity(double velocity, double turn_rate, const RmpUnits& units) {
  CanFrame frame;
  frame.id = kRmpCommandId;
  setWord(frame, 0, saturatedCounts(velocity * units.per_mps, kRmpMaxVelocityCounts));
  setWord(frame, 1, saturatedCounts(turn_rate / kRmpDegree * units.per_degree, kRmpMaxTurnCounts));
  return frame;
}

CanFrame makeRmpConfiguration(const CanFrame& velocity, RmpConfiguration command, std::uint16_t argument) {
  CanFrame frame = velocity;
  setWord(frame, 2, static_cast<std::uint16_t>(command));
  setWord(frame, 3, argument);
  return frame;
}

}  // namespace segway_drivers
