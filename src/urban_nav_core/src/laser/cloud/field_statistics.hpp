// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core {

/// Points of a cloud that a sweep can hold: their first bytes, in the order of storage, and their places.
struct UsablePoints {
  std::vector<const std::uint8_t*> bytes;
  std::vector<std::size_t> places;  ///< of CloudPoints
  std::vector<float> x, y, z;       ///< m
};
/// Returns the points with finite coordinates of a range up to that of any LiDAR.
UsablePoints findUsablePoints(const CloudPoints& points);

/// Values of one field over the usable points of a cloud.
struct FieldStatistics {
  std::string name;
  CloudField::Number number = CloudField::Number::Float32;
  double first = 0.0, last = 0.0;      ///< smallest and largest value, without outliers
  double trend = 0.0;                  ///< correlation with the order of storage, -1...1
  double rising = 0.0, falling = 0.0;  ///< shares of neighbours in the order of storage
  std::size_t distinct = 0;            ///< values, up to kMostDistinct
  bool is_whole = false;               ///< all values are whole numbers

  static constexpr std::size_t kMostDistinct = 1000;
  double span() const { return last - first; }
  double middle() const { return 0.5 * (first + last); }
};
FieldStatistics summarise(const CloudField& field, const CloudPoints& points, const UsablePoints& usable);

/// Returns the smallest and the largest of values, at least one, without those far outside the bulk, which belong to
/// points that were not measured.
std::pair<double, double> boundsWithoutOutliers(std::vector<double> values);

constexpr double kDecreasingTrend = -0.8;  ///< below it the first point of a cloud has the last time
constexpr double kClockTolerance = 1.0;    ///< s: times further from where they are expected are of another clock

/// Returns the correlation of values with their order, -1...1; 0 for values that are all the same.
double findTrend(const std::vector<double>& values);

/// Meaning of a field by its name.
enum class FieldMeaning { Time, Other, Unknown };
FieldMeaning findMeaning(const std::string& name);
/// Returns whether a field is an intensity, and whether it is a reflectance, by its name.
bool isIntensity(const std::string& name);
bool isReflectance(const std::string& name);

/// Returns the unit in which a span is that of a sweep, 10 ms to 1 s. At most one of the four is; nullopt for none.
std::optional<PointTimes::Unit> unitOfSpan(double span);

}  // namespace urban_nav_core
