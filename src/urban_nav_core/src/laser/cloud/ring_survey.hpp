// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "laser/cloud/field_statistics.hpp"
#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core {

/// Determines the source of a point's ring, and the order of rings by elevation. Not thread-safe.
class RingSurvey {
 public:
  RingSurvey();

  /// Adds the usable points of a cloud. `statistics`: of all its fields.
  void add(const CloudPoints& points, const UsablePoints& usable, const std::vector<FieldStatistics>& statistics);
  /// Sets rings, columns and the direction of rotation of a convention.
  void conclude(CloudConvention& convention) const;

 private:
  /// Moments of the elevations of one ring, row or column, rad.
  struct Moments {
    double count = 0.0, sum = 0.0, squares = 0.0;
    void add(double elevation) { ++count, sum += elevation, squares += elevation * elevation; }
    double mean() const { return sum / count; }
  };
  using Groups = std::vector<Moments>;  // by number of ring, row or column

  static void add(Groups& groups, std::size_t number, double elevation);
  static double squaresWithin(const Groups& groups);
  static Moments joined(const Groups& groups);
  static double deviation(const Groups& groups);
  static double spread(const Groups& groups);
  static bool separate(const Groups& groups);
  bool concludeGroups(const Groups& groups, CloudConvention::Rings rings, CloudConvention& convention) const;
  void concludeElevations(CloudConvention& convention) const;
  std::size_t typicalSize() const;

  std::string field_;  // field of ring numbers; empty: none
  Groups by_field_, by_row_, by_column_;
  std::vector<double> histogram_;       // points by elevation
  std::vector<std::size_t> sizes_;      // points of each cloud, valid or not
  std::size_t rows_ = 0, columns_ = 0;  // of all clouds; 0: not constant
  double turn_ = 0.0;                   // rad, accumulated in storage order, counter-clockwise positive
};

/// Returns whether a field holds ring numbers, by its name and its values.
bool holdsRings(const FieldStatistics& field);

}  // namespace urban_nav_core
