// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/calibration/view_delay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "calibration/calibration_terms.hpp"
#include "calibration/term_selection.hpp"
#include "colour/view_projection.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_registration::ImagePoint;
using urban_nav_registration::Picture;

namespace {

constexpr std::size_t kMostDelaySamples = 20000;
constexpr int kDelaySteps = 20;  // to either side of zero
constexpr int kDelayCount = 2 * kDelaySteps + 1;
constexpr double kDelayStep = 0.005;  // s
constexpr int kParabola = 3;          // steps to either side of the minimum
constexpr float kDarkest = 6.0F, kBrightest = 245.0F;
constexpr float kClip = 0.3F;  // of the logarithm of the brightness: views of something else count no more
constexpr int kExposureRounds = 5;
constexpr std::size_t kFewestSightings = 3;  // of a point
constexpr double kPlaceEdge = 2.0;           // m
constexpr double kChance = 3.0;              // standard errors

using Curve = std::array<double, kDelayCount>;

double delayAt(int step) { return kDelayStep * (step - kDelaySteps); }

/// Returns the logarithm of the brightness between four pixels; nullopt if one of them is dark, bright or outside.
std::optional<float> logBrightness(const Picture& picture, const ImagePoint& at) {
  const int u = static_cast<int>(std::floor(at.u)), v = static_cast<int>(std::floor(at.v));
  if (u < 0 || v < 0 || u + 1 >= picture.width || v + 1 >= picture.height) return std::nullopt;
  const auto fu = static_cast<float>(at.u - u), fv = static_cast<float>(at.v - v);
  float sum = 0.0F;
  for (int dv = 0; dv < 2; ++dv)
    for (int du = 0; du < 2; ++du) {
      const std::uint8_t* pixel =
          &picture.bgr[3 * (static_cast<std::size_t>(v + dv) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(u + du))];
      const float grey = 0.114F * static_cast<float>(pixel[0]) + 0.587F * static_cast<float>(pixel[1]) +
                         0.299F * static_cast<float>(pixel[2]);
      if (grey < kDarkest || grey > kBrightest) return std::nullopt;
      sum += (du == 1 ? fu : 1.0F - fu) * (dv == 1 ? fv : 1.0F - fv) * grey;
    }
  return std::log(sum);
}

float medianOf(std::vector<float>& values) {
  if (values.empty()) return 0.0F;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Disagreement of the views of the points in one cube.
struct PlaceCurve {
  Curve cost{};
  double sightings = 0.0;
  bool is_held_out = false;
};

/// A parabola through a curve around one of its steps.
struct Parabola {
  double slope = 0.0, curvature = 0.0;  ///< at that step, per step
  static Parabola around(const Curve& curve, int step) {
    double linear = 0.0, quadratic = 0.0, squares = 0.0, mean_square = 0.0, spread = 0.0;
    constexpr int count = 2 * kParabola + 1;
    for (int i = -kParabola; i <= kParabola; ++i) mean_square += static_cast<double>(i * i) / count;
    for (int i = -kParabola; i <= kParabola; ++i) {
      const double value = curve[static_cast<std::size_t>(step + i)], square = i * i - mean_square;
      linear += i * value;
      squares += i * i;
      quadratic += square * value;
      spread += square * square;
    }
    return {linear / squares, 2.0 * quadratic / spread};
  }
};

/// Returns a curve's value at a delay, between steps.
double valueAt(const Curve& curve, double delay) {
  const double step = std::clamp(delay / kDelayStep + kDelaySteps, 0.0, kDelayCount - 1.0 - 1e-9);
  const auto i = static_cast<std::size_t>(step);
  const double share = step - static_cast<double>(i);
  return (1.0 - share) * curve[i] + share * curve[i + 1];
}

/// Finds the minimum of the sum of the curves, and its uncertainty by their scatter.
void findMinimum(const std::vector<PlaceCurve>& places, ViewDelay& result) {
  Curve sum{};
  for (const PlaceCurve& place : places)
    if (!place.is_held_out) {
      ++result.places;
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += place.cost[i];
    }
  const auto lowest = static_cast<int>(std::min_element(sum.begin(), sum.end()) - sum.begin());
  if (result.places < 2 || lowest < kParabola || lowest + kParabola >= kDelayCount) return;
  const Parabola whole = Parabola::around(sum, lowest);
  if (!(whole.curvature > 0.0)) return;
  const double offset = -whole.slope / whole.curvature;  // steps
  double scatter = 0.0;
  for (const PlaceCurve& place : places) {
    if (place.is_held_out) continue;
    const Parabola own = Parabola::around(place.cost, lowest);
    scatter += std::pow(own.slope + own.curvature * offset, 2);
  }
  result.delay.value = delayAt(lowest) + kDelayStep * offset;
  result.delay.sigma = kDelayStep * std::sqrt(scatter) / whole.curvature;
  result.delay.constrained = std::abs(offset) <= kParabola && result.delay.sigma < priorSigmas()(0) / 3.0;
}

/// Adopts the delay if it is no chance, and held-out places agree better with it.
void judgeDelay(const std::vector<PlaceCurve>& places, ViewDelay& result) {
  double mean = 0.0, square = 0.0, weights = 0.0;
  std::vector<std::pair<double, double>> differences;
  for (const PlaceCurve& place : places) {
    if (!place.is_held_out) continue;
    ++result.held_out;
    const double stated = place.cost[kDelaySteps], calibrated = valueAt(place.cost, result.delay.value);
    result.stated_spread += stated;
    result.calibrated_spread += calibrated;
    differences.emplace_back(stated - calibrated, place.sightings);
    mean += stated - calibrated;
    weights += place.sightings;
  }
  if (result.held_out < 2 || weights <= 0.0) return;
  for (const auto& [difference, weight] : differences) square += std::pow(difference - mean * weight / weights, 2);
  result.stated_spread = std::sqrt(result.stated_spread / weights);
  result.calibrated_spread = std::sqrt(result.calibrated_spread / weights);
  if (result.delay.constrained && std::abs(result.delay.value) > kChance * result.delay.sigma && mean > 0.0 &&
      mean > kChance * std::sqrt(square))
    result.delay.adopted = result.delay.value;
}

}  // namespace

struct ViewDelayEstimator::ViewData {
  explicit ViewData(const ColourView& view) : projection(view), depth(view.camera.pinhole) {}
  ViewProjection projection;
  urban_nav_registration::DepthMap depth;
};

/// What a view shows of a point at each delay: logarithm of the brightness.
struct ViewDelayEstimator::Sighting {
  std::uint32_t view = 0, point = 0;
  std::array<float, kDelayCount> brightness{};
};

ViewDelayEstimator::ViewDelayEstimator(std::vector<ColourView> views, PoseAt pose_at, double voxel)
    : views_(std::move(views)), pose_at_(std::move(pose_at)), voxel_(voxel) {
  data_.reserve(views_.size());
  for (const ColourView& view : views_) data_.emplace_back(view);
}

ViewDelayEstimator::~ViewDelayEstimator() = default;

void ViewDelayEstimator::addSurface(const std::vector<MapPoint>& points) {
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  for (const MapPoint& point : points) {
    low = low.cwiseMin(point.p.cast<double>());
    high = high.cwiseMax(point.p.cast<double>());
  }
  urban_nav_core::forEach(data_.size(), 1, [&](std::size_t i) {
    if (!data_[i].projection.mayObserve(low, high)) return;
    for (const MapPoint& point : points)
      if (const auto at = data_[i].projection.project(point.p)) data_[i].depth.add(*at, voxel_);
  });
  for (const MapPoint& point : points) {
    if (seen_++ % sample_step_ != 0 || point.normal.squaredNorm() < 0.5F) continue;
    samples_.push_back(point);
    if (samples_.size() < kMostDelaySamples) continue;
    for (std::size_t i = 0; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
    samples_.resize(samples_.size() / 2);
    sample_step_ *= 2;
  }
}

void ViewDelayEstimator::addSightings(const ImageLoader& load, std::size_t view,
                                      std::vector<Sighting>& sightings) const {
  std::vector<ColourView> moved;
  for (int step = 0; step < kDelayCount; ++step) {
    const auto pose = pose_at_(view, delayAt(step));
    if (!pose) return;
    moved.push_back(views_[view]);
    moved.back().T_map_camera = *pose;
  }
  const Picture picture = load(views_[view].image);
  if (picture.width != views_[view].camera.pinhole.width || picture.height != views_[view].camera.pinhole.height)
    return;
  std::vector<ViewProjection> projections(moved.begin(), moved.end());
  const ViewData& data = data_[view];
  std::vector<Sighting> found(samples_.size());
  std::vector<std::uint8_t> is_found(samples_.size(), 0);
  urban_nav_core::forEach(samples_.size(), 256, [&](std::size_t i) {
    const auto stated = data.projection.project(samples_[i].p);
    if (!stated || !data.depth.isVisible(*stated, data.projection.toCamera(samples_[i]))) return;
    found[i].view = static_cast<std::uint32_t>(view);
    found[i].point = static_cast<std::uint32_t>(i);
    for (std::size_t step = 0; step < projections.size(); ++step) {
      const auto at = projections[step].project(samples_[i].p);
      const auto brightness = at ? logBrightness(picture, *at) : std::nullopt;
      if (!brightness) return;
      found[i].brightness[step] = *brightness;
    }
    is_found[i] = 1;
  });
  for (std::size_t i = 0; i < found.size(); ++i)
    if (is_found[i] != 0) sightings.push_back(found[i]);
}

/// Returns by how much each view is brighter than the others, as the logarithm: exposures differ.
std::vector<float> ViewDelayEstimator::brightnessOf(const std::vector<Sighting>& sightings) const {
  std::vector<float> views(views_.size(), 0.0F), points(samples_.size(), 0.0F);
  for (int round = 0; round < kExposureRounds; ++round) {
    std::vector<std::vector<float>> of_point(samples_.size()), of_view(views_.size());
    for (const Sighting& each : sightings)
      of_point[each.point].push_back(each.brightness[kDelaySteps] - views[each.view]);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = medianOf(of_point[i]);
    for (const Sighting& each : sightings)
      of_view[each.view].push_back(each.brightness[kDelaySteps] - points[each.point]);
    for (std::size_t i = 0; i < views.size(); ++i) views[i] = medianOf(of_view[i]);
  }
  return views;
}

ViewDelay ViewDelayEstimator::estimate(const ImageLoader& load) const {
  std::vector<Sighting> sightings;
  for (std::size_t view = 0; view < views_.size(); ++view) addSightings(load, view, sightings);
  const std::vector<float> exposure = brightnessOf(sightings);
  std::sort(sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
    return a.point != b.point ? a.point < b.point : a.view < b.view;
  });
  std::map<std::array<long, 3>, PlaceCurve> places;
  for (std::size_t first = 0, last = 0; first < sightings.size(); first = last) {
    while (last < sightings.size() && sightings[last].point == sightings[first].point) ++last;
    if (last - first < kFewestSightings) continue;
    const Vector3d p = samples_[sightings[first].point].p.cast<double>() / kPlaceEdge;
    const std::array<long, 3> key{std::lround(std::floor(p.x())), std::lround(std::floor(p.y())),
                                  std::lround(std::floor(p.z()))};
    PlaceCurve& place = places[key];
    place.is_held_out = ((key[0] + 2 * key[1] + 3 * key[2]) % 5 + 5) % 5 == 0;
    place.sightings += static_cast<double>(last - first);
    for (std::size_t step = 0; step < kDelayCount; ++step) {
      float mean = 0.0F;
      for (std::size_t i = first; i < last; ++i)
        mean += (sightings[i].brightness[step] - exposure[sightings[i].view]) / static_cast<float>(last - first);
      for (std::size_t i = first; i < last; ++i) {
        const float difference = sightings[i].brightness[step] - exposure[sightings[i].view] - mean;
        place.cost[step] += static_cast<double>(std::min(difference * difference, kClip * kClip));
      }
    }
  }
  std::vector<PlaceCurve> all;
  for (const auto& [key, place] : places) all.push_back(place);
  ViewDelay result;
  findMinimum(all, result);
  judgeDelay(all, result);
  return result;
}

}  // namespace laser_mapper
