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

/// Statements of the user on the clouds of a 3D LiDAR.
struct CloudOptions {
  std::optional<PointTimes> times;  ///< nullopt: they are found; PointTimes() without a field: clouds have no times
  bool are_deskewed = false;        ///< by the source
  double nearest = 0.5;             ///< m: nearer returns are of the robot itself, and are left out
  bool refer_to_header = false;     ///< the stamp of the header is the reference of a sweep, whatever its times
};

/// Reason why the times of the points of a topic are not used, or a peculiarity that a user should know.
enum class PointTimesFault : std::uint8_t {
  None,
  Absent,      ///< no field has the span of a sweep
  Constant,    ///< all points of a cloud have the same time
  Decreasing,  ///< the first point of a cloud has the last time
  Unit,        ///< the unit that the user stated gives no span of a sweep, or is not the usual one of such a field
  Clock        ///< another clock than that of the header: sweeps are placed by the header
};

/// Conventions by which the clouds of one 3D LiDAR are read: decided once, from several of them (CloudSurvey).
struct CloudConvention {
  /// Source of the ring of a point.
  enum class Rings : std::uint8_t { Field, Rows, Columns, Elevation };

  PointTimes times;
  PointTimesFault fault = PointTimesFault::None;
  std::string suspect;   ///< field that the fault is about; empty: none
  double middle = 0.0;   ///< s, from the stamp of the header to the middle of the sweep
  double clock = 0.0;    ///< s, times of the points minus stamps of the headers; only for PointTimesFault::Clock
  double sweep_s = 0.0;  ///< duration of a sweep; of clouds without times, the time between them

  Rings rings = Rings::Elevation;
  std::string ring_field;            ///< for Rings::Field
  std::vector<std::uint16_t> order;  ///< by number of ring, row or column: ring, counted from the lowest elevation
  std::vector<float> elevations;     ///< rad, between one ring and the next; for Rings::Elevation
  bool are_rings_known = false;      ///< false: elevations are divided evenly
  bool are_rings_sorted = true;      ///< false: the numbers of the field follow neither rising nor falling elevations
  std::vector<std::uint16_t> absent_rings;  ///< numbers of the field between others that no point has
  std::size_t ring_count = 1;
  std::size_t columns = 1;   ///< firings of a sweep
  bool is_clockwise = true;  ///< seen from above, in the order of storage

  std::string intensity_field;   ///< empty: none
  double intensity_scale = 1.0;  ///< of 0...255 for one unit of the field
  std::size_t clouds = 0;        ///< that it was decided from; 0: none had points

  void archive(Archive& archive);
};

}  // namespace urban_nav_core
