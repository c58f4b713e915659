// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/associate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "urban_nav_core/trajectory/interpolate.hpp"

namespace urban_nav_core {
namespace {

constexpr StampNs kInterpolationGap = 100000000;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// The sum may overflow with stamps from files; such a pose is not associated.
std::optional<StampNs> shifted(StampNs stamp, StampNs offset) {
  StampNs sum = 0;
  return __builtin_add_overflow(stamp, offset, &sum) ? std::nullopt : std::optional<StampNs>(sum);
}

StampNs saturated(double nanoseconds) {
  constexpr double kLimit = 9.2e18;
  return static_cast<StampNs>(std::llround(std::clamp(nanoseconds, -kLimit, kLimit)));
}

// Speed of a trajectory, sampled at regular times. Free of NaN; zero before the first and after the last pose.
struct Motion {
  std::vector<double> speed;  ///< m/s
  std::vector<double> rate;   ///< rad/s
};

Motion computeMotion(const Trajectory& trajectory, double step, std::size_t samples) {
  Motion motion{std::vector<double>(samples), std::vector<double>(samples)};
  std::size_t after = 1;
  const auto poseAt = [&trajectory, &after](double seconds) {
    while (after + 1 < trajectory.size() && secondsBetween(trajectory.front().stamp, trajectory[after].stamp) < seconds)
      ++after;
    const double begin = secondsBetween(trajectory.front().stamp, trajectory[after - 1].stamp);
    const double end = secondsBetween(trajectory.front().stamp, trajectory[after].stamp);
    return interpolate(trajectory[after - 1].pose, trajectory[after].pose,
                       std::clamp((seconds - begin) / (end - begin), 0.0, 1.0));
  };
  Pose last = poseAt(0.0);
  for (std::size_t i = 0; i < samples; ++i) {
    const Pose next = poseAt(static_cast<double>(i + 1) * step);
    motion.speed[i] = distanceBetween(last, next) / step;
    motion.rate[i] = angleBetween(last, next) / step;
    last = next;
  }
  return motion;
}

// Returns Pearson's correlation of a and b, shifted by `lag` samples, over their overlap; zero if either is constant.
double correlation(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t lag) {
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, lag);
  const std::ptrdiff_t end =
      std::min(static_cast<std::ptrdiff_t>(a.size()), static_cast<std::ptrdiff_t>(b.size()) + lag);
  double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double x = a[static_cast<std::size_t>(i)], y = b[static_cast<std::size_t>(i - lag)];
    sum_a += x, sum_b += y, sum_aa += x * x, sum_bb += y * y, sum_ab += x * y;
  }
  const auto n = static_cast<double>(end - begin);
  const double variance_a = n * sum_aa - sum_a * sum_a, variance_b = n * sum_bb - sum_b * sum_b;
  if (!(variance_a > 1e-9 * n * sum_aa) || !(variance_b > 1e-9 * n * sum_bb)) return 0.0;
  return (n * sum_ab - sum_a * sum_b) / std::sqrt(variance_a * variance_b);
}

struct Peak {
  double lag = 0.0;  ///< samples
  double height = 0.0;
};

Peak bestLag(const Motion& truth, const Motion& estimate) {
  const auto n = static_cast<std::ptrdiff_t>(truth.speed.size()),
             m = static_cast<std::ptrdiff_t>(estimate.speed.size());
  const std::ptrdiff_t overlap = std::max<std::ptrdiff_t>(2, std::min(n, m) * 3 / 10);
  const auto score = [&](std::ptrdiff_t lag) {
    const double speed = correlation(truth.speed, estimate.speed, lag),
                 rate = correlation(truth.rate, estimate.rate, lag);
    return speed == 0.0 ? rate : rate == 0.0 ? speed : 0.5 * (speed + rate);
  };
  std::ptrdiff_t best = 0;
  double height = -1.0;
  for (std::ptrdiff_t lag = overlap - m; lag <= n - overlap; ++lag) {
    const double here = score(lag);
    if (here > height) height = here, best = lag;
  }
  const double before = score(best - 1), after = score(best + 1);
  const double bend = before - 2.0 * height + after;
  const double part = bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
  return {static_cast<double>(best) + part, height};
}

}  // namespace

Matched associate(const Trajectory& truth, const Trajectory& estimate, StampNs offset, StampNs tolerance) {
  Matched matched;
  if (truth.empty()) return matched;
  std::size_t last_nearest = kNone;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const auto stamp = shifted(estimate[i].stamp, offset);
    if (!stamp) continue;
    const std::size_t nearest = truth.nearest(*stamp);
    const double distance = std::abs(secondsBetween(truth[nearest].stamp, *stamp));
    if (distance > static_cast<double>(tolerance) * 1e-9) continue;
    const auto between = truth.at(*stamp, kInterpolationGap);
    if (!between && nearest == last_nearest) {
      if (distance >= std::abs(secondsBetween(truth[nearest].stamp, matched.stamps.back()))) continue;
      matched.stamps.pop_back(), matched.truth.pop_back(), matched.estimate.pop_back(),
          matched.estimate_index.pop_back();
    }
    last_nearest = between ? kNone : nearest;
    matched.stamps.push_back(*stamp);
    matched.truth.push_back(between ? *between : truth[nearest].pose);
    matched.estimate.push_back(estimate[i].pose);
    matched.estimate_index.push_back(i);
  }
  return matched;
}

std::optional<Matched> associateByIndex(const std::vector<Pose>& truth, const std::vector<Pose>& estimate) {
  if (truth.size() != estimate.size()) return std::nullopt;
  Matched matched{{}, truth, estimate, {}};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    matched.stamps.push_back(static_cast<StampNs>(i));
    matched.estimate_index.push_back(i);
  }
  return matched;
}

std::optional<TimeOffset> findOffset(const Trajectory& truth, const Trajectory& estimate) {
  if (truth.size() < 2 || estimate.size() < 2) return std::nullopt;
  constexpr double kFinest = 0.05, kSamples = 4000.0;
  const double long_truth = secondsBetween(truth.front().stamp, truth.back().stamp);
  const double long_estimate = secondsBetween(estimate.front().stamp, estimate.back().stamp);
  const double step = std::max(kFinest, std::max(long_truth, long_estimate) / kSamples);
  const auto samples = [step](double seconds) { return static_cast<std::size_t>(seconds / step); };

  double shift = 0.0, height = 0.0;  // relative to the shift that aligns the first stamps
  if (samples(long_truth) >= 3 && samples(long_estimate) >= 3) {
    const Peak peak =
        bestLag(computeMotion(truth, step, samples(long_truth)), computeMotion(estimate, step, samples(long_estimate)));
    if (peak.height >= 0.5) shift = peak.lag * step, height = peak.height;
  }
  TimeOffset result;
  result.offset = saturated(secondsBetween(estimate.front().stamp, truth.front().stamp) * 1e9);
  StampNs exact = 0;  // a double resolves an epoch to 0.2 us only
  if (!__builtin_sub_overflow(truth.front().stamp, estimate.front().stamp, &exact)) result.offset = exact;
  result.offset = shifted(result.offset, saturated(shift * 1e9)).value_or(result.offset);
  result.correlation = height;
  result.matched = associate(truth, estimate, result.offset).stamps.size();
  return result;
}

std::ostream& operator<<(std::ostream& out, const TimeOffset& offset) {
  return out << printStamp(offset.offset) << " s (correlation " << offset.correlation << ", " << offset.matched
             << " poses)";
}

}  // namespace urban_nav_core
