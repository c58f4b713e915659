// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tile_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "laser_mapper/sensors.hpp"
#include "local_planes.hpp"
#include "urban_nav_core/laser/reflectance.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

constexpr float kFarRange = 20.0F;  // m: BeamNoise::far_factor applies beyond
constexpr float kFewestPixels = 2.0F;
constexpr float kStereoPatches = 4.0F;  // independent measurements in a neighbourhood: matching windows overlap
constexpr int kCoarsestStereoLevel = 2;
constexpr float kLeastStereoCosine = 0.3F;  // smaller at grazing views, where matching windows contain edges
constexpr float kReach = 3.0F;              // standard deviations of a range: nearer voxels belong to a plane

float rangeSigma(const BeamNoise& noise, float range) {
  return noise.range_sigma * (range > kFarRange ? noise.far_factor : 1.0F);
}

/// Returns the share of the distance to a plane that noise explains, 0...1.
float noiseShare(const LocalPlane& plane, float sigma) {
  return std::clamp(2.0F - plane.thickness * plane.thickness / (sigma * sigma), 0.0F, 1.0F);
}

float measurementVariance(const BeamNoise& model, const MergedCell& cell, const LocalPlane* plane, float share,
                          float cosine) {
  const float sigma = rangeSigma(model, cell.range);
  float beams = cell.count;
  if (plane != nullptr) beams += share * std::max(0.0F, plane->weight - beams);
  const float sine = std::sqrt(std::max(0.0F, 1.0F - cosine * cosine));
  const float noise = sigma * cosine, bias = model.range_bias * cosine;
  const float pointing = 0.25F * model.beam_width * cell.range * sine;
  float variance = (noise * noise + pointing * pointing) / beams + bias * bias;
  if (plane != nullptr) variance += (1.0F - share) * plane->thickness * plane->thickness / cell.count;
  return variance;
}

/// Intermediate state of a voxel that becomes a point.
struct SurfacePoint {
  MapPoint point;
  bool belongs_to_another = false;
};

/// Space measured by lasers, in cubes of four voxel edges.
class SeenByLasers {
 public:
  SeenByLasers(const std::vector<MergedCell>& cells, const std::vector<MergedCell>& margin) : table_(cells.size() / 8) {
    for (const std::vector<MergedCell>* part : {&cells, &margin})
      for (const MergedCell& cell : *part) table_.insert(key(cell.cell));
  }
  /// Returns whether the cube of a cell or an adjacent one was measured.
  bool near(const Cell& cell) const {
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (table_.find(urban_nav_registration::keyBeside(key(cell), {dx, dy, dz})) !=
              urban_nav_registration::CellTable::kNone)
            return true;
    return false;
  }

 private:
  static std::uint64_t key(const Cell& cell) {
    return urban_nav_registration::toKey({cell.x >> 2, cell.y >> 2, cell.z >> 2});
  }
  urban_nav_registration::CellTable table_;
};

}  // namespace

std::vector<MapPoint> makeSurface(const Parameters& parameters, const Tile& tile, const std::vector<MergedCell>& cells,
                                  const std::vector<MergedCell>& margin, const PoseSigma& pose_sigma) {
  LocalPlanes planes(parameters.voxel, tile, cells, margin);
  std::vector<SurfacePoint> made(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const MergedCell& cell = cells[i];
    const BeamNoise noise = beamNoise(parameters, cell.laser);
    SurfacePoint& surface = made[i];
    const std::optional<LocalPlane> plane = planes.around(cell);
    Vector3f local = planes.position(cell);
    Vector3f along = cell.to_laser.norm() > 0.1F ? Vector3f(cell.to_laser.normalized()) : Vector3f(Vector3f::UnitZ());
    float share = 0.0F, cosine = 1.0F;
    if (plane) {
      Vector3f normal = plane->normal;
      if (normal.dot(along) < 0.0F) normal = -normal;
      cosine = std::max(0.05F, normal.dot(along));
      const float sigma = rangeSigma(noise, cell.range);
      share = noiseShare(*plane, sigma);
      local -= share * normal.dot(local - plane->centre) * normal;
      surface.point.normal = along = normal;
      surface.belongs_to_another = share > 0.0F && planes.belongsToAnother(cell, local, *plane, kReach * sigma);
    }
    const Vector3d p = planes.inMap(local);
    const double pose = pose_sigma(cell, p, along.cast<double>());
    const float variance = measurementVariance(noise, cell, plane ? &*plane : nullptr, share, cosine);
    MapPoint& point = surface.point;
    point.p = p.cast<float>();
    point.sigma = std::sqrt(variance + static_cast<float>(pose * pose));
    point.raw_intensity = static_cast<std::uint8_t>(std::lround(std::clamp(cell.intensity, 0.0F, 255.0F)));
    point.intensity = static_cast<std::uint8_t>(
        std::lround(urban_nav_core::normaliseReflectance(cell.intensity, cell.range, plane ? cosine : 1.0F)));
    point.red = point.green = point.blue = point.intensity;
    point.laser = cell.laser;
    point.pass = cell.pass;
    point.count = static_cast<std::uint16_t>(std::min(cell.count, 65535.0F));
    point.range = cell.range;
    point.stamp = cell.stamp;
  }
  std::vector<MapPoint> points;
  points.reserve(made.size());
  for (const SurfacePoint& surface : made)
    if (!surface.belongs_to_another) points.push_back(surface.point);
  return points;
}

std::vector<MapPoint> makeStereoSurface(const Parameters& parameters, const Tile& tile,
                                        const std::vector<MergedCell>& stereo, const std::vector<MergedCell>& cells,
                                        const std::vector<MergedCell>& margin, const PoseSigma& pose_sigma) {
  std::vector<MapPoint> points;
  if (stereo.empty()) return points;
  const SeenByLasers seen(cells, margin);
  LocalPlanes planes(parameters.voxel, tile, stereo, {});
  for (const MergedCell& cell : stereo) {
    if (cell.count < kFewestPixels || seen.near(cell.cell) || !(cell.to_laser.norm() > 0.1F)) continue;
    const std::optional<LocalPlane> plane = planes.around(cell);
    if (!plane || plane->level > kCoarsestStereoLevel) continue;
    Vector3f local = planes.position(cell), normal = plane->normal;
    const Vector3f along = cell.to_laser.normalized();
    if (normal.dot(along) < 0.0F) normal = -normal;
    const float cosine = std::max(kLeastStereoCosine, normal.dot(along)), sigma = cell.range * cosine;
    const float share = noiseShare(*plane, sigma);
    local -= share * normal.dot(local - plane->centre) * normal;
    const Vector3d p = planes.inMap(local);
    const double pose = pose_sigma(cell, p, normal.cast<double>());
    MapPoint point;
    point.p = p.cast<float>();
    point.normal = normal;
    const float independent = 1.0F + share * (kStereoPatches - 1.0F);
    point.sigma = std::sqrt(sigma * sigma / independent + static_cast<float>(pose * pose));
    point.intensity = static_cast<std::uint8_t>(std::lround(std::clamp(cell.intensity, 0.0F, 255.0F)));
    point.raw_intensity = point.red = point.green = point.blue = point.intensity;
    point.laser = cell.laser == kStereo ? kStereoSensor : cell.laser;
    point.pass = cell.pass;
    point.count = static_cast<std::uint16_t>(std::min(cell.count, 65535.0F));
    point.stamp = cell.stamp;
    points.push_back(point);
  }
  return points;
}

}  // namespace laser_mapper
