// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ostream>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_core {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kStanding = 0.005;  // m a frame

// Returns the path length from the first pose to each, m.
std::vector<double> distances(const std::vector<Pose>& poses) {
  std::vector<double> along(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) along[i] = along[i - 1] + distanceBetween(poses[i - 1], poses[i]);
  return along;
}

// Returns the first pose at least `metres` along the path after `from`, or the number of poses.
std::size_t firstAfter(const std::vector<double>& along, std::size_t from, double metres) {
  const auto begin = along.begin() + static_cast<std::ptrdiff_t>(from);
  return static_cast<std::size_t>(std::lower_bound(begin, along.end(), along[from] + metres) - along.begin());
}

Pose spanError(const std::vector<Pose>& truth, const std::vector<Pose>& estimate, std::size_t i, std::size_t j) {
  return (truth[i].inverse() * truth[j]).inverse() * (estimate[i].inverse() * estimate[j]);
}

double toTurn(const Pose& T) { return logSo3(T.q()).norm() / kDegree; }

Similarity align(const std::vector<Pose>& truth, const std::vector<Pose>& estimate, TrajectoryAlignment alignment) {
  switch (alignment) {
    case TrajectoryAlignment::None: return {};
    case TrajectoryAlignment::First: return alignFirst(truth, estimate);
    case TrajectoryAlignment::Se3: return alignSe3(truth, estimate);
    case TrajectoryAlignment::Sim3: return alignSim3(truth, estimate);
  }
  return {};
}

}  // namespace

double pathLength(const std::vector<Pose>& poses) { return poses.empty() ? 0.0 : distances(poses).back(); }

std::vector<double> absoluteErrors(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                                   TrajectoryAlignment alignment) {
  assert(truth.size() == estimate.size());
  std::vector<double> errors;
  if (truth.empty()) return errors;
  const Similarity similarity = align(truth, estimate, alignment);
  errors.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) errors.push_back((truth[i].t() - similarity * estimate[i].t()).norm());
  return errors;
}

ErrorStatistics absoluteError(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                              TrajectoryAlignment alignment) {
  std::vector<double> errors = absoluteErrors(truth, estimate, alignment);
  ErrorStatistics statistics;
  statistics.count = errors.size();
  if (errors.empty()) return statistics;
  double sum = 0.0, squares = 0.0;
  for (const double error : errors) sum += error, squares += error * error;
  const auto n = static_cast<double>(errors.size());
  std::sort(errors.begin(), errors.end());
  const std::size_t half = errors.size() / 2;
  statistics.median = errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
  statistics.rmse = std::sqrt(squares / n);
  statistics.mean = sum / n;
  statistics.max = errors.back();
  return statistics;
}

std::optional<Span> parseSpan(const std::string& text) {
  if (text.size() < 2 || (text.back() != 'f' && text.back() != 'm')) return std::nullopt;
  const auto length = parseNumber(std::string_view(text).substr(0, text.size() - 1));
  const bool frames = text.back() == 'f';
  if (!length || !(*length > 0.0) || *length > 1e9 || (frames && std::floor(*length) != *length)) return std::nullopt;
  return Span{frames ? Span::Unit::Frames : Span::Unit::Metres, *length};
}

std::ostream& operator<<(std::ostream& out, const Span& span) {
  return out << printNumber(span.length) << (span.unit == Span::Unit::Frames ? "f" : "m");
}

std::optional<RelativeError> relativeError(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                                           const Span& span) {
  assert(truth.size() == estimate.size());
  const std::vector<double> along = distances(truth);
  RelativeError sum;
  double true_chords = 0.0, estimated_chords = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool frames = span.unit == Span::Unit::Frames;
    const std::size_t j = frames ? i + static_cast<std::size_t>(span.length) : firstAfter(along, i, span.length);
    if (j >= truth.size()) break;
    const double way = along[j] - along[i];
    if (way < kStanding * static_cast<double>(j - i)) continue;
    const Pose error = spanError(truth, estimate, i, j);
    sum.percent += 100.0 * error.t().norm() / way;
    sum.deg_per_m += toTurn(error) / way;
    true_chords += distanceBetween(truth[i], truth[j]);
    estimated_chords += distanceBetween(estimate[i], estimate[j]);
    ++sum.count;
  }
  if (sum.count == 0) return std::nullopt;
  sum.percent /= static_cast<double>(sum.count);
  sum.deg_per_m /= static_cast<double>(sum.count);
  sum.step_ratio = true_chords > 0.0 ? estimated_chords / true_chords : 0.0;
  return sum;
}

SegmentErrors kittiSegmentErrors(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                                 const std::vector<double>& lengths) {
  assert(truth.size() == estimate.size());
  constexpr std::size_t kBegunEvery = 10;
  const std::vector<double> along = distances(truth);
  SegmentErrors errors;
  const auto divide = [](SegmentError& error) {
    if (error.count == 0) return;
    error.percent /= static_cast<double>(error.count);
    error.deg_per_m /= static_cast<double>(error.count);
  };
  for (const double length : lengths) {
    SegmentError sum;
    sum.length = length;
    for (std::size_t i = 0; i < truth.size(); i += kBegunEvery) {
      const std::size_t j = firstAfter(along, i, length);
      if (j >= truth.size()) break;
      const Pose error = spanError(truth, estimate, i, j);
      sum.percent += 100.0 * error.t().norm() / length;
      sum.deg_per_m += toTurn(error) / length;
      ++sum.count;
    }
    errors.all.percent += sum.percent;
    errors.all.deg_per_m += sum.deg_per_m;
    errors.all.count += sum.count;
    divide(sum);
    errors.by_length.push_back(sum);
  }
  divide(errors.all);
  return errors;
}

}  // namespace urban_nav_core
