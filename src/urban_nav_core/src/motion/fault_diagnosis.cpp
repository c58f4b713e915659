// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/fault_diagnosis.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/inertial/axis_map.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_core {

using Kind = MotionFault::Kind;

namespace {

constexpr double kFrozen = 0.5;            // s
constexpr double kGoodCorrelation = 0.8;   // correlation required for a diagnosis
constexpr double kLinear = 0.95;           // correlation required for a scale
constexpr double kAxesGain = 0.3;          // increase of correlation required for other axes
constexpr double kLeastScaleError = 0.08;  // relative
constexpr double kLongestDelay = 2.0;      // s
constexpr std::size_t kFewestSteps = 8;
constexpr double kLeastHistory = 4.0;  // s, required for axes and delays
constexpr double kFaultDegrees = 180.0 / M_PI;

/// Correlation of pairs of vectors, means removed.
struct Correlation {
  double cosine = 0.0, ratio = 0.0;  ///< ratio of the second to the first
};

template <typename Second>
Correlation correlate(const std::vector<ComparedStep>& steps, int lag, const Second& second) {
  Vector3d mean_a = Vector3d::Zero(), mean_b = Vector3d::Zero();
  double aa = 0.0, bb = 0.0, ab = 0.0;
  const auto size = static_cast<int>(steps.size());
  int count = 0;
  for (int pass = 0; pass < 2; ++pass) {
    for (int i = std::max(0, -lag); i + std::max(0, lag) < size; ++i) {
      const Vector3d& a = steps[static_cast<std::size_t>(i)].by_reference;
      const Vector3d b = second(steps[static_cast<std::size_t>(i + lag)].by_sensor);
      if (pass == 0) {
        mean_a += a;
        mean_b += b;
        ++count;
        continue;
      }
      aa += (a - mean_a).squaredNorm();
      bb += (b - mean_b).squaredNorm();
      ab += (a - mean_a).dot(b - mean_b);
    }
    if (count < static_cast<int>(kFewestSteps)) return {};
    if (pass == 0) {
      mean_a /= count;
      mean_b /= count;
    }
  }
  if (!(aa > 0.0) || !(bb > 0.0)) return {};
  return {ab / std::sqrt(aa * bb), ab / aa};
}

Vector3d same(const Vector3d& value) { return value; }

struct Lag {
  int steps = 0;
  double cosine = 0.0;
};

/// Returns the lag with the highest correlation.
Lag findLag(const std::vector<ComparedStep>& steps, double period) {
  const int most = static_cast<int>(std::min(kLongestDelay / period, 0.5 * static_cast<double>(steps.size())));
  Lag best{0, correlate(steps, 0, same).cosine};
  for (int lag = -most; lag <= most; ++lag) {
    const double cosine = correlate(steps, lag, same).cosine;
    if (cosine > best.cosine) best = {lag, cosine};
  }
  return best;
}

double meanPeriod(const std::vector<ComparedStep>& steps) {
  double sum = 0.0;
  for (const ComparedStep& step : steps) sum += step.seconds;
  return sum / static_cast<double>(steps.size());
}

/// Returns the root mean square difference per second.
double rootMeanSquare(const std::vector<ComparedStep>& steps) {
  double sum = 0.0;
  for (const ComparedStep& step : steps) sum += ((step.by_sensor - step.by_reference) / step.seconds).squaredNorm();
  return std::sqrt(sum / static_cast<double>(steps.size()));
}

std::string frozenSentence(double seconds) {
  return "its numbers have not changed for " + formatNumber(seconds, 2) +
         " s: the device or its driver is frozen, restart it";
}

std::string delaySentence(double late) {
  return "messages are stamped " + formatNumber(std::abs(late), 2) + " s too " + (late > 0.0 ? "late" : "early") +
         ": set the clock of the device, or stamp messages when they are measured";
}

std::string biasSentence(const DiagnosisInput& input) {
  const Vector3d bias = input.q_base_sensor.conjugate() * input.bias;
  return "its bias is (" + formatNumber(bias.x(), 2) + ", " + formatNumber(bias.y(), 2) + ", " +
         formatNumber(bias.z(), 2) + ") rad/s, too large for a working sensor: calibrate it at rest";
}

/// Transforms the steps to the axes of the device, which are those of its messages.
std::vector<ComparedStep> inDevice(std::vector<ComparedStep> steps, const Quaterniond& q_base_sensor) {
  for (ComparedStep& step : steps) {
    step.by_reference = q_base_sensor.conjugate() * step.by_reference;
    step.by_sensor = q_base_sensor.conjugate() * step.by_sensor;
  }
  return steps;
}

struct Axes {
  Matrix3d map = Matrix3d::Identity();
  double cosine = 0.0;
};

/// Returns the permutation of axes with the highest correlation of rotations.
Axes findAxes(const std::vector<ComparedStep>& steps) {
  Axes best;
  for (const Matrix3d& map : allAxisMaps()) {
    const double cosine = correlate(steps, 0, [&](const Vector3d& value) -> Vector3d { return map * value; }).cosine;
    if (cosine > best.cosine) best = {map, cosine};
  }
  return best;
}

}  // namespace

MotionFault diagnoseGyroscope(const std::vector<ComparedStep>& steps, const DiagnosisInput& input) {
  if (input.repeated_s > kFrozen) return {Kind::Frozen, frozenSentence(input.repeated_s)};
  if (steps.size() < kFewestSteps)
    return {Kind::Unknown, "its rates contradict the " + input.reference + ": check its mounting and its driver"};
  const bool is_biased = !input.bias.isZero();
  const Correlation plain = correlate(steps, 0, same);
  if (is_biased && plain.cosine > kGoodCorrelation) return {Kind::Bias, biasSentence(input)};
  if (plain.cosine > kLinear && std::abs(plain.ratio - 1.0) > kLeastScaleError) {
    const std::string figure =
        "its rates are " + formatNumber(plain.ratio, 3) + " times those of the " + input.reference;
    if (plain.ratio > 0.5 * kFaultDegrees && plain.ratio < 2.0 * kFaultDegrees)
      return {Kind::Units, figure + ": they are in degrees, publish rad/s"};
    return {Kind::Scale, figure + ": calibrate the gyroscope's scale"};
  }
  const double period = meanPeriod(steps);
  const bool is_long = period * static_cast<double>(steps.size()) > kLeastHistory;
  const Axes axes = findAxes(inDevice(steps, input.q_base_sensor));
  const Lag lag = findLag(steps, period);
  if (is_long && axes.cosine > std::max({kGoodCorrelation, plain.cosine + kAxesGain, lag.cosine}))
    return {Kind::Axes, "its axes are wrong (correlation " + formatNumber(axes.cosine, 2) + " if x, y, z are read as " +
                            printAxisMap(axes.map) +
                            "): correct the axes of its driver, or its rotation on /tf_static"};
  if (is_long && lag.steps != 0 && lag.cosine > kGoodCorrelation)
    return {Kind::Delay, delaySentence(lag.steps * period)};
  if (is_biased) return {is_long ? Kind::Bias : Kind::Unknown, biasSentence(input)};
  return {Kind::Unknown, "its rates differ from those of the " + input.reference + " by " +
                             formatNumber(kFaultDegrees * rootMeanSquare(steps), 2) +
                             " deg/s (root mean square): check its mounting and its driver"};
}

MotionFault diagnoseWheels(const std::vector<ComparedStep>& steps, const DiagnosisInput& input) {
  if (input.repeated_s > kFrozen) return {Kind::Frozen, frozenSentence(input.repeated_s)};
  if (steps.size() < kFewestSteps)
    return {Kind::Unknown,
            "their speed contradicts the " + input.reference + ": they slip, or their calibration is wrong"};
  double by_reference = 0.0, by_wheels = 0.0, both = 0.0;
  for (const ComparedStep& step : steps) {
    by_reference += step.by_reference.x() * step.by_reference.x();
    by_wheels += step.by_sensor.x() * step.by_sensor.x();
    both += step.by_reference.x() * step.by_sensor.x();
  }
  const double ratio = by_reference > 0.0 ? both / by_reference : 0.0;
  const bool fits =
      by_reference > 0.0 && by_wheels > 0.0 && std::abs(both) > kGoodCorrelation * std::sqrt(by_reference * by_wheels);
  if (fits && ratio < 0.0)
    return {Kind::Axes, "their speed is " + formatNumber(ratio, 3) + " times that of the " + input.reference +
                            ": forward and backward are exchanged, correct their sign"};
  if (fits && std::abs(ratio - 1.0) > kLeastScaleError)
    return {Kind::Scale, "their speed is " + formatNumber(ratio, 3) + " times that of the " + input.reference +
                             ": correct the radius of the wheels or the counts of a turn"};
  const double period = meanPeriod(steps);
  const Lag lag = findLag(steps, period);
  if (period * static_cast<double>(steps.size()) > kLeastHistory && lag.steps != 0 && lag.cosine > kGoodCorrelation)
    return {Kind::Delay, delaySentence(lag.steps * period)};
  return {Kind::Unknown, "their speed differs from that of the " + input.reference + " by " +
                             formatNumber(rootMeanSquare(steps), 2) +
                             " m/s (root mean square): they slip, or their calibration is wrong"};
}

}  // namespace urban_nav_core
