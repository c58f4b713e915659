// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/planar_cloud.hpp"

#include <algorithm>
#include <cmath>

#include "laser/cloud/field_statistics.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav_core {

namespace {

constexpr std::size_t kFewestInPlane = 20;  // least number of points of a cloud that is counted
constexpr double kFlatness = 1e-3;          // m, and m per m of range: tolerance of single precision
constexpr double kLeastStep = 1e-4;         // rad: finer than any planar laser
constexpr double kMostStep = 0.1;           // rad
constexpr double kOffGrid = 0.2;            // deviation from a multiple, steps
constexpr double kFewOffGrid = 0.05;        // share of points, since drivers interpolate at edges
constexpr double kFarthestInPlane = 1e6;    // m
constexpr double kShortestTurn = 1e-4;      // s
constexpr double kLongestTurn = 1.0;        // s
constexpr double kWholeTurn = 6.283185307179586;

struct PlanarPoint {
  double angle = 0.0, range = 0.0, time = 0.0, intensity = 0.0;
};

struct PlanarPoints {
  std::vector<PlanarPoint> points;  // in the order of the cloud
  bool is_flat = true;
};

std::string findTimeField(const CloudView& cloud) {
  for (const CloudField& field : cloud.fields)
    if (findMeaning(field.name) == FieldMeaning::Time) return field.name;
  return {};
}

CloudPoints::Field planarIntensity(const CloudPoints& points) {
  for (const auto& is_meant : {isIntensity, isReflectance})
    for (const CloudField& field : points.cloud().fields)
      if (is_meant(field.name)) return points.field(field.name);
  return {};
}

PlanarPoints readPlanarPoints(const CloudView& cloud, const std::string& time_field) {
  const CloudPoints points(cloud);
  const auto x = points.field("x"), y = points.field("y"), z = points.field("z");
  const auto time = points.field(time_field), intensity = planarIntensity(points);
  PlanarPoints planar;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint8_t* at = points.at(i);
    const double px = x(at), py = y(at), pz = z ? z(at) : 0.0;
    const double range = std::hypot(px, py);
    if (!std::isfinite(range) || !std::isfinite(pz) || range <= 0.0 || range > kFarthestInPlane) continue;
    planar.is_flat = planar.is_flat && std::abs(pz) <= kFlatness * (1.0 + range);
    const double value = intensity ? intensity(at) : 0.0;
    planar.points.push_back({std::atan2(py, px), range, time ? time(at) : 0.0, std::isfinite(value) ? value : 0.0});
  }
  return planar;
}

/// Returns the step of which the differences of sorted angles are multiples; 0 if there is none.
double findAngleStep(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  std::vector<double> differences;
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > kLeastStep) differences.push_back(angles[i] - angles[i - 1]);
  if (differences.size() < kFewestInPlane / 2) return 0.0;
  double step = quantile(differences, 0.5);
  if (step > kMostStep) return 0.0;
  const double span = angles.back() - angles.front();
  step = span / std::round(span / step);
  std::size_t off = 0;
  for (const double difference : differences) {
    const double steps = difference / step;
    off += std::abs(steps - std::round(steps)) > kOffGrid ? 1 : 0;
  }
  return static_cast<double>(off) > kFewOffGrid * static_cast<double>(differences.size()) ? 0.0 : step;
}

}  // namespace

void PlanarCloudSurvey::add(const CloudView& cloud) {
  if (is_spatial_) return;
  const std::string time_field = findTimeField(cloud);
  const PlanarPoints planar = readPlanarPoints(cloud, time_field);
  if (planar.points.size() < kFewestInPlane) {
    is_spatial_ = !planar.is_flat;
    return;
  }
  std::vector<double> angles;
  std::size_t falling = 0;
  for (const PlanarPoint& point : planar.points) {
    falling += !angles.empty() && point.angle < angles.back() ? 1 : 0;
    angles.push_back(point.angle);
  }
  const bool is_falling = 2 * falling > angles.size();
  const double step = findAngleStep(std::move(angles));
  is_spatial_ = !planar.is_flat || step == 0.0;
  if (is_spatial_) return;
  ++clouds_;
  steps_.push_back(step);
  const double span = planar.points.back().time - planar.points.front().time;
  clockwise_ += is_falling != (span < 0.0) ? 1 : 0;
  if (time_field.empty() || !std::isfinite(span)) return;
  time_field_ = time_field;
  time_spans_.push_back(std::abs(span));
}

std::optional<PlanarPattern> PlanarCloudSurvey::conclude() const {
  if (is_spatial_ || clouds_ == 0) return std::nullopt;
  PlanarPattern pattern;
  pattern.angle_step = quantile(steps_, 0.5);
  pattern.is_clockwise = 2 * clockwise_ > clouds_;
  if (time_spans_.empty()) return pattern;
  const double span = quantile(time_spans_, 0.5);
  for (const double unit : {1.0, 1e-3, 1e-6, 1e-9}) {
    if (span * unit < kShortestTurn || span * unit > kLongestTurn) continue;
    pattern.time_field = time_field_;
    pattern.time_scale = unit;
    break;
  }
  return pattern;
}

std::optional<PlanarScan> toPlanarScan(const CloudView& cloud, const PlanarPattern& pattern) {
  std::vector<PlanarPoint> points = readPlanarPoints(cloud, pattern.time_field).points;
  if (points.empty() || !(pattern.angle_step >= kLeastStep)) return std::nullopt;
  const double sign = pattern.is_clockwise ? -1.0 : 1.0;
  std::stable_sort(points.begin(), points.end(),
                   [sign](const PlanarPoint& a, const PlanarPoint& b) { return sign * a.angle < sign * b.angle; });
  const PlanarPoint &first = points.front(), &last = points.back();
  const auto toIndex = [&](const PlanarPoint& point) {
    return static_cast<std::size_t>(std::llround(sign * (point.angle - first.angle) / pattern.angle_step));
  };
  PlanarScan scan;
  scan.stamp = cloud.stamp;
  scan.angle_first = first.angle;
  scan.angle_step = sign * pattern.angle_step;
  scan.range_max = kFarthestInPlane;
  const std::size_t beams = std::min(toIndex(last), static_cast<std::size_t>(kWholeTurn / pattern.angle_step)) + 1;
  scan.ranges.assign(beams, 0.0F);
  scan.intensities.assign(beams, 0.0F);
  for (const PlanarPoint& point : points) {
    const std::size_t index = toIndex(point);
    if (index >= beams || scan.ranges[index] > 0.0F) continue;
    scan.ranges[index] = static_cast<float>(point.range);
    scan.intensities[index] = static_cast<float>(point.intensity);
  }
  if (pattern.time_field.empty() || beams < 2) return scan;
  const double begin = pattern.time_scale * first.time, end = pattern.time_scale * last.time;
  if (!std::isfinite(begin) || !std::isfinite(end) || std::abs(begin) > kLongestTurn ||
      std::abs(end - begin) > kLongestTurn)
    return scan;
  scan.stamp += static_cast<StampNs>(std::llround(1e9 * begin));
  scan.time_step = (end - begin) / static_cast<double>(beams - 1);
  return scan;
}

}  // namespace urban_nav_core
