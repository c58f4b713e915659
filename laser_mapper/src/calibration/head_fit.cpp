// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/head_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

constexpr int kRoundsPerLevel = 4, kFinestRounds = 10;
constexpr float kBrightnessClip = 0.3F;  // of the logarithm of the brightness: larger differences are occlusions
constexpr int kExposureRounds = 5;
constexpr std::size_t kFewestViews = 3;      // views per point
constexpr double kHeadPlaceEdge = 2.0;       // m
constexpr double kHeadBeyondChance = 3.0;    // standard errors of significance
constexpr double kLeastRowVariance = 1e-12;  // of logarithms: for images without noise
constexpr std::size_t kPlaceBatch = 64;      // places whose equations are in memory at a time

float medianBrightness(std::vector<float>& values) {
  if (values.empty()) return 0.0F;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<FreeTrajectory> freeStretches(const urban_nav_core::Trajectory& T_map_base,
                                          const urban_nav_core::OdometryChain* odometry) {
  std::vector<FreeTrajectory> stretches;
  for (const CalibrationInterval& interval : divideTrajectory(T_map_base))
    stretches.emplace_back(T_map_base, odometry, interval, kCalibrationTerms);
  return stretches;
}

}  // namespace

/// Sum of squared differences of the views of the points in one place.
struct HeadFit::PlaceSpread {
  double squares = 0.0, sightings = 0.0;
};

/// Point observed by several views.
struct HeadFit::PointRows {
  HeadPoint point;
  std::uint32_t place = 0;
  float median = 0.0F;  ///< brightness minus exposures

  bool isNear(const HeadRow& row) const { return row.is_seen && std::abs(row.brightness - median) < kBrightnessClip; }
};

HeadFit::HeadFit(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base,
                 const urban_nav_core::OdometryChain* odometry, const Vector3d& centre, double range_bias)
    : stretches_(freeStretches(T_map_base, odometry)),
      views_(images, T_map_base, centre, stretches_),
      exposures_(images.views.size(), 0.0F),
      range_bias_(range_bias) {
  std::map<std::array<long, 3>, std::uint32_t> numbers;
  for (const HeadPoint& point : views_.points()) {
    const Vector3d& p = images.points[images.sightings[point.first].point];
    const std::array<long, 3> key{std::lround(std::floor(p.x() / kHeadPlaceEdge)),
                                  std::lround(std::floor(p.y() / kHeadPlaceEdge)),
                                  std::lround(std::floor(p.z() / kHeadPlaceEdge))};
    const auto [place, is_new] = numbers.emplace(key, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) is_held_out_.push_back(((key[0] + 2 * key[1] + 3 * key[2]) % 5 + 5) % 5 == 0 ? 1 : 0);
    place_of_.push_back(place->second);
    distance_ += (p - point.measured.base).squaredNorm();
  }
  distance_ = std::sqrt(distance_ / static_cast<double>(std::max<std::size_t>(1, place_of_.size())));
}

/// Alternates medians over points and over views.
void HeadFit::estimateExposures(const std::vector<HeadRow>& rows) {
  std::vector<float> points(views_.images().points.size(), 0.0F);
  for (int round = 0; round < kExposureRounds; ++round) {
    std::vector<std::vector<float>> of_view(exposures_.size());
    std::vector<float> of_point;
    for (const HeadPoint& point : views_.points()) {
      of_point.clear();
      for (std::size_t i = point.first; i < point.last; ++i)
        if (rows[i].is_seen) of_point.push_back(rows[i].brightness - exposures_[views_.images().sightings[i].view]);
      points[views_.images().sightings[point.first].point] = medianBrightness(of_point);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].is_seen)
        of_view[views_.images().sightings[i].view].push_back(rows[i].brightness -
                                                             points[views_.images().sightings[i].point]);
    for (std::size_t view = 0; view < exposures_.size(); ++view) exposures_[view] = medianBrightness(of_view[view]);
  }
}

/// Returns the points of held-out places, or of the others, with several views. `rows`: minus the exposures.
std::vector<HeadFit::PointRows> HeadFit::usablePoints(const std::vector<HeadRow>& rows, bool held_out) const {
  std::vector<PointRows> usable;
  std::vector<float> values;
  for (std::size_t number = 0; number < place_of_.size(); ++number) {
    const HeadPoint& point = views_.points()[number];
    if ((is_held_out_[place_of_[number]] != 0) != held_out) continue;
    values.clear();
    for (std::size_t i = point.first; i < point.last; ++i)
      if (rows[i].is_seen) values.push_back(rows[i].brightness);
    if (values.size() >= kFewestViews) usable.push_back({point, place_of_[number], medianBrightness(values)});
  }
  return usable;
}

/// Returns the rows of a point's views that are near their median; none if there are fewer than two.
std::vector<BrightnessRow> HeadFit::brightnessRows(const std::vector<HeadRow>& rows, const PointRows& point) const {
  const HeadPoint& at = point.point;
  Eigen::Vector2f texture = Eigen::Vector2f::Zero();
  float count = 0.0F;
  for (std::size_t i = at.first; i < at.last; ++i)
    if (point.isNear(rows[i])) {
      texture += Eigen::Vector2f(rows[i].texture[0], rows[i].texture[1]);
      count += 1.0F;
    }
  std::vector<BrightnessRow> made;
  if (count < 2.0F) return made;
  texture /= count;
  for (std::size_t i = at.first; i < at.last; ++i) {
    if (!point.isNear(rows[i])) continue;
    const HeadMoment& seen = views_.moment(i);
    const Vector3d& p = views_.images().points[views_.images().sightings[i].point];
    const Vector3d slope =
        (Eigen::Map<const HeadRow::PointShifts>(rows[i].motion.data()).transpose() * texture).cast<double>();
    BrightnessRow row;
    row.residual = static_cast<double>(rows[i].brightness - point.median);
    row.terms = (Eigen::Map<const HeadRow::TermShifts>(rows[i].shifts.data()).transpose() * texture).cast<double>();
    row.at_view << -slope, -(p - seen.base).cross(slope);
    row.at_point << slope, (p - at.measured.base).cross(slope);
    row.view_share = seen.share;
    row.point_share = at.measured.share;
    made.push_back(row);
  }
  return made;
}

/// Returns the equations of the terms with the brightness of each point and the trajectory eliminated.
TermEquations HeadFit::linearise(std::vector<HeadRow> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].brightness -= exposures_[views_.images().sightings[i].view];
  std::vector<PointRows> points = usablePoints(rows, false);
  const double variance = rowVariance(rows, points);
  if (!(variance > 0.0)) return zeroEquations(1);
  const auto order = [](const PointRows& each) { return std::make_pair(each.point.measured.stretch, each.place); };
  std::stable_sort(points.begin(), points.end(),
                   [&](const PointRows& a, const PointRows& b) { return order(a) < order(b); });
  std::vector<std::size_t> begins;  // points in one place and interval
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || order(points[i - 1]) != order(points[i])) begins.push_back(i);
  begins.push_back(points.size());
  for (FreeTrajectory& stretch : stretches_) stretch.clear();
  std::vector<PlaceEquations> equations(kPlaceBatch);
  for (std::size_t first = 0; first + 1 < begins.size(); first += kPlaceBatch) {
    const std::size_t count = std::min(kPlaceBatch, begins.size() - 1 - first);
    urban_nav_core::forEach(count, 1, [&](std::size_t i) {
      std::vector<std::vector<BrightnessRow>> all;
      for (std::size_t p = begins[first + i]; p < begins[first + i + 1]; ++p)
        if (auto of_point = brightnessRows(rows, points[p]); !of_point.empty()) all.push_back(std::move(of_point));
      equations[i] = sumBrightnessRows(all, variance);
    });
    for (std::size_t i = 0; i < count; ++i)
      if (!equations[i].seconds.empty())
        stretches_[points[begins[first + i]].point.measured.stretch].add(std::move(equations[i]));
  }
  TermEquations sum = zeroEquations(1);
  for (FreeTrajectory& stretch : stretches_) sum += stretch.eliminate();
  return sum;
}

/// Returns the mean squared difference of a point's views, over all points; 0 if no point has two views.
double HeadFit::rowVariance(const std::vector<HeadRow>& rows, const std::vector<PointRows>& points) {
  double squares = 0.0, freedom = 0.0;
  for (const PointRows& point : points) {
    double first = 0.0, second = 0.0, count = 0.0;
    for (std::size_t i = point.point.first; i < point.point.last; ++i)
      if (point.isNear(rows[i])) {
        const auto difference = static_cast<double>(rows[i].brightness - point.median);
        first += difference;
        second += difference * difference;
        count += 1.0;
      }
    if (count < 2.0) continue;
    squares += second - first * first / count;
    freedom += count - 1.0;
  }
  return freedom > 0.0 ? std::max(squares / freedom, kLeastRowVariance) : 0.0;
}

/// A common range error of all points is equivalent to a shift of the head by it, or a rotation by it over their
/// distance.
void HeadFit::addRangeBias(const std::vector<bool>& wanted, TermEstimate& estimate) const {
  const double variance = range_bias_ * range_bias_, squared_distance = std::max(1.0, distance_ * distance_);
  for (Index t = 1; t < kCalibrationTerms; ++t)
    if (wanted[static_cast<std::size_t>(t)])
      estimate.covariance(t, t) += t < 4 ? variance : variance / squared_distance;
}

TermEstimate HeadFit::estimate(const std::vector<bool>& wanted) {
  TermEstimate estimate = fit(wanted);
  if (estimate.mean.size() > 0) addRangeBias(wanted, estimate);
  return estimate;
}

/// Estimates the terms from the images only.
TermEstimate HeadFit::fit(const std::vector<bool>& wanted) {
  for (Index t = 0; t < kCalibrationTerms; ++t)
    if (!wanted[static_cast<std::size_t>(t)]) terms_(t) = 0.0;
  const bool all = std::all_of(wanted.begin(), wanted.end(), [](bool is_wanted) { return is_wanted; });
  TermEstimate estimate;
  for (int level = all ? kHeadLevels - 1 : 0; level >= 0; --level)
    for (int round = 0; round < (level > 0 ? kRoundsPerLevel : kFinestRounds); ++round) {
      std::vector<HeadRow> rows = views_.rowsAt(terms_, level, true);
      if (round == 0) estimateExposures(rows);
      TermEquations equations = linearise(std::move(rows));
      equations_places_ = equations.patches;
      if (equations.patches == 0) break;
      const auto step = solveTerms(std::move(equations), terms_, wanted);
      if (!step) return estimate;
      terms_ = step->estimate.mean;
      for (FreeTrajectory& stretch : stretches_) stretch.move(step->change);
      estimate = step->estimate;
      if (isConverged(*step)) break;
    }
  return estimate;
}

std::vector<HeadFit::PlaceSpread> HeadFit::spreadsAt(const TermVector& terms) {
  std::vector<HeadRow> rows = views_.rowsAt(terms, 0, false);
  estimateExposures(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].brightness -= exposures_[views_.images().sightings[i].view];
  std::vector<PlaceSpread> spreads(is_held_out_.size());
  for (const PointRows& point : usablePoints(rows, true))
    for (std::size_t i = point.point.first; i < point.point.last; ++i) {
      if (!rows[i].is_seen) continue;
      const float difference = std::min(std::abs(rows[i].brightness - point.median), kBrightnessClip);
      spreads[point.place].squares += static_cast<double>(difference * difference);
      spreads[point.place].sightings += 1.0;
    }
  return spreads;
}

HeadFit::HeldOut HeadFit::compareHeldOut() {
  const std::vector<PlaceSpread> stated = spreadsAt(TermVector::Zero()), calibrated = spreadsAt(terms_);
  HeldOut result;
  double sightings = 0.0, improvement = 0.0;
  std::vector<std::pair<double, double>> places;  // improvement, sightings
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const double count = std::min(stated[i].sightings, calibrated[i].sightings);
    if (count <= 0.0) continue;
    const double before = stated[i].squares * count / stated[i].sightings,
                 after = calibrated[i].squares * count / calibrated[i].sightings;
    result.stated += before;
    result.calibrated += after;
    places.emplace_back(before - after, count);
    improvement += before - after;
    sightings += count;
  }
  result.places = places.size();
  if (places.size() < 2) return result;
  double scatter = 0.0;
  for (const auto& [difference, count] : places) scatter += std::pow(difference - improvement * count / sightings, 2);
  result.stated = std::sqrt(result.stated / sightings);
  result.calibrated = std::sqrt(result.calibrated / sightings);
  result.improves = improvement > 0.0 && improvement > kHeadBeyondChance * std::sqrt(scatter);
  return result;
}

}  // namespace laser_mapper
