// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/twist_stream.hpp"

#include <cmath>
#include <iterator>

namespace urban_nav_core {

namespace {

// Maximum delay of a sensor relative to the reference, and tolerated shares of a span without measurement.
constexpr double kLongestExtrapolation = 0.12;  // s
constexpr double kExtrapolatedShare = 0.1, kBridgedShare = 0.2;
// Relative difference below which numbers are equal to all digits of a message: stamps do not divide evenly.
constexpr double kSameDigits = 1e-9;
// A moving device does not repeat its numbers for this time, s.
constexpr double kStuck = 0.25;
// Number of spans over which scatter and changes are averaged.
constexpr double kAveraged = 200.0;
// Variance of second differences of white noise, and multiple of the mean to which one difference is limited, since
// shocks are not noise.
constexpr double kSecondDifference = 6.0, kCutOff = 9.0;

double averaged(double before, double value) {
  if (!(before > 0.0)) return value;
  return before + (std::min(value, kCutOff * before) - before) / kAveraged;
}

}  // namespace

bool Coverage::suffices() const {
  const double whole = measured + extrapolated + bridged;
  return extrapolated <= std::max(kLongestExtrapolation, kExtrapolatedShare * whole) &&
         bridged <= kBridgedShare * whole;
}

void TwistStream::add(const MotionInput& input) {
  const double seconds = secondsBetween(input.from, input.to);
  if (!(seconds > 0.0) || !input.T_from_to.isFinite() || !input.information.allFinite()) return;
  if (!spans_.empty() && input.from < spans_.back().to) return;
  TwistSpan span;
  span.from = input.from;
  span.to = input.to;
  span.twist = logSe3(input.T_from_to) / seconds;
  for (int i = 0; i < 6; ++i)
    if (input.information(i, i) > 0.0) span.density[i] = 1.0 / (input.information(i, i) * seconds);
  if (!spans_.empty()) {
    const Vector6d change = span.twist - spans_.back().twist;
    repeated_ = change.norm() <= kSameDigits * span.twist.norm() ? repeated_ + seconds : 0.0;
    for (int i = 0; i < 6; ++i) walk_[i] = averaged(walk_[i], change[i] * change[i] / seconds);
    if (spans_.size() > 1) {
      const Vector3d second = (change - (spans_.back().twist - spans_[spans_.size() - 2].twist)).tail<3>();
      scatter_ = averaged(scatter_, second.squaredNorm() / (3.0 * kSecondDifference) * seconds);
    }
  }
  spans_.push_back(span);
}

void TwistStream::forget(StampNs before) {
  if (spans_.empty()) return;
  const auto first = std::partition_point(spans_.begin(), std::prev(spans_.end()),
                                          [&](const TwistSpan& span) { return span.to < before; });
  spans_.erase(spans_.begin(), first);
}

bool TwistStream::isStuck() const { return repeated_ > kStuck && !spans_.empty() && !spans_.back().twist.isZero(0.0); }

const TwistSpan& TwistStream::at(StampNs stamp) const {
  const auto found =
      std::partition_point(spans_.begin(), spans_.end(), [&](const TwistSpan& span) { return span.to <= stamp; });
  return found == spans_.end() ? spans_.back() : *found;
}

void TwistStream::archive(Archive& archive) {
  archive(spans_, repeated_, scatter_, walk_);
  for (std::size_t i = 0; i < spans_.size(); ++i)
    archive.require(spans_[i].from < spans_[i].to && (i == 0 || spans_[i - 1].to <= spans_[i].from),
                    "spans of a motion sensor are not in order of time");
}

}  // namespace urban_nav_core
