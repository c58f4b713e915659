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
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Usable points of a cloud: pointers to their first bytes, in storage order, and their indices.
struct UsablePoints {
  std::vector<const std::uint8_t*> bytes;
  std::vector<std::size_t> places;  ///< in CloudPoints
  std::vector<float> x, y, z;       ///< m
};
/// Returns the points with finite coordinates within the range of any LiDAR.
UsablePoints findUsablePoints(const CloudPoints& points);

/// Statistics of one field over the usable points of a cloud.
struct FieldStatistics {
  std::string name;
  CloudField::Number number = CloudField::Number::Float32;
  double first = 0.0, last = 0.0;      ///< smallest and largest value, without outliers
  double trend = 0.0;                  ///< correlation with storage order, -1...1
  double rising = 0.0, falling = 0.0;  ///< shares of consecutive pairs in storage order
  std::size_t distinct = 0;            ///< number of distinct values, up to kMostDistinct
  bool is_whole = false;               ///< all values are integers

  static constexpr std::size_t kMostDistinct = 1000;
  double span() const { return last - first; }
  double middle() const { return 0.5 * (first + last); }
};
FieldStatistics summarise(const CloudField& field, const CloudPoints& points, const UsablePoints& usable);

/// Returns the smallest and the largest of one or more values, without outliers, which belong to points that were not
/// measured.
std::pair<double, double> boundsWithoutOutliers(std::vector<double> values);

constexpr double kDecreasingTrend = -0.8;  ///< below it, times decrease in storage order
constexpr double kClockTolerance = 1.0;    ///< s: times with a larger deviation are of another clock

/// Returns the correlation of values with their index, -1...1; 0 for constant values.
double findTrend(const std::vector<double>& values);

/// Meaning of a field according to its name.
enum class FieldMeaning { Time, Other, Unknown };
FieldMeaning findMeaning(const std::string& name);
/// Return whether a field is an intensity or a reflectance, according to its name.
bool isIntensity(const std::string& name);
bool isReflectance(const std::string& name);

/// Returns the unit in which a span is a valid duration of a sweep, 10 ms to 1 s; at most one fits. nullopt for none.
std::optional<PointTimes::Unit> unitOfSpan(double span);

/// Returns the unit in which the values of a field are stamps that a driver has converted to single precision: steps of
/// 128 s for the seconds since 1970, so that all points of a sweep have the same one. `header`: stamp of the cloud.
/// nullopt if the values are no such stamps, or if their steps are shorter than 10 ms.
std::optional<PointTimes::Unit> unitOfRoundedStamps(const FieldStatistics& field, StampNs header);

}  // namespace urban_nav_core
