// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/calibration/view_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/head_fit.hpp"
#include "calibration/view_brightness.hpp"
#include "colour/view_projection.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kMostSamples = 20000;
constexpr double kMostPixels = 1e8;                // of all views: about 130 MB with their pyramids
constexpr StampNs kViewWindow = 30'000'000'000;    // views of an interval are used or ignored together
constexpr StampNs kLongestApart = 20'000'000'000;  // between the beams of a point and a view of it
constexpr StampNs kViewMargin = 300'000'000, kLongestViewGap = 500'000'000;

/// Returns the views at times covered by the trajectory for any delay, from every n-th interval such that their images
/// fit into memory.
std::vector<MountedView> usableViews(std::vector<MountedView> views, const urban_nav_core::Trajectory& T_map_base) {
  double pixels = 0.0;
  StampNs begin = 0;
  for (const MountedView& view : views) {
    pixels += static_cast<double>(view.camera.pinhole.width) * view.camera.pinhole.height;
    begin = &view == &views.front() ? view.stamp : std::min(begin, view.stamp);
  }
  const auto stride = static_cast<StampNs>(std::max(1.0, std::ceil(pixels / kMostPixels)));
  views.erase(std::remove_if(views.begin(), views.end(),
                             [&](const MountedView& view) {
                               return (view.stamp - begin) / kViewWindow % stride != 0 ||
                                      !T_map_base.at(view.stamp - kViewMargin, kLongestViewGap) ||
                                      !T_map_base.at(view.stamp, kLongestViewGap) ||
                                      !T_map_base.at(view.stamp + kViewMargin, kLongestViewGap);
                             }),
              views.end());
  return views;
}

Vector3d cameraMiddle(const std::vector<MountedView>& views) {
  std::vector<Vector3d> cameras;
  for (const MountedView& view : views)
    if (std::none_of(cameras.begin(), cameras.end(),
                     [&](const Vector3d& other) { return (other - view.T_base_camera.t()).norm() < 1e-9; }))
      cameras.push_back(view.T_base_camera.t());
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& camera : cameras) sum += camera / static_cast<double>(cameras.size());
  return sum;
}

}  // namespace

Pose ViewCalibration::headCorrection() const {
  TermVector terms;
  for (int t = 0; t < kCalibrationTerms; ++t) terms(t) = head.terms[static_cast<std::size_t>(t)].adopted;
  return laser_mapper::headCorrection(terms, centre);
}

struct ViewCalibrator::ViewData {
  ViewData(const MountedView& view, const Pose& T_map_base)
      : stated{view.camera, T_map_base * view.T_base_camera, view.stamp, view.image}, depth(view.camera.pinhole) {}
  ColourView stated;
  urban_nav_registration::DepthMap depth;
};

ViewCalibrator::ViewCalibrator(std::vector<MountedView> views, const urban_nav_core::Trajectory& T_map_base,
                               const urban_nav_core::OdometryChain* odometry, double voxel, double range_bias)
    : views_(usableViews(std::move(views), T_map_base)),
      T_map_base_(T_map_base),
      odometry_(odometry),
      voxel_(voxel),
      range_bias_(range_bias),
      centre_(cameraMiddle(views_)),
      samples_(kMostSamples) {
  for (const MountedView& view : views_) data_.emplace_back(view, *T_map_base.at(view.stamp, kLongestViewGap));
}

ViewCalibrator::~ViewCalibrator() = default;

void ViewCalibrator::addSurface(const std::vector<MapPoint>& points) {
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  for (const MapPoint& point : points) {
    low = low.cwiseMin(point.p.cast<double>());
    high = high.cwiseMax(point.p.cast<double>());
  }
  urban_nav_core::forEach(data_.size(), 1, [&](std::size_t i) {
    const ViewProjection projection(data_[i].stated);
    if (!projection.mayObserve(low, high)) return;
    for (const MapPoint& point : points)
      if (const auto at = projection.project(point.p)) data_[i].depth.add(*at, voxel_);
  });
  for (const MapPoint& point : points)
    if (point.normal.squaredNorm() > 0.5F) samples_.add(point);
}

ViewCalibration ViewCalibrator::estimate(const std::string& name, const ImageLoader& load) const {
  ViewCalibration result;
  result.head.frame = name;
  result.centre = centre_;
  HeadImages images;
  images.views = views_;
  const std::vector<MapPoint>& samples = samples_.items();
  for (const MapPoint& point : samples) {
    images.points.push_back(point.p.cast<double>());
    images.normals.push_back(point.normal.cast<double>().normalized());
    images.stamps.push_back(point.stamp);
  }
  std::vector<std::vector<std::uint32_t>> shown(views_.size());
  for (const MountedView& view : views_) {
    const urban_nav_registration::Picture picture = load(view.image);
    const bool fits = picture.width == view.camera.pinhole.width && picture.height == view.camera.pinhole.height;
    images.pyramids.push_back(fits ? greyPyramid(picture, kHeadLevels) : urban_nav_core::Pyramid(kHeadLevels));
  }
  urban_nav_core::forEach(views_.size(), 1, [&](std::size_t view) {
    const ViewProjection projection(data_[view].stated);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (std::abs(samples[i].stamp - views_[view].stamp) > kLongestApart) continue;
      const auto at = projection.project(samples[i].p);
      if (at && data_[view].depth.isVisible(*at, projection.toCamera(samples[i])))
        shown[view].push_back(static_cast<std::uint32_t>(i));
    }
  });
  for (std::size_t view = 0; view < shown.size(); ++view)
    for (const std::uint32_t point : shown[view]) images.sightings.push_back({point, static_cast<std::uint32_t>(view)});
  std::sort(images.sightings.begin(), images.sightings.end(), [](const HeadSighting& a, const HeadSighting& b) {
    return a.point != b.point ? a.point < b.point : a.view < b.view;
  });
  HeadFit fit(images, T_map_base_, odometry_, centre_, range_bias_);
  const TermSelection selected =
      selectTerms(kCalibrationTerms, [&](const std::vector<bool>& wanted) { return fit.estimate(wanted); });
  if (selected.all.mean.size() == 0) return result;
  result.places = fit.places();
  result.unconstrained =
      describeUnconstrained(selected.all, {MountedLaser{name, Pose(Eigen::Quaterniond::Identity(), centre_), 0}});
  result.is_significant = selected.holdsAny();
  const HeadFit::HeldOut held_out = fit.compareHeldOut();
  result.held_out = held_out.places;
  result.stated_spread = held_out.stated;
  result.calibrated_spread = held_out.calibrated;
  result.improves = held_out.improves;
  result.head = selected.device(0, name, result.isAdopted());
  return result;
}

}  // namespace laser_mapper
