// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/turn_delay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sensors/interpolation.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr StampNs kLongestTurnDelay = 500'000'000,
                  kDelayStep = 5'000'000;        // ns; larger delays show in the times of receipt
constexpr StampNs kTransportDelay = 50'000'000;  // ns: exposure, transfer and receipt of sensors without a common clock
constexpr std::size_t kLeastTurns = 10;
constexpr double kLeastCorrelation = 0.8;
// Log likelihood ratio: a false alarm in 10^5 for each of the 200 delays tried.
constexpr double kSignificant = 17.0;

/// A turn of the images, rad, with that of the sensor at a delay.
struct Turn {
  double seconds = 0.0, by_images = 0.0, by_sensor = 0.0;
};

std::optional<double> headingAt(const std::vector<StampNs>& stamps, const std::vector<double>& headings, StampNs at) {
  return interpolate(
      stamps, [&](std::size_t i) { return headings[i]; }, at);
}

/// Sum of squared differences after subtraction of a constant rate, and correlation of the turns.
struct TurnAgreement {
  double squares = std::numeric_limits<double>::infinity(), cosine = 0.0;
};

TurnAgreement compareTurns(const std::vector<Turn>& turns) {
  double tt = 0.0, ts = 0.0, ti = 0.0, mean_i = 0.0, mean_s = 0.0;
  const auto count = static_cast<double>(turns.size());
  for (const Turn& turn : turns) {
    tt += turn.seconds * turn.seconds;
    ts += turn.seconds * turn.by_sensor;
    ti += turn.seconds * turn.by_images;
    mean_i += turn.by_images / count;
    mean_s += turn.by_sensor / count;
  }
  const double bias = (ts - ti) / tt;
  double squares = 0.0, ii = 0.0, ss = 0.0, is = 0.0;
  for (const Turn& turn : turns) {
    const double difference = turn.by_sensor - turn.by_images - bias * turn.seconds;
    squares += difference * difference;
    ii += (turn.by_images - mean_i) * (turn.by_images - mean_i);
    ss += (turn.by_sensor - mean_s) * (turn.by_sensor - mean_s);
    is += (turn.by_images - mean_i) * (turn.by_sensor - mean_s);
  }
  return {squares, ii > 0.0 && ss > 0.0 ? is / std::sqrt(ii * ss) : 0.0};
}

}  // namespace

std::optional<double> findTurnDelay(const std::vector<StampNs>& stamps, const std::vector<double>& headings,
                                    const std::vector<SeenMotion>& seen) {
  // The same turns for each delay: those that the sensor covers with all of them.
  std::vector<SeenMotion> covered;
  for (const SeenMotion& motion : seen) {
    bool is_covered = motion.to > motion.from;
    for (StampNs delay = -kLongestTurnDelay; is_covered && delay <= kLongestTurnDelay; delay += kLongestInterpolatedGap)
      is_covered = headingAt(stamps, headings, motion.from + delay) && headingAt(stamps, headings, motion.to + delay);
    if (is_covered && headingAt(stamps, headings, motion.to + kLongestTurnDelay)) covered.push_back(motion);
  }
  if (covered.size() < kLeastTurns) return std::nullopt;
  TurnAgreement best, best_near;
  StampNs found = 0;
  for (StampNs delay = -kLongestTurnDelay; delay <= kLongestTurnDelay; delay += kDelayStep) {
    std::vector<Turn> turns;
    for (const SeenMotion& motion : covered) {
      const auto begin = headingAt(stamps, headings, motion.from + delay),
                 end = headingAt(stamps, headings, motion.to + delay);
      if (!begin || !end) return std::nullopt;
      const auto R = motion.T_from_to.R();
      turns.push_back(
          {urban_nav_core::secondsBetween(motion.from, motion.to), std::atan2(R(1, 0), R(0, 0)), *end - *begin});
    }
    const TurnAgreement agreement = compareTurns(turns);
    if (agreement.squares < best.squares) {
      best = agreement;
      found = delay;
    }
    if (std::abs(delay) <= kTransportDelay && agreement.squares < best_near.squares) best_near = agreement;
  }
  const double ratio = 0.5 * static_cast<double>(covered.size()) * std::log(best_near.squares / best.squares);
  const bool is_bracketed = std::abs(found) < kLongestTurnDelay;
  if (std::abs(found) <= kTransportDelay || !is_bracketed || best.cosine < kLeastCorrelation || !(ratio > kSignificant))
    return std::nullopt;
  return 1e-9 * static_cast<double>(found);
}

}  // namespace urban_nav_input
