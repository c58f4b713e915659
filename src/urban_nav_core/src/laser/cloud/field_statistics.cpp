// SPDX-License-Identifier: BSD-3-Clause
#include "laser/cloud/field_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace urban_nav_core {

namespace {

constexpr double kOrigin = 1e-3;                              // m: nearer points were not measured
constexpr double kFarthestPoint = 2000.0;                     // m: beyond the range of any LiDAR of a robot
constexpr double kShortestSweep = 0.01, kLongestSweep = 1.0;  // s
constexpr double kTolerance = 1e-3;                           // of both limits: values are rounded

constexpr std::array<PointTimes::Unit, 4> kSweepUnits = {{PointTimes::Unit::Seconds, PointTimes::Unit::Milliseconds,
                                                          PointTimes::Unit::Microseconds,
                                                          PointTimes::Unit::Nanoseconds}};

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

}  // namespace

UsablePoints findUsablePoints(const CloudPoints& points) {
  UsablePoints usable;
  if (!points.fault().empty()) return usable;
  const CloudPoints::Field x = points.field("x"), y = points.field("y"), z = points.field("z");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint8_t* bytes = points.at(i);
    const double px = x(bytes), py = y(bytes), pz = z(bytes), squared = px * px + py * py + pz * pz;
    if (!(squared > kOrigin * kOrigin && squared < kFarthestPoint * kFarthestPoint)) continue;  // NaN too
    usable.bytes.push_back(bytes);
    usable.places.push_back(i);
    usable.x.push_back(static_cast<float>(px));
    usable.y.push_back(static_cast<float>(py));
    usable.z.push_back(static_cast<float>(pz));
  }
  return usable;
}

double findTrend(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) mean += value / count;
  double with_place = 0.0, squares = 0.0, place_squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double place = static_cast<double>(i) - 0.5 * (count - 1.0), value = values[i] - mean;
    with_place += place * value;
    squares += value * value;
    place_squares += place * place;
  }
  return squares > 0.0 && place_squares > 0.0 ? with_place / std::sqrt(squares * place_squares) : 0.0;
}

std::pair<double, double> boundsWithoutOutliers(std::vector<double> values) {
  const auto place = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t tail = values.size() / 50, end = values.size() - 1 - tail;
  std::nth_element(values.begin(), place(tail), values.end());
  const double low = values[tail];
  std::nth_element(values.begin(), place(end), values.end());
  const double high = values[end], margin = 0.5 * (high - low);
  std::pair<double, double> bounds(low, high);
  for (const double value : values) {
    if (value >= low - margin) bounds.first = std::min(bounds.first, value);
    if (value <= high + margin) bounds.second = std::max(bounds.second, value);
  }
  return bounds;
}

FieldStatistics summarise(const CloudField& field, const CloudPoints& points, const UsablePoints& usable) {
  FieldStatistics found;
  found.name = field.name;
  found.number = field.number;
  const CloudPoints::Field read = points.field(field.name);
  std::vector<double> values;
  values.reserve(usable.bytes.size());
  for (const std::uint8_t* bytes : usable.bytes)
    if (const double value = read(bytes); std::isfinite(value)) values.push_back(value);
  if (values.size() < 2) return found;
  std::size_t rising = 0, falling = 0;
  std::set<double> distinct;
  found.is_whole = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) rising += values[i] > values[i - 1], falling += values[i] < values[i - 1];
    if (distinct.size() < FieldStatistics::kMostDistinct) distinct.insert(values[i]);
    found.is_whole = found.is_whole && values[i] == std::floor(values[i]);
  }
  const auto steps = static_cast<double>(values.size() - 1);
  found.rising = static_cast<double>(rising) / steps;
  found.falling = static_cast<double>(falling) / steps;
  found.distinct = distinct.size();
  found.trend = findTrend(values);
  std::tie(found.first, found.last) = boundsWithoutOutliers(values);
  return found;
}

FieldMeaning findMeaning(const std::string& name) {
  const std::string lower = toLower(name);
  const auto has = [&lower](const char* part) { return lower.find(part) != std::string::npos; };
  for (const char* part : {"time", "stamp"})
    if (has(part)) return FieldMeaning::Time;
  for (const char* word : {"t", "ts", "dt", "offset"})
    if (lower == word) return FieldMeaning::Time;
  for (const char* part :
       {"intensity", "reflect", "ring",     "line",    "channel", "laser",     "beam",     "range",
        "distance",  "depth",   "ambient",  "tag",     "rgb",     "label",     "class",    "normal",
        "snr",       "noise",   "infrared", "near_ir", "azimuth", "elevation", "angle",    "confidence",
        "echo",      "return",  "velocity", "doppler", "flag",    "signal",    "remission"})
    if (has(part)) return FieldMeaning::Other;
  for (const char* word : {"x", "y", "z", "i", "r", "g", "b", "a", "id", "row", "col", "column", "index", "instance"})
    if (lower == word) return FieldMeaning::Other;
  return FieldMeaning::Unknown;
}

bool isIntensity(const std::string& name) {
  const std::string lower = toLower(name);
  return lower == "i" || lower.find("intensit") != std::string::npos;
}

bool isReflectance(const std::string& name) {
  const std::string lower = toLower(name);
  return lower.find("reflect") != std::string::npos || lower.find("remission") != std::string::npos;
}

std::optional<PointTimes::Unit> unitOfSpan(double span) {
  for (const PointTimes::Unit unit : kSweepUnits) {
    const double seconds = 1e-9 * nanoseconds(unit) * span;
    if (seconds >= kShortestSweep * (1.0 - kTolerance) && seconds <= kLongestSweep * (1.0 + kTolerance)) return unit;
  }
  return std::nullopt;
}

std::optional<PointTimes::Unit> unitOfRoundedStamps(const FieldStatistics& field, StampNs header) {
  const auto isSingle = [](double value) { return static_cast<double>(static_cast<float>(value)) == value; };
  const bool is_float = field.number == CloudField::Number::Float32 || field.number == CloudField::Number::Float64;
  if (!is_float || !isSingle(field.first) || !isSingle(field.last)) return std::nullopt;
  const auto value = static_cast<float>(field.middle());
  const auto step = static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity()) - value);
  for (const PointTimes::Unit unit : kSweepUnits) {
    const double seconds = 1e-9 * nanoseconds(unit) * step;
    const double apart = 1e-9 * (nanoseconds(unit) * field.middle() - static_cast<double>(header));
    if (seconds >= kShortestSweep && std::abs(apart) <= seconds + kClockTolerance) return unit;
  }
  return std::nullopt;
}

}  // namespace urban_nav_core
