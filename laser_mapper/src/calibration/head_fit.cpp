// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/head_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "calibration/view_brightness.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kRoundsPerLevel = 4, kFinestRounds = 10;
constexpr float kBrightnessClip =
    0.3F;  // of the logarithm of the brightness: a view that differs more shows something else
constexpr int kExposureRounds = 5;
constexpr std::size_t kFewestSightings = 3;             // of a point
constexpr double kHeadPlaceEdge = 2.0;                  // m
constexpr double kHeadBeyondChance = 3.0;               // standard errors
constexpr double kNearestSeen = 0.3, kLensStep = 1e-4;  // m; of the tangents, for differences
constexpr double kLeastIncidence = 0.2;  // cosine: farther from the normal, a view shows little of a surface
constexpr std::size_t kSightingGrain = 1024;

float medianBrightness(std::vector<float>& values) {
  if (values.empty()) return 0.0F;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// See HeadFit::Row.
using Shifts = Eigen::Matrix<float, 2, kCalibrationTerms>;

/// A pixel, and its derivatives with respect to the point in the frame of the camera.
struct LensPoint {
  Vector2d pixel;
  Eigen::Matrix<double, 2, 3> derivatives;
};

std::optional<LensPoint> throughLens(const urban_nav_core::RawCamera& camera, const Vector3d& q) {
  if (q.z() < kNearestSeen) return std::nullopt;
  const Vector3d ray = q / q.z();
  const auto pixel = camera.project(ray), right = camera.project(ray + kLensStep * Vector3d::UnitX()),
             below = camera.project(ray + kLensStep * Vector3d::UnitY());
  if (!pixel || !right || !below) return std::nullopt;
  Eigen::Matrix2d lens;
  lens << (*right - *pixel) / kLensStep, (*below - *pixel) / kLensStep;
  Eigen::Matrix<double, 2, 3> division;
  division << 1.0, 0.0, -ray.x(), 0.0, 1.0, -ray.y();
  return LensPoint{*pixel, lens * division / q.z()};
}

}  // namespace

/// Sum of the squared differences of the views of the points in one place.
struct HeadFit::PlaceSpread {
  double squares = 0.0, sightings = 0.0;
};

HeadFit::HeadFit(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base, const Vector3d& centre)
    : images_(images), T_map_base_(T_map_base), centre_(centre), exposures_(images.views.size(), 0.0F) {
  std::map<std::array<long, 3>, std::uint32_t> numbers;
  for (const Vector3d& p : images.points) {
    const std::array<long, 3> key{std::lround(std::floor(p.x() / kHeadPlaceEdge)),
                                  std::lround(std::floor(p.y() / kHeadPlaceEdge)),
                                  std::lround(std::floor(p.z() / kHeadPlaceEdge))};
    const auto [place, is_new] = numbers.emplace(key, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) is_held_out_.push_back(((key[0] + 2 * key[1] + 3 * key[2]) % 5 + 5) % 5 == 0 ? 1 : 0);
    place_of_.push_back(place->second);
  }
}

std::vector<HeadFit::Row> HeadFit::rowsAt(const TermVector& terms, int level) const {
  std::vector<std::optional<ViewMotion>> motions(images_.views.size());
  for (std::size_t i = 0; i < motions.size(); ++i)
    motions[i] = viewMotionAt(images_.views[i], T_map_base_, centre_, terms);
  std::vector<Row> rows(images_.sightings.size());
  urban_nav_core::forEach(rows.size(), kSightingGrain, [&](std::size_t i) {
    const HeadSighting& sighting = images_.sightings[i];
    const auto& motion = motions[sighting.view];
    if (!motion) return;
    const Vector3d &p = images_.points[sighting.point], &normal = images_.normals[sighting.point];
    const Vector3d q = motion->R * p + motion->t;
    if (std::abs((motion->R * normal).dot(q.normalized())) < kLeastIncidence) return;
    const auto lens = throughLens(images_.views[sighting.view].camera, q);
    if (!lens) return;
    const auto shown = brightnessAt(images_.pyramids[sighting.view], level, lens->pixel);
    if (!shown) return;
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = normal.unitOrthogonal();
    axes.col(1) = normal.cross(axes.col(0));
    const Eigen::Matrix2d px_per_m = lens->derivatives * motion->R * axes;
    const Shifts shifts = (px_per_m.inverse() * lens->derivatives * motion->derivatives(p)).cast<float>();
    if (!shifts.allFinite()) return;
    const Eigen::Vector2f texture = (px_per_m.transpose() * shown->slope).cast<float>();
    rows[i].brightness = static_cast<float>(shown->value);
    Eigen::Map<Shifts>(rows[i].shifts.data()) = shifts;
    rows[i].texture = {texture.x(), texture.y()};
    rows[i].is_seen = true;
  });
  return rows;
}

/// By medians over points and views in turn.
void HeadFit::estimateExposures(const std::vector<Row>& rows) {
  std::vector<float> points(images_.points.size(), 0.0F);
  for (int round = 0; round < kExposureRounds; ++round) {
    std::vector<std::vector<float>> of_view(exposures_.size());
    std::vector<float> of_point;
    for (std::size_t first = 0, last = 0; first < rows.size(); first = last) {
      const std::uint32_t point = images_.sightings[first].point;
      of_point.clear();
      for (; last < rows.size() && images_.sightings[last].point == point; ++last)
        if (rows[last].is_seen) of_point.push_back(rows[last].brightness - exposures_[images_.sightings[last].view]);
      points[point] = medianBrightness(of_point);
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i].is_seen)
        of_view[images_.sightings[i].view].push_back(rows[i].brightness - points[images_.sightings[i].point]);
    for (std::size_t view = 0; view < exposures_.size(); ++view) exposures_[view] = medianBrightness(of_view[view]);
  }
}

/// Calls visit(place, first, last, median) for the points of places that are held out, or not, and that several views
/// show: by their rows, which are less the exposures.
template <typename Visit>
void HeadFit::forEachPoint(const std::vector<Row>& rows, bool held_out, const Visit& visit) const {
  std::vector<float> values;
  for (std::size_t first = 0, last = 0; first < rows.size(); first = last) {
    const std::uint32_t point = images_.sightings[first].point;
    values.clear();
    for (; last < rows.size() && images_.sightings[last].point == point; ++last)
      if (rows[last].is_seen) values.push_back(rows[last].brightness);
    if ((is_held_out_[place_of_[point]] != 0) == held_out && values.size() >= kFewestSightings)
      visit(place_of_[point], first, last, medianBrightness(values));
  }
}

/// Equations of the terms, from which the brightness of each point is eliminated. Views beyond kBrightnessClip of the
/// median of their point take no part.
TermEquations HeadFit::linearise(std::vector<Row> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].brightness -= exposures_[images_.sightings[i].view];
  TermEquations equations = zeroEquations(1);
  std::vector<TermVector> of_place(is_held_out_.size(), TermVector::Zero());
  std::vector<std::uint8_t> is_used(is_held_out_.size(), 0);
  double squares = 0.0, freedom = 0.0;
  forEachPoint(rows, false, [&](std::uint32_t place, std::size_t first, std::size_t last, float median) {
    const auto is_near = [&](const Row& row) {
      return row.is_seen && std::abs(row.brightness - median) < kBrightnessClip;
    };
    Shifts mean = Shifts::Zero();
    Eigen::Vector2f texture = Eigen::Vector2f::Zero();
    float brightness = 0.0F, count = 0.0F;
    for (std::size_t i = first; i < last; ++i)
      if (is_near(rows[i])) {
        mean += Eigen::Map<const Shifts>(rows[i].shifts.data());
        texture += Eigen::Vector2f(rows[i].texture[0], rows[i].texture[1]);
        brightness += rows[i].brightness - median;
        count += 1.0F;
      }
    if (count < 2.0F) return;
    mean /= count;
    texture /= count;
    brightness = median + brightness / count;
    for (std::size_t i = first; i < last; ++i)
      if (is_near(rows[i])) {
        const Shifts apart = Eigen::Map<const Shifts>(rows[i].shifts.data()) - mean;
        const TermVector row = (apart.transpose() * texture).cast<double>();
        const auto residual = static_cast<double>(rows[i].brightness - brightness);
        equations.information.noalias() += row * row.transpose();
        of_place[place] -= residual * row;
        squares += residual * residual;
      }
    freedom += static_cast<double>(count) - 1.0;
    is_used[place] = 1;
  });
  if (freedom <= 0.0) return equations;
  const double variance = std::max(squares / freedom, 1e-12);
  equations.information /= variance;
  for (const TermVector& gradient : of_place) {
    equations.gradient += gradient / variance;
    equations.scatter.noalias() += gradient * gradient.transpose() / (variance * variance);
  }
  equations.patches = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), std::uint8_t{1}));
  return equations;
}

TermEstimate HeadFit::estimate(const std::vector<bool>& wanted) {
  for (Index t = 0; t < kCalibrationTerms; ++t)
    if (!wanted[static_cast<std::size_t>(t)]) terms_(t) = 0.0;
  const bool all = std::all_of(wanted.begin(), wanted.end(), [](bool is_wanted) { return is_wanted; });
  TermEstimate estimate;
  for (int level = all ? kHeadLevels - 1 : 0; level >= 0; --level)
    for (int round = 0; round < (level > 0 ? kRoundsPerLevel : kFinestRounds); ++round) {
      std::vector<Row> rows = rowsAt(terms_, level);
      if (round == 0) estimateExposures(rows);
      TermEquations equations = linearise(std::move(rows));
      equations_places_ = equations.patches;
      if (equations.patches == 0) break;
      const auto step = solveTerms(std::move(equations), terms_, wanted);
      if (!step) return estimate;
      terms_ = step->estimate.mean;
      estimate = step->estimate;
      if (isConverged(*step)) break;
    }
  return estimate;
}

std::vector<HeadFit::PlaceSpread> HeadFit::spreadsAt(const TermVector& terms) {
  std::vector<Row> rows = rowsAt(terms, 0);
  estimateExposures(rows);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].brightness -= exposures_[images_.sightings[i].view];
  std::vector<PlaceSpread> spreads(is_held_out_.size());
  forEachPoint(rows, true, [&](std::uint32_t place, std::size_t first, std::size_t last, float median) {
    for (std::size_t i = first; i < last; ++i) {
      if (!rows[i].is_seen) continue;
      const float difference = std::min(std::abs(rows[i].brightness - median), kBrightnessClip);
      spreads[place].squares += static_cast<double>(difference * difference);
      spreads[place].sightings += 1.0;
    }
  });
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
