// SPDX-License-Identifier: BSD-3-Clause
#include "clock/lower_line.hpp"

#include <algorithm>
#include <cmath>

#include "clock/floor_slope.hpp"

namespace segway_drivers {

namespace {

constexpr std::size_t kFewestBlocks = 6;  // with fewer blocks every point belongs to the floor
constexpr double kWidestFloor = 6.0;      // times the median step between lowest points of adjacent blocks
constexpr double kLeastFloor = 0.1e-3;    // s
constexpr double kLeastSpacing = 1e-7;    // s
constexpr std::size_t kFewestRaised = 100;
constexpr double kSlopeAgreement = 3.0;  // standard deviations

struct ClockBlock {
  std::size_t begin = 0, end = 0;  // of the points
  std::vector<ClockPoint> hull;
};

std::vector<ClockBlock> cutIntoBlocks(const ClockPoint* points, std::size_t count, double length) {
  std::vector<ClockBlock> blocks;
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    const double last = points[begin].x + length;
    while (end < count && points[end].x < last) ++end;
    blocks.push_back({begin, end, lowerHull(points + begin, end - begin)});
  }
  return blocks;
}

/// Returns the lowest value of z - slope x.
double lowestAlong(const std::vector<ClockPoint>& hull, double slope) {
  double lowest = hull.front().z - slope * hull.front().x;
  for (const ClockPoint& point : hull) lowest = std::min(lowest, point.z - slope * point.x);
  return lowest;
}

/// Returns the height above a line up to which a block belongs to its floor, s.
double floorHeight(const std::vector<ClockBlock>& blocks, double skew) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < blocks.size(); ++i)
    steps.push_back(std::abs(lowestAlong(blocks[i].hull, skew) - lowestAlong(blocks[i - 1].hull, skew)));
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::max(kLeastFloor, kWidestFloor * *middle);
}

double clockEdgeSlope(const ClockPoint& a, const ClockPoint& b) { return (b.z - a.z) / (b.x - a.x); }

/// Returns the slope of the edge with the smallest sum of block heights, each truncated at `height`; empty if no edge
/// is within the limit.
std::optional<double> slopeOfMostBlocks(const std::vector<ClockPoint>& hull, const std::vector<ClockBlock>& blocks,
                                        double height, double limit) {
  std::optional<double> best;
  double least = 0.0;
  for (std::size_t i = 1; i < hull.size(); ++i) {
    const double slope = clockEdgeSlope(hull[i - 1], hull[i]), line = hull[i].z - slope * hull[i].x;
    if (std::abs(slope) > limit) continue;
    double sum = 0.0;
    for (const ClockBlock& block : blocks)
      sum += static_cast<double>(block.end - block.begin) * std::min(height, lowestAlong(block.hull, slope) - line);
    if (!best || sum < least) {
      best = slope;
      least = sum;
    }
  }
  return best;
}

/// Returns the mean spacing in height above a slope of the lowest quarter of the points, s.
double floorSpacing(const std::vector<ClockPoint>& points, double slope) {
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const ClockPoint& point : points) heights.push_back(point.z - slope * point.x);
  const std::size_t count = std::min(points.size() - 1, std::max<std::size_t>(2, points.size() / 4));
  std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(count), heights.end());
  const double lowest = *std::min_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(count));
  return (heights[count] - lowest) / static_cast<double>(count);
}

/// Averages the slope with that of an interval of raised delays if the latter has a floor that agrees with it.
void includeRaised(const std::vector<ClockPoint>& points, SlopeEstimate& slope) {
  if (points.size() < kFewestRaised) return;
  const std::vector<ClockPoint> hull = lowerHull(points.data(), points.size());
  double mean_x = 0.0;
  for (const ClockPoint& point : points) mean_x += point.x / static_cast<double>(points.size());
  const double spacing = floorSpacing(points, slope.slope);
  const SlopeEstimate own = estimateFloorSlope(hull, mean_x, std::max(spacing, kLeastSpacing));
  if (std::abs(own.slope - slope.slope) > kSlopeAgreement * std::hypot(own.sigma, slope.sigma)) return;
  const double a = 1.0 / (slope.sigma * slope.sigma), b = 1.0 / (own.sigma * own.sigma);
  slope.slope += b / (a + b) * (own.slope - slope.slope);
  slope.sigma = 1.0 / std::sqrt(a + b);
}

}  // namespace

std::vector<ClockPoint> lowerHull(const ClockPoint* points, std::size_t count) {
  std::vector<ClockPoint> hull;
  for (std::size_t i = 0; i < count; ++i) {
    const ClockPoint& p = points[i];
    while (hull.size() >= 2) {
      const ClockPoint &a = hull[hull.size() - 2], &b = hull.back();
      if ((b.x - a.x) * (p.z - b.z) > (b.z - a.z) * (p.x - b.x)) break;
      hull.pop_back();
    }
    hull.push_back(p);
  }
  return hull;
}

std::optional<LowerLine> fitLowerLine(const ClockPoint* points, std::size_t count, double block, double skew,
                                      double limit) {
  if (count < 3) return std::nullopt;
  std::vector<ClockPoint> hull = lowerHull(points, count);
  const std::vector<ClockBlock> blocks = cutIntoBlocks(points, count, block);
  std::optional<double> first;
  double height = 0.0, floor = 0.0;
  if (blocks.size() >= kFewestBlocks) {
    height = floorHeight(blocks, skew);
    first = slopeOfMostBlocks(hull, blocks, height, limit);
    if (first) floor = lowestAlong(hull, *first) + height;
  }
  std::vector<ClockPoint> on_floor;
  std::vector<std::vector<ClockPoint>> raised(1);
  for (const ClockBlock& each : blocks) {
    const bool is_raised = first && lowestAlong(each.hull, *first) > floor;
    if (!is_raised && !raised.back().empty()) raised.emplace_back();
    std::vector<ClockPoint>& stretch = is_raised ? raised.back() : on_floor;
    stretch.insert(stretch.end(), points + each.begin, points + each.end);
  }
  LowerLine line;
  line.points = static_cast<double>(on_floor.size());
  line.span = on_floor.back().x - on_floor.front().x;
  for (const ClockPoint& point : on_floor) {
    line.mean_x += point.x / line.points;
    line.mean_z += point.z / line.points;
  }
  if (on_floor.size() < count) hull = lowerHull(on_floor.data(), on_floor.size());
  line.spacing = floorSpacing(on_floor, estimateFloorSlope(hull, line.mean_x, kLeastSpacing).slope);
  SlopeEstimate slope = estimateFloorSlope(hull, line.mean_x, std::max(line.spacing, kLeastSpacing));
  for (const std::vector<ClockPoint>& stretch : raised) includeRaised(stretch, slope);
  line.slope = slope.slope;
  line.slope_sigma = slope.sigma;
  return line;
}

}  // namespace segway_drivers
