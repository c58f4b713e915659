// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/trajectory/align.hpp"

namespace urban_nav_core {

/// Statistics of distances, m.
struct ErrorStatistics {
  double rmse = 0.0, mean = 0.0, median = 0.0, max = 0.0;
  std::size_t count = 0;
};

/// Absolute trajectory error: distances between true and estimated positions after alignment. Both vectors must be
/// equally long.
enum class TrajectoryAlignment { None, First, Se3, Sim3 };
ErrorStatistics absoluteError(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                              TrajectoryAlignment alignment);
/// Returns the distance of each pose, m.
std::vector<double> absoluteErrors(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                                   TrajectoryAlignment alignment);

/// Length of the path segments over which relative errors are computed.
struct Span {
  enum class Unit { Frames, Metres } unit = Unit::Frames;
  double length = 10.0;
};
/// Parses "10f", "100m"; nullopt for anything else and for lengths that are not positive (integer, for frames).
std::optional<Span> parseSpan(const std::string& text);
std::ostream& operator<<(std::ostream& out, const Span& span);

/// Relative pose error over all segments of the truth: E = (T_i^-1 T_j)^-1 (P_i^-1 P_j), its translation in per cent of
/// the true path between i and j and its rotation angle in degrees per metre of it. Segments in frames: every i with j
/// = i + length; in metres: every i with the first j at which the path has that length. Segments in which the truth
/// stands still (under 5 mm a frame) are omitted, since the percentage is undefined.
struct RelativeError {
  double percent = 0.0;     ///< mean
  double deg_per_m = 0.0;   ///< mean
  double step_ratio = 0.0;  ///< sum of estimated over sum of true chord lengths: 1 if the scale is right
  std::size_t count = 0;
};
std::optional<RelativeError> relativeError(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                                           const Span& span);

/// KITTI's odometry benchmark: segments of the given lengths (m), starting at every tenth frame; errors relative to the
/// nominal length.
struct SegmentError {
  double length = 0.0;     ///< m
  double percent = 0.0;    ///< mean
  double deg_per_m = 0.0;  ///< mean
  std::size_t count = 0;   ///< segments; 0: the path is too short, the means are 0
};
/// Errors of a trajectory over segments of several lengths.
struct SegmentErrors {
  std::vector<SegmentError> by_length;
  SegmentError all;  ///< mean over all segments of all lengths; length 0
};
SegmentErrors kittiSegmentErrors(const std::vector<Pose>& truth, const std::vector<Pose>& estimate,
                                 const std::vector<double>& lengths = {100, 200, 300, 400, 500, 600, 700, 800});

/// Returns the length of the path through the poses, m.
double pathLength(const std::vector<Pose>& poses);

}  // namespace urban_nav_core
