// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/map_quality.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"

namespace laser_mapper {

using Eigen::Vector3d;

namespace {

constexpr double kLayerReach = 0.15;  // m along the normal: points this far from a place are shown with it
constexpr double kDegrees = 180.0 / M_PI;

std::vector<PlanePlace> findAllPlaces(const LaserMap& map) {
  std::vector<std::vector<PlanePlace>> by_tile(map.tileCount());
  const Parameters& parameters = map.parameters();
  map.forEachTileByPass([&](std::size_t index, const std::vector<PassCells>& passes) {
    by_tile[index] = findPlanePlaces(parameters.voxel, parameters.range_bias, passes);
  });
  std::vector<PlanePlace> all;
  for (std::vector<PlanePlace>& places : by_tile) std::move(places.begin(), places.end(), std::back_inserter(all));
  return all;
}

double medianValue(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

QualityFigures::Spread spreadOver(const std::vector<const PlanePlace*>& places, double PlanePlace::Pair::*pair_value,
                                  double PlanePlace::*place_mean, double PlanePlace::*place_sigma) {
  std::vector<double> pairs, means, sigmas;
  for (const PlanePlace* place : places) {
    for (const PlanePlace::Pair& pair : place->pairs) pairs.push_back(pair.*pair_value);
    means.push_back(place->*place_mean);
    sigmas.push_back(place->*place_sigma);
  }
  QualityFigures::Spread spread;
  if (pairs.empty()) return spread;
  for (const double value : pairs) spread.mean += value / static_cast<double>(pairs.size());
  const auto [least, largest] = std::minmax_element(pairs.begin(), pairs.end());
  const auto [least_mean, largest_mean] = std::minmax_element(means.begin(), means.end());
  spread.least = *least;
  spread.largest = *largest;
  spread.least_mean = *least_mean;
  spread.largest_mean = *largest_mean;
  spread.sigma = medianValue(sigmas);
  return spread;
}

QualityFigures figuresOver(const std::vector<PlanePlace>& places,
                           const std::function<bool(const PlanePlace&)>& wanted) {
  std::vector<const PlanePlace*> chosen;
  QualityFigures figures;
  for (const PlanePlace& place : places) {
    if (!wanted(place)) continue;
    chosen.push_back(&place);
    figures.patches += place.patches.size();
    figures.pairs += place.pairs.size();
  }
  figures.places = chosen.size();
  figures.angle = spreadOver(chosen, &PlanePlace::Pair::angle, &PlanePlace::angle, &PlanePlace::angle_sigma);
  figures.displacement =
      spreadOver(chosen, &PlanePlace::Pair::displacement, &PlanePlace::displacement, &PlanePlace::displacement_sigma);
  return figures;
}

QualityFigures::Spread joinSpreads(const QualityFigures::Spread& a, double a_share, const QualityFigures::Spread& b) {
  QualityFigures::Spread both;
  both.mean = a_share * a.mean + (1.0 - a_share) * b.mean;
  both.sigma = a_share * a.sigma + (1.0 - a_share) * b.sigma;
  both.least = std::min(a.least, b.least);
  both.largest = std::max(a.largest, b.largest);
  both.least_mean = std::min(a.least_mean, b.least_mean);
  both.largest_mean = std::max(a.largest_mean, b.largest_mean);
  return both;
}

}  // namespace

QualityFigures operator+(const QualityFigures& a, const QualityFigures& b) {
  if (a.pairs == 0) return b;
  if (b.pairs == 0) return a;
  const double share = static_cast<double>(a.pairs) / static_cast<double>(a.pairs + b.pairs);
  QualityFigures both;
  both.places = a.places + b.places;
  both.patches = a.patches + b.patches;
  both.pairs = a.pairs + b.pairs;
  both.angle = joinSpreads(a.angle, share, b.angle);
  both.displacement = joinSpreads(a.displacement, share, b.displacement);
  return both;
}

MapQuality::MapQuality(const LaserMap& map) : MapQuality(findAllPlaces(map), map.parameters().voxel) {}

MapQuality::MapQuality(std::vector<PlanePlace> places, double voxel)
    : radius_(kPlaceRadius * voxel), places_(std::move(places)) {
  for (std::size_t i = 0; i < places_.size(); ++i) blocks_[blockAt(places_[i].centre)].push_back(i);
}

QualityFigures MapQuality::walls() const {
  return figuresOver(places_, [](const PlanePlace& place) { return place.isWall(); });
}

QualityFigures MapQuality::ground() const {
  return figuresOver(places_, [](const PlanePlace& place) { return place.isGround(); });
}

MapQuality::Block MapQuality::blockAt(const Vector3d& p) const {
  const auto part = [this](double value) { return static_cast<int>(std::floor(value / radius_)); };
  return {part(p.x()), part(p.y()), part(p.z())};
}

std::optional<float> MapQuality::displacementAt(const Eigen::Vector3f& p) const {
  const auto [x, y, z] = blockAt(p.cast<double>());
  double nearest = radius_ * radius_;
  std::optional<float> displacement;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = blocks_.find({x + dx, y + dy, z + dz});
        if (found == blocks_.end()) continue;
        for (const std::size_t i : found->second) {
          const Vector3d d = p.cast<double>() - places_[i].centre;
          const double along = places_[i].normal.dot(d), aside = (d - along * places_[i].normal).squaredNorm();
          if (std::abs(along) > kLayerReach || aside > nearest) continue;
          nearest = aside;
          displacement = static_cast<float>(places_[i].displacement);
        }
      }
  return displacement;
}

std::string MapQuality::printCsv() const {
  std::string text =
      "x,y,z,nx,ny,nz,kind,patches,pairs,cells,angle_deg_mean,angle_deg_sigma,angle_deg_max,displacement_m_mean,"
      "displacement_m_sigma,displacement_m_max\n";
  for (const PlanePlace& place : places_) {
    std::size_t cells = 0;
    double angle = 0.0, displacement = 0.0;
    for (const PlanePatch& patch : place.patches) cells += patch.cells;
    for (const PlanePlace::Pair& pair : place.pairs) {
      angle = std::max(angle, pair.angle);
      displacement = std::max(displacement, pair.displacement);
    }
    for (const Vector3d& v : {place.centre, place.normal})
      for (int axis = 0; axis < 3; ++axis) text += urban_nav_core::printNumber(v(axis)) + ",";
    text += place.isWall() ? "wall," : place.isGround() ? "ground," : "slope,";
    for (const std::size_t count : {place.patches.size(), place.pairs.size(), cells})
      text += std::to_string(count) + ",";
    for (const double value : {kDegrees * place.angle, kDegrees * place.angle_sigma, kDegrees * angle,
                               place.displacement, place.displacement_sigma})
      text += urban_nav_core::printNumber(value) + ",";
    text += urban_nav_core::printNumber(displacement) + "\n";
  }
  return text;
}

}  // namespace laser_mapper
