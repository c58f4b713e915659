// SPDX-License-Identifier: BSD-3-Clause
#include "laser/cloud/ring_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace urban_nav_core {

namespace {

constexpr std::size_t kMostRings = 512;
constexpr double kRightAngle = M_PI / 2;
constexpr double kBin = 0.05 * M_PI / 180.0;  // rad, of the histogram of elevations
constexpr std::size_t kBins = 3600;           // from -90 to 90 deg
constexpr double kSeparated = 0.05;           // variance within rings relative to that of all points
constexpr std::size_t kEvenRings = 64;        // number of rings if elevations do not separate them
constexpr double kFewPoints = 20.0;           // least points of a ring with known elevation
constexpr double kGapLevel = 0.02;            // relative to the highest bin: a gap between rings
constexpr double kMostOccupied = 0.5;         // share of bins between the first and the last ring

double elevation(const UsablePoints& points, std::size_t i) {
  const double x = points.x[i], y = points.y[i];
  return std::atan2(static_cast<double>(points.z[i]), std::sqrt(x * x + y * y));
}

double wrap(double angle) { return std::remainder(angle, 2.0 * M_PI); }

std::size_t toBin(double angle) {
  const double bin = std::floor((angle + kRightAngle) / kBin);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kBins - 1)));
}

}  // namespace

bool holdsRings(const FieldStatistics& field) {
  bool is_named = false;
  for (const char* part : {"ring", "channel", "line", "laser", "beam"})
    is_named = is_named || field.name.find(part) != std::string::npos;
  return is_named && field.is_whole && field.distinct >= 2 && field.first >= 0.0 &&
         field.last < static_cast<double>(kMostRings);
}

RingSurvey::RingSurvey() : histogram_(kBins, 0.0) {}

void RingSurvey::add(Groups& groups, std::size_t number, double elevation) {
  if (number >= kMostRings) return;
  if (groups.size() <= number) groups.resize(number + 1);
  groups[number].add(elevation);
}

void RingSurvey::add(const CloudPoints& points, const UsablePoints& usable,
                     const std::vector<FieldStatistics>& statistics) {
  if (field_.empty())
    for (const FieldStatistics& field : statistics)
      if (field_.empty() && holdsRings(field)) field_ = field.name;
  const bool is_first = sizes_.empty();
  if (is_first) rows_ = points.rows(), columns_ = points.columns();
  if (rows_ != points.rows() || columns_ != points.columns()) rows_ = columns_ = 0;
  sizes_.push_back(points.size());
  const CloudPoints::Field ring = points.field(field_);
  double before = 0.0;
  for (std::size_t i = 0; i < usable.bytes.size(); ++i) {
    const double angle = elevation(usable, i);
    if (ring)
      if (const double number = ring(usable.bytes[i]); number >= 0.0 && number < static_cast<double>(kMostRings))
        add(by_field_, static_cast<std::size_t>(number), angle);
    if (rows_ > 1 && columns_ > 1) {
      add(by_row_, usable.places[i] / points.columns(), angle);
      add(by_column_, usable.places[i] % points.columns(), angle);
    }
    ++histogram_[toBin(angle)];
    const double azimuth = std::atan2(static_cast<double>(usable.y[i]), static_cast<double>(usable.x[i]));
    if (i > 0) turn_ += wrap(azimuth - before);
    before = azimuth;
  }
}

double RingSurvey::squaresWithin(const Groups& groups) {
  double within = 0.0;
  for (const Moments& group : groups)
    if (group.count > 0.0) within += std::max(0.0, group.squares - group.sum * group.mean());
  return within;
}

RingSurvey::Moments RingSurvey::joined(const Groups& groups) {
  Moments all;
  for (const Moments& group : groups) {
    all.count += group.count;
    all.sum += group.sum;
    all.squares += group.squares;
  }
  return all;
}

/// Returns the standard deviation of elevations within groups, rad.
double RingSurvey::deviation(const Groups& groups) {
  const double count = joined(groups).count;
  return count > 0.0 ? std::sqrt(squaresWithin(groups) / count) : 0.0;
}

/// Returns the variance of elevations within groups relative to that of all points.
double RingSurvey::spread(const Groups& groups) {
  const Moments all = joined(groups);
  const double total = all.count > 0.0 ? all.squares - all.sum * all.mean() : 0.0;
  return total > 0.0 ? squaresWithin(groups) / total : 1.0;
}

bool RingSurvey::separate(const Groups& groups) { return groups.size() > 1 && spread(groups) < kSeparated; }

std::size_t RingSurvey::typicalSize() const {
  std::vector<std::size_t> sizes = sizes_;
  if (sizes.empty()) return 1;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  return sizes[sizes.size() / 2];
}

/// Orders numbers by elevation; those without points are assumed between their neighbours. Returns whether there are
/// any.
bool RingSurvey::concludeGroups(const Groups& groups, CloudConvention::Rings rings, CloudConvention& convention) const {
  std::vector<double> means(groups.size(), NAN);
  std::size_t first = groups.size(), last = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].count == 0.0) continue;
    means[i] = groups[i].mean();
    first = std::min(first, i);
    last = i;
  }
  if (first == groups.size()) return false;
  std::size_t below = first, rising = 0, falling = 0;
  const double tolerance = std::max(kBin, 3.0 * deviation(groups));
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (std::isnan(means[i])) {
      convention.absent_rings.push_back(static_cast<std::uint16_t>(i));
      continue;
    }
    for (std::size_t k = below + 1; k < i; ++k) {
      const double share = static_cast<double>(k - below) / static_cast<double>(i - below);
      means[k] = means[below] + share * (means[i] - means[below]);
    }
    const bool is_sure = groups[i].count >= kFewPoints && groups[below].count >= kFewPoints;
    if (is_sure && std::abs(means[i] - means[below]) > tolerance) ++(means[i] > means[below] ? rising : falling);
    below = i;
  }
  for (std::size_t i = 0; i < first; ++i) means[i] = means[first];
  std::vector<std::size_t> ascending(groups.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::stable_sort(ascending.begin(), ascending.end(),
                   [&](std::size_t a, std::size_t b) { return means[a] < means[b]; });
  convention.order.assign(groups.size(), 0);
  for (std::size_t i = 0; i < ascending.size(); ++i) convention.order[ascending[i]] = static_cast<std::uint16_t>(i);
  convention.rings = rings;
  convention.ring_count = groups.size();
  convention.are_rings_known = true;
  const std::size_t fewer = std::min(rising, falling);
  convention.are_rings_sorted = !separate(groups) || 10 * fewer <= rising + falling;
  return true;
}

/// Divides elevations at the gaps between rings, or evenly if there are no gaps.
void RingSurvey::concludeElevations(CloudConvention& convention) const {
  const double highest = *std::max_element(histogram_.begin(), histogram_.end());
  std::vector<double> limits;
  std::size_t occupied = 0, last = 0, first = kBins;
  double points = 0.0;
  for (std::size_t i = 0; i < kBins; ++i) {
    points += histogram_[i];
    if (histogram_[i] <= kGapLevel * highest) continue;
    if (occupied > 0 && i > last + 1) limits.push_back(kBin * 0.5 * static_cast<double>(last + i + 1) - kRightAngle);
    first = std::min(first, i);
    last = i;
    ++occupied;
  }
  const bool is_separate = occupied > 0 && limits.size() >= 3 && limits.size() < kMostRings &&
                           static_cast<double>(occupied) < kMostOccupied * static_cast<double>(last - first + 1);
  if (!is_separate) {
    double seen = 0.0, low = NAN, high = 0.0;
    constexpr double kTail = 0.005;  // share of points ignored on either side
    for (std::size_t i = 0; i < kBins; ++i) {
      seen += histogram_[i];
      if (std::isnan(low) && seen > kTail * points) low = kBin * static_cast<double>(i) - kRightAngle;
      if (seen < (1.0 - kTail) * points) high = kBin * static_cast<double>(i + 1) - kRightAngle;
    }
    limits.clear();
    for (std::size_t i = 1; i < kEvenRings; ++i)
      limits.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(kEvenRings));
    std::sort(limits.begin(), limits.end());
  }
  convention.rings = CloudConvention::Rings::Elevation;
  for (const double limit : limits) convention.elevations.push_back(static_cast<float>(limit));
  convention.ring_count = limits.size() + 1;
  convention.are_rings_known = is_separate;
}

void RingSurvey::conclude(CloudConvention& convention) const {
  if (sizes_.empty()) return;
  convention.is_clockwise = turn_ <= 0.0;
  convention.ring_field = field_;
  const double by_row = separate(by_row_) ? spread(by_row_) : 1.0;
  const double by_column = separate(by_column_) ? spread(by_column_) : 1.0;
  const bool has_field = !field_.empty() && concludeGroups(by_field_, CloudConvention::Rings::Field, convention);
  bool is_organised = false;
  if (!has_field) {
    convention.ring_field.clear();
    if (by_row < 1.0 && by_row <= by_column)
      is_organised = concludeGroups(by_row_, CloudConvention::Rings::Rows, convention);
    else if (by_column < 1.0) is_organised = concludeGroups(by_column_, CloudConvention::Rings::Columns, convention);
  }
  if (!has_field && !is_organised) concludeElevations(convention);
  if (is_organised) convention.absent_rings.clear();
  constexpr std::size_t kMostColumns = 65535;
  convention.columns = std::clamp<std::size_t>(typicalSize() / convention.ring_count, 1, kMostColumns);
}

}  // namespace urban_nav_core
