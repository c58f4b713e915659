// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/colour/colouriser.hpp"

#include <algorithm>
#include <cmath>

#include "colour/depth_map_pool.hpp"
#include "colour/image_gains.hpp"
#include "colour/view_projection.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_registration::ImagePoint;
using urban_nav_registration::Picture;

namespace {

constexpr std::size_t kMaxSamples = 40000;
constexpr int kBestViews = 9;     // views per point, for its median
constexpr int kLargestPatch = 3;  // px to either side
constexpr float kSaturated = 250.0F, kDark = 4.0F;
constexpr std::size_t kPointGrain = 512;

/// Colour of a point in a view.
struct PointView {
  float weight = 0.0F;
  std::array<float, 3> colour{};
};

/// Best views of a point, and their number.
struct BestViews {
  std::array<PointView, kBestViews> views;
  int count = 0;

  void add(const PointView& view) {
    int at = count < kBestViews ? count++ : kBestViews - 1;
    if (at == kBestViews - 1 && views[static_cast<std::size_t>(at)].weight >= view.weight) return;
    while (at > 0 && views[static_cast<std::size_t>(at - 1)].weight < view.weight) {
      views[static_cast<std::size_t>(at)] = views[static_cast<std::size_t>(at - 1)];
      --at;
    }
    views[static_cast<std::size_t>(at)] = view;
  }

  float weightedMedian(std::size_t channel) const {
    std::array<std::pair<float, float>, kBestViews> values;
    float all = 0.0F;
    for (int i = 0; i < count; ++i) {
      const PointView& view = views[static_cast<std::size_t>(i)];
      values[static_cast<std::size_t>(i)] = {view.colour[channel], view.weight};
      all += view.weight;
    }
    std::sort(values.begin(), values.begin() + count);
    float below = 0.0F;
    for (int i = 0; i < count; ++i) {
      below += values[static_cast<std::size_t>(i)].second;
      if (2.0F * below >= all) return values[static_cast<std::size_t>(i)].first;
    }
    return 0.0F;
  }
};

/// Returns the mean of a patch with the size of a map point in the image.
std::array<float, 3> patchColour(const Picture& picture, const ImagePoint& at, double edge, double focal) {
  const int half = std::clamp(static_cast<int>(std::lround(0.5 * (edge * focal / at.depth - 1.0))), 0, kLargestPatch);
  const int u0 = static_cast<int>(std::lround(at.u)), v0 = static_cast<int>(std::lround(at.v));
  std::array<float, 3> sum{};
  float count = 0.0F;
  for (int v = std::max(0, v0 - half); v <= std::min(picture.height - 1, v0 + half); ++v)
    for (int u = std::max(0, u0 - half); u <= std::min(picture.width - 1, u0 + half); ++u) {
      const std::uint8_t* pixel =
          &picture.bgr[3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(u))];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<float>(pixel[c]);
      count += 1.0F;
    }
  for (float& value : sum) value /= std::max(count, 1.0F);
  return sum;
}

bool isUsable(const std::array<float, 3>& colour) {
  return std::all_of(colour.begin(), colour.end(), [](float value) { return value > kDark && value < kSaturated; });
}

/// Prefers near views with small incidence angle, away from the edge of the lens.
float viewWeight(const MapPoint& point, const ImagePoint& at, const ViewProjection& projection) {
  const Vector3d to_view = (projection.centre() - point.p.cast<double>()) / at.depth;
  const double cosine = point.normal.squaredNorm() > 0.5F ? std::abs(point.normal.cast<double>().dot(to_view)) : 0.5;
  const urban_nav_core::Pinhole& pinhole = projection.view().camera.pinhole;
  const double x = (at.u - pinhole.cx) / pinhole.fx, y = (at.v - pinhole.cy) / pinhole.fy;
  const double centred = 1.0 / (1.0 + x * x + y * y);
  return static_cast<float>((0.05 + cosine) * centred / (1.0 + 0.04 * at.depth * at.depth));
}

}  // namespace

struct Colouriser::Depths {
  Depths(std::size_t budget, std::string folder) : pool(budget, std::move(folder)) {}
  DepthMapPool pool;
};

Colouriser::Colouriser(std::vector<ColourView> views, ImageLoader load, double voxel, ColourMemory memory)
    : views_(std::move(views)),
      load_(std::move(load)),
      voxel_(voxel),
      cached_images_(std::max<std::size_t>(1, memory.cached_images)),
      depths_(std::make_unique<Depths>(memory.depth_bytes, std::move(memory.folder))),
      samples_(kMaxSamples),
      gains_(views_.size(), {1.0F, 1.0F, 1.0F}) {
  projections_.reserve(views_.size());
  for (const ColourView& view : views_) {
    projections_.emplace_back(view);
    depths_->pool.add(view.camera.pinhole);
  }
}

Colouriser::~Colouriser() = default;

std::vector<std::size_t> Colouriser::viewsNear(const std::vector<MapPoint>& points) const {
  Vector3d low = Vector3d::Constant(1e300), high = Vector3d::Constant(-1e300);
  for (const MapPoint& point : points) {
    low = low.cwiseMin(point.p.cast<double>());
    high = high.cwiseMax(point.p.cast<double>());
  }
  std::vector<std::size_t> near;
  for (std::size_t view = 0; view < projections_.size(); ++view)
    if (projections_[view].mayObserve(low, high)) near.push_back(view);
  return near;
}

void Colouriser::addSurface(const std::vector<MapPoint>& points) {
  const std::vector<std::size_t> near = viewsNear(points);
  depths_->pool.hold(near, DepthMapPool::Access::Write);
  urban_nav_core::forEach(near.size(), 1, [&](std::size_t i) {
    urban_nav_registration::DepthMap& depth = depths_->pool.at(near[i]);
    for (const MapPoint& point : points)
      if (const auto at = projections_[near[i]].project(point.p)) depth.add(*at, voxel_);
  });
  for (const MapPoint& point : points)
    if (point.normal.squaredNorm() > 0.5F) samples_.add(point);
}

void Colouriser::equalise() {
  const std::vector<MapPoint>& samples = samples_.items();
  std::vector<ColourObservation> observations;
  for (std::size_t view = 0; view < projections_.size(); ++view) {
    const auto picture = image(view);
    if (picture->bgr.empty()) continue;
    depths_->pool.hold({view}, DepthMapPool::Access::Read);
    const ViewProjection& projection = projections_[view];
    const urban_nav_registration::DepthMap& depth = depths_->pool.at(view);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto at = projection.project(samples[i].p);
      if (!at || !depth.isVisible(*at, projection.toCamera(samples[i]))) continue;
      const Colour colour = patchColour(*picture, *at, 2.0 * voxel_, projection.focal());
      if (isUsable(colour)) observations.push_back({view, i, colour});
    }
  }
  gains_ = estimateGains(views_.size(), samples.size(), observations);
}

std::shared_ptr<const Picture> Colouriser::image(std::size_t view) {
  if (const auto found = cache_.find(view); found != cache_.end()) {
    recent_.splice(recent_.begin(), recent_, found->second.second);
    return found->second.first;
  }
  if (cache_.size() >= cached_images_) {
    cache_.erase(recent_.back());
    recent_.pop_back();
  }
  auto picture = std::make_shared<const Picture>(load_(views_[view].image));
  const urban_nav_core::Pinhole& pinhole = views_[view].camera.pinhole;
  if (picture->width != pinhole.width || picture->height != pinhole.height) picture = std::make_shared<const Picture>();
  recent_.push_front(view);
  cache_[view] = {picture, recent_.begin()};
  return picture;
}

std::size_t Colouriser::colour(std::vector<MapPoint>& points) {
  std::vector<BestViews> best(points.size());
  for (const std::size_t view : viewsNear(points)) {
    const auto picture = image(view);
    if (picture->bgr.empty()) continue;
    depths_->pool.hold({view}, DepthMapPool::Access::Read);
    const ViewProjection& projection = projections_[view];
    const urban_nav_registration::DepthMap& depth = depths_->pool.at(view);
    urban_nav_core::forEach(points.size(), kPointGrain, [&](std::size_t i) {
      const auto at = projection.project(points[i].p);
      if (!at || !depth.isVisible(*at, projection.toCamera(points[i]))) return;
      PointView seen{viewWeight(points[i], *at, projection), patchColour(*picture, *at, voxel_, projection.focal())};
      for (std::size_t c = 0; c < 3; ++c) seen.colour[c] *= gains_[view][c];
      best[i].add(seen);
    });
  }
  std::size_t coloured = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (best[i].count == 0) continue;
    const auto channel = [&](std::size_t c) {
      return static_cast<std::uint8_t>(std::clamp(std::lround(best[i].weightedMedian(c)), 1L, 255L));
    };
    points[i].is_coloured = true;
    points[i].blue = channel(0);
    points[i].green = channel(1);
    points[i].red = channel(2);
    ++coloured;
  }
  return coloured;
}

}  // namespace laser_mapper
