// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/instances/oriented_box.hpp"

#include <algorithm>
#include <cmath>

namespace scene_labeler {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kOutside = 0.005;        // share of the points beyond each edge
constexpr double kNearest = 0.05;         // m: points nearer to an edge count as much as those at this distance
constexpr std::size_t kMostScored = 500;  // points for which headings are compared

struct Span {
  double low = 0.0, high = 0.0;
};

/// Returns the span of values without the outermost ones. Reorders the values.
Span findSpan(std::vector<double>& values) {
  const auto skipped = static_cast<std::ptrdiff_t>(kOutside * static_cast<double>(values.size()));
  std::nth_element(values.begin(), values.begin() + skipped, values.end());
  const double low = values[static_cast<std::size_t>(skipped)];
  std::nth_element(values.begin(), values.end() - 1 - skipped, values.end());
  return {low, values[values.size() - 1 - static_cast<std::size_t>(skipped)]};
}

struct Axes {
  Eigen::Vector2d along, across;
  explicit Axes(double heading)
      : along(std::cos(heading), std::sin(heading)), across(-std::sin(heading), std::cos(heading)) {}
};

/// Returns the closeness of points to the edges of their box with a heading.
double closeness(const std::vector<Eigen::Vector2d>& points, double heading, std::vector<double>& a,
                 std::vector<double>& b) {
  const Axes axes(heading);
  a.clear();
  b.clear();
  for (const Eigen::Vector2d& point : points) {
    a.push_back(axes.along.dot(point));
    b.push_back(axes.across.dot(point));
  }
  const auto [a_low, a_high] = std::minmax_element(a.begin(), a.end());
  const auto [b_low, b_high] = std::minmax_element(b.begin(), b.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    sum += 1.0 / std::max(kNearest, std::min({a[i] - *a_low, *a_high - a[i], b[i] - *b_low, *b_high - b[i]}));
  return sum;
}

double bestHeading(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> a, b;
  double best = 0.0, most = 0.0;
  const auto search = [&](double first, double last, double step) {
    for (double heading = first; heading < last; heading += step) {
      const double close = closeness(points, heading, a, b);
      if (close <= most) continue;
      most = close;
      best = heading;
    }
  };
  search(0.0, 90.0 * kDegree, kDegree);
  const double coarse = best;
  search(coarse - kDegree, coarse + kDegree, 0.1 * kDegree);
  return best;
}

}  // namespace

Eigen::Vector2d OrientedBox::toBox(const Eigen::Vector2d& point) const {
  const Axes axes(heading);
  return {axes.along.dot(point - centre), axes.across.dot(point - centre)};
}

bool OrientedBox::holds(const Eigen::Vector2d& point, double margin) const {
  const Eigen::Vector2d p = toBox(point).cwiseAbs();
  return p.x() <= 0.5 * length + margin && p.y() <= 0.5 * width + margin;
}

OrientedBox fitBox(const std::vector<Eigen::Vector2d>& points) {
  OrientedBox box;
  if (points.empty()) return box;
  const std::size_t step = (points.size() + kMostScored - 1) / kMostScored;
  std::vector<Eigen::Vector2d> scored;
  for (std::size_t i = 0; i < points.size(); i += step) scored.push_back(points[i] - points.front());
  double heading = bestHeading(scored);
  std::vector<double> a, b;
  const Axes axes(heading);
  for (const Eigen::Vector2d& point : points) {
    a.push_back(axes.along.dot(point));
    b.push_back(axes.across.dot(point));
  }
  const Span along = findSpan(a), across = findSpan(b);
  box.centre = 0.5 * (along.low + along.high) * axes.along + 0.5 * (across.low + across.high) * axes.across;
  box.length = along.high - along.low;
  box.width = across.high - across.low;
  if (box.width > box.length) {
    std::swap(box.length, box.width);
    heading += 0.5 * M_PI;
  }
  box.heading = heading - M_PI * std::floor(heading / M_PI);
  return box;
}

}  // namespace scene_labeler
