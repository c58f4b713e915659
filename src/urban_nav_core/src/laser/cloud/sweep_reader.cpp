// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "laser/cloud/field_statistics.hpp"

namespace urban_nav_core {

namespace {

constexpr double kLongestSpan = 1.0;  // s: longest duration of a sweep
constexpr double kConstant = 1e-6;    // s
constexpr double kLatest = 4.6e18;    // ns: half of the range of stamps
constexpr double kBrightest = 255.0;  // intensity
// The points of a rotating LiDAR in the order of measurement turn once, and steadily.
constexpr double kTurnTolerance = 0.1;  // turns
constexpr double kSteadyTurn = 0.95;    // least correlation of the turn with the index of the point

/// Times of the usable points of a cloud.
struct Timing {
  std::vector<double> offsets;     ///< s from the header; NaN for invalid values
  double first = 0.0, last = 0.0;  ///< s from the header
  bool covers(std::size_t point) const { return offsets[point] >= first && offsets[point] <= last; }
};

Timing readTiming(const CloudPoints& points, const PointTimes& times, const UsablePoints& usable) {
  const CloudPoints::Field field = points.field(times.field);
  const double unit = nanoseconds(times.unit);
  const StampNs header = points.cloud().stamp;
  Timing timing;
  std::vector<double> valid;
  for (const std::uint8_t* bytes : usable.bytes) {
    const double ns = unit * field(bytes);
    double offset = NAN;
    if (std::abs(ns) < kLatest)
      offset = 1e-9 * (times.reference == PointTimes::Reference::Header
                           ? ns
                           : static_cast<double>(static_cast<StampNs>(std::llround(ns)) - header));
    if (!std::isnan(offset)) valid.push_back(offset);
    timing.offsets.push_back(offset);
  }
  if (valid.empty()) return {};
  std::tie(timing.first, timing.last) = boundsWithoutOutliers(std::move(valid));
  return timing;
}

/// Returns the times of the points from the rotation of the sensor, with the middle of the sweep at the header; empty
/// if the points are not in the order of one rotation.
Timing timeByRotation(const UsablePoints& usable, double sweep_s) {
  std::vector<double> turns;  // since the first point
  double turn = 0.0, last = 0.0;
  for (std::size_t i = 0; i < usable.bytes.size(); ++i) {
    const double azimuth =
        std::atan2(static_cast<double>(usable.y[i]), static_cast<double>(usable.x[i])) / (2.0 * M_PI);
    if (i > 0) turn += std::remainder(azimuth - last, 1.0);
    turns.push_back(turn);
    last = azimuth;
  }
  if (turns.size() < 2 || std::abs(std::abs(turn) - 1.0) > kTurnTolerance) return {};
  const double sign = turn < 0.0 ? -1.0 : 1.0;
  if (!(sign * findTrend(turns) > kSteadyTurn)) return {};
  const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
  const double middle = 0.5 * (*least + *most);
  Timing timing;
  for (const double each : turns) timing.offsets.push_back(sign * sweep_s * (each - middle));
  const auto [first, end] = std::minmax_element(timing.offsets.begin(), timing.offsets.end());
  timing.first = *first;
  timing.last = *end;
  return timing;
}

ReadSweep::Times checkTiming(const Timing& timing, bool is_given) {
  if (timing.offsets.empty()) return ReadSweep::Times::None;
  const double span = timing.last - timing.first;
  if (span < kConstant) return ReadSweep::Times::Constant;
  if (span > kLongestSpan) return ReadSweep::Times::Span;
  std::vector<double> covered;
  for (std::size_t i = 0; i < timing.offsets.size(); ++i)
    if (timing.covers(i)) covered.push_back(timing.offsets[i]);
  return !is_given && findTrend(covered) < kDecreasingTrend ? ReadSweep::Times::Decreasing : ReadSweep::Times::Used;
}

/// Returns the ordered ring of a number of ring, row or column.
std::uint16_t orderedRing(const CloudConvention& convention, double number) {
  if (!(number >= 0.0) || convention.order.empty()) return 0;
  const double most = static_cast<double>(convention.order.size() - 1);
  return convention.order[static_cast<std::size_t>(std::min(number, most))];
}

std::uint16_t findRing(const CloudConvention& convention, const CloudPoints& points, const CloudPoints::Field& ring,
                       std::size_t place, const Beam& beam) {
  switch (convention.rings) {
    case CloudConvention::Rings::Field: return orderedRing(convention, ring(points.at(place)));
    case CloudConvention::Rings::Rows: return orderedRing(convention, static_cast<double>(place / points.columns()));
    case CloudConvention::Rings::Columns: return orderedRing(convention, static_cast<double>(place % points.columns()));
    case CloudConvention::Rings::Elevation: break;
  }
  const auto& limits = convention.elevations;
  const float elevation = std::asin(std::clamp(beam.direction.z(), -1.0F, 1.0F));
  return static_cast<std::uint16_t>(std::upper_bound(limits.begin(), limits.end(), elevation) - limits.begin());
}

std::uint16_t toColumn(double share, std::size_t columns) {
  const double most = static_cast<double>(columns - 1);
  return static_cast<std::uint16_t>(std::clamp(share * static_cast<double>(columns), 0.0, most));
}

float scaledIntensity(const CloudConvention& convention, double value) {
  const double scaled = convention.intensity_scale * value;
  return std::isfinite(scaled) ? static_cast<float>(std::clamp(scaled, 0.0, kBrightest)) : 0.0F;
}

std::size_t countRings(const std::vector<Beam>& beams, std::size_t rings) {
  std::vector<bool> seen(rings + 1, false);
  for (const Beam& beam : beams) seen[std::min<std::size_t>(beam.ring, rings)] = true;
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
}

}  // namespace

SweepReader::SweepReader(CloudConvention convention, CloudOptions options)
    : convention_(std::move(convention)), options_(std::move(options)) {}

ReadSweep SweepReader::read(const CloudView& cloud) const {
  ReadSweep read;
  const CloudPoints points(cloud);
  const UsablePoints usable = findUsablePoints(points);
  read.fault = points.fault();
  read.points = points.size();
  read.missing = points.missing();
  read.invalid = points.fault().empty() ? points.size() - usable.bytes.size() : points.size();
  const bool is_rounded = convention_.fault == PointTimesFault::Constant && convention_.times.areKnown();
  Timing timing;
  if (!options_.are_deskewed && points.field(convention_.times.field)) {
    if (is_rounded) timing = timeByRotation(usable, convention_.sweep_s);
    if (timing.offsets.empty()) timing = readTiming(points, convention_.times, usable);
  }
  read.times = checkTiming(timing, options_.times.has_value());
  const bool is_timed = read.times == ReadSweep::Times::Used;
  const auto toStamp = [&](double offset) { return cloud.stamp + static_cast<StampNs>(std::llround(1e9 * offset)); };
  double middle = options_.are_deskewed ? 0.0 : convention_.middle;
  if (is_timed) {
    const double found = 0.5 * (timing.first + timing.last);
    if (convention_.fault == PointTimesFault::Clock || std::abs(found - middle) > kClockTolerance)
      read.clock = found - middle;
    else middle = found;
  }
  Sweep& sweep = read.sweep;
  sweep.reference = options_.refer_to_header ? cloud.stamp : toStamp(middle);
  sweep.duration = is_timed ? timing.last - timing.first : convention_.sweep_s;
  sweep.times = options_.are_deskewed ? Sweep::Times::Deskewed
                : is_timed            ? Sweep::Times::Measured
                                      : Sweep::Times::Unknown;
  const CloudPoints::Field ring = points.field(convention_.ring_field),
                           intensity = points.field(convention_.intensity_field);
  sweep.beams.reserve(usable.bytes.size());
  for (std::size_t i = 0; i < usable.bytes.size(); ++i) {
    const Eigen::Vector3f p(usable.x[i], usable.y[i], usable.z[i]);
    Beam beam;
    beam.range = p.norm();
    if (static_cast<double>(beam.range) < options_.nearest) {
      ++read.near;
      continue;
    }
    if (is_timed && !timing.covers(i)) {
      ++read.untimed;
      continue;
    }
    beam.direction = p / beam.range;
    beam.stamp = is_timed ? toStamp(timing.offsets[i] - read.clock) : sweep.reference;
    beam.ring = findRing(convention_, points, ring, usable.places[i], beam);
    if (intensity) beam.intensity = scaledIntensity(convention_, intensity(usable.bytes[i]));
    const double share = is_timed ? (timing.offsets[i] - timing.first) / sweep.duration
                                  : shareOfTurn(usable.x[i], usable.y[i], convention_.is_clockwise);
    beam.column = toColumn(share, convention_.columns);
    sweep.beams.push_back(beam);
  }
  read.rings = countRings(sweep.beams, convention_.ring_count);
  sortBeams(sweep.beams);
  return read;
}

void sortBeams(std::vector<Beam>& beams) {
  const auto isEarlier = [](const Beam& a, const Beam& b) {
    return std::tie(a.stamp, a.column, a.ring) < std::tie(b.stamp, b.column, b.ring);
  };
  if (!std::is_sorted(beams.begin(), beams.end(), isEarlier)) std::stable_sort(beams.begin(), beams.end(), isEarlier);
}

double shareOfTurn(double x, double y, bool is_clockwise) {
  const double share = 0.5 * (1.0 - std::atan2(y, x) / M_PI);
  return is_clockwise ? share : 1.0 - share;
}

}  // namespace urban_nav_core
