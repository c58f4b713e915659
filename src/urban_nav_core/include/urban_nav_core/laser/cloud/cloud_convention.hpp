// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/cloud/point_times.hpp"

namespace urban_nav_core {

/// Settings of the user for the clouds of a 3D LiDAR.
struct CloudOptions {
  std::optional<PointTimes> times;  ///< nullopt: detected; PointTimes() without a field: clouds have no times
  bool are_deskewed = false;        ///< the source has compensated for motion
  double nearest = 0.5;             ///< m; nearer returns are of the robot itself and are discarded
  bool refer_to_header = false;     ///< use the stamp of the header as reference of a sweep, whatever its times
};

/// Reason why the times of the points of a topic are not used, or a property to be reported to the user.
enum class PointTimesFault : std::uint8_t {
  None,
  Absent,      ///< no field has the span of a sweep
  Constant,    ///< all points of a cloud have the same time; if `times` are known, by conversion to single precision
  Decreasing,  ///< the first point of a cloud has the last time
  Unit,        ///< the unit set by the user does not give the duration of a sweep, or is unusual for this field
  Clock        ///< clock other than that of the header: sweeps are placed by the header
};

/// Conventions of the clouds of one 3D LiDAR, determined once from several clouds (CloudSurvey).
struct CloudConvention {
  /// Source of a point's ring.
  enum class Rings : std::uint8_t { Field, Rows, Columns, Elevation };

  PointTimes times;
  PointTimesFault fault = PointTimesFault::None;
  std::string suspect;   ///< field that the fault concerns; empty: none
  double middle = 0.0;   ///< s, from the stamp of the header to the middle of the sweep
  double clock = 0.0;    ///< s, times of the points minus stamps of the headers; only for PointTimesFault::Clock
  double sweep_s = 0.0;  ///< duration of a sweep; of clouds without times, the time between them

  Rings rings = Rings::Elevation;
  std::string ring_field;            ///< for Rings::Field
  std::vector<std::uint16_t> order;  ///< by number of ring, row or column: ring in order of elevation, lowest first
  std::vector<float> elevations;     ///< rad, boundaries between rings; for Rings::Elevation
  bool are_rings_known = false;      ///< false: the elevation range is divided evenly
  bool are_rings_sorted = true;      ///< false: the numbers of the field follow neither rising nor falling elevations
  std::vector<std::uint16_t> absent_rings;  ///< numbers of the field between others that no point has
  std::size_t ring_count = 1;
  std::size_t columns = 1;   ///< firings of a sweep
  bool is_clockwise = true;  ///< seen from above, in storage order

  std::string intensity_field;   ///< empty: none
  double intensity_scale = 1.0;  ///< of 0...255 for one unit of the field
  std::size_t clouds = 0;        ///< number of clouds used; 0: none had points

  void archive(Archive& archive);
};

}  // namespace urban_nav_core
