// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/chunk_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "laser_mapper/mixed_pixels.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"

namespace laser_mapper {

using urban_nav_core::BeamRenderer;
using urban_nav_core::LaserPoint;
using urban_nav_core::Pose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_registration::CellTable;
using urban_nav_registration::toKey;

namespace {

/// Sums over the beams that ended in a cube.
struct CellSums {
  Cell cell;
  Eigen::Vector3f offset = Eigen::Vector3f::Zero(), to_laser = Eigen::Vector3f::Zero();
  float range = 0.0F, intensity = 0.0F;
  StampNs time = 0;
  int count = 0, laser = 0, laser_votes = 0;
};

/// Cubes of a chunk, in the order in which beams came to them.
class ChunkGrid {
 public:
  ChunkGrid(double voxel, const Eigen::Vector3d& centre, StampNs begin)
      : per_m_(static_cast<float>(1.0 / voxel)), begin_(begin), table_(1 << 14) {
    const Eigen::Vector3d cells = (centre / voxel).array().round();
    origin_cell_ = {static_cast<int>(cells.x()), static_cast<int>(cells.y()), static_cast<int>(cells.z())};
    origin_ = voxel * cells;
  }

  /// Of the frame that points are rendered in: it has the axes of the map.
  Pose framePose() const { return Pose(Eigen::Quaterniond::Identity(), origin_).inverse(); }

  /// Returns false for a point beyond the grid.
  bool add(const LaserPoint& point, int laser) {
    const Eigen::Vector3f scaled = point.p * per_m_;
    const Eigen::Vector3f corner = scaled.array().floor();
    const Cell cell{static_cast<int>(corner.x()) + origin_cell_.x, static_cast<int>(corner.y()) + origin_cell_.y,
                    static_cast<int>(corner.z()) + origin_cell_.z};
    if (std::abs(cell.x) > urban_nav_registration::kFarthestCell ||
        std::abs(cell.y) > urban_nav_registration::kFarthestCell || std::abs(cell.z) > kMaxHeightCell)
      return false;
    const std::uint32_t number = table_.insert(toKey(cell));
    if (number == sums_.size()) {
      sums_.emplace_back();
      sums_.back().cell = cell;
    }
    CellSums& sums = sums_[number];
    sums.offset += scaled - corner;
    sums.to_laser += (point.origin - point.p) / std::max(point.range, 1e-6F);
    sums.range += point.range;
    sums.intensity += point.intensity;
    sums.time += point.stamp - begin_;
    ++sums.count;
    if (sums.laser_votes == 0) sums.laser = laser;
    sums.laser_votes += sums.laser == laser ? 1 : -1;
    return true;
  }

  /// Appends the cubes to those of their tiles.
  void appendTo(std::map<Tile, std::vector<MapCell>>& parts) const {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // no two cubes have one key
    order.reserve(sums_.size());
    for (std::uint32_t i = 0; i < sums_.size(); ++i) order.emplace_back(orderKey(sums_[i].cell), i);
    std::sort(order.begin(), order.end());
    std::vector<MapCell>* part = nullptr;
    Tile tile;
    for (const auto& [key, i] : order) {
      const Tile own = tileAt(sums_[i].cell);
      if (part == nullptr || !(own == tile)) part = &parts[own];
      tile = own;
      part->push_back(mean(sums_[i]));
    }
  }

 private:
  /// Ascends with the tile, then z, y and x within it.
  static std::uint64_t orderKey(const Cell& cell) {
    const Tile tile = tileAt(cell);
    const auto part = [](int value, int bias) { return static_cast<std::uint64_t>(value + bias); };
    constexpr int kFarthestTile = (urban_nav_registration::kFarthestCell + kTileCells) / kTileCells;
    return part(tile.y, kFarthestTile) << 45U | part(tile.x, kFarthestTile) << 32U |
           part(cell.z, kMaxHeightCell + 1) << 16U | part(cell.y - tile.y * kTileCells, 0) << 8U |
           part(cell.x - tile.x * kTileCells, 0);
  }

  static MapCell mean(const CellSums& sums) {
    const float share = 1.0F / static_cast<float>(sums.count);
    MapCell cell;
    cell.cell = sums.cell;
    cell.count = static_cast<std::uint16_t>(std::min(sums.count, 65535));
    cell.laser = static_cast<std::uint8_t>(sums.laser);
    cell.intensity = static_cast<std::uint8_t>(std::lround(std::clamp(share * sums.intensity, 0.0F, 255.0F)));
    cell.offset = share * sums.offset;
    cell.to_laser = share * sums.to_laser;
    cell.range = share * sums.range;
    cell.time_us = static_cast<std::int32_t>(sums.time / sums.count / 1000);
    return cell;
  }

  const float per_m_;
  const StampNs begin_;
  Cell origin_cell_;
  Eigen::Vector3d origin_;
  CellTable table_;
  std::vector<CellSums> sums_;
};

Eigen::Vector3d chunkCentre(const Trajectory& T_map_base, StampNs begin) {
  if (T_map_base.empty()) return Eigen::Vector3d::Zero();
  return T_map_base[T_map_base.nearest(begin + kChunkNs / 2)].pose.t();
}

/// Removes beams that are not to be rendered.
Scan usableBeams(const Scan& scan, const Parameters& parameters, BeamCounts& counts) {
  std::vector<std::uint8_t> mixed(scan.beams.size(), 0);
  if (parameters.mixed_pixels) {
    MixedPixelModel model;
    model.range_sigma = static_cast<float>(parameters.range_sigma);
    mixed = findMixedPixels(scan, model);
  }
  Scan usable;
  usable.stamp = scan.stamp;
  usable.beams.reserve(scan.beams.size());
  counts.all += scan.beams.size();
  for (std::size_t i = 0; i < scan.beams.size(); ++i) {
    const double range = static_cast<double>(scan.beams[i].range);
    if (mixed[i] != 0) ++counts.mixed;
    else if (range < parameters.min_range || range > parameters.max_range) ++counts.out_of_range;
    else usable.beams.push_back(scan.beams[i]);
  }
  return usable;
}

/// Adds the points of a pair of images as beams from the camera, whose range is their standard deviation.
void addStereo(const Parameters& parameters, const Trajectory& T_map_base, const StereoFrame& frame, ChunkGrid& grid) {
  const auto T_map_then = T_map_base.at(frame.stamp, std::llround(parameters.max_gap * 1e9));
  if (!T_map_then) return;
  const Pose T_frame_base = grid.framePose() * *T_map_then;
  const Eigen::Vector3d camera = T_frame_base * frame.camera_base;
  for (const StereoFrame::Point& point : frame.points) {
    if (!(static_cast<double>(point.sigma) <= parameters.stereo_sigma)) continue;
    const Eigen::Vector3d p = T_frame_base * point.p_base.cast<double>();
    LaserPoint made;
    made.stamp = frame.stamp;
    made.p = p.cast<float>();
    made.origin = (p + static_cast<double>(point.sigma) * (camera - p).normalized()).cast<float>();
    made.range = point.sigma;
    made.intensity = point.grey;
    grid.add(made, kStereo);
  }
}

}  // namespace

StampNs chunkBegin(StampNs stamp) {
  const StampNs rest = stamp % kChunkNs;
  return stamp - (rest < 0 ? rest + kChunkNs : rest);
}

BeamCounts operator+(const BeamCounts& a, const BeamCounts& b) {
  return {a.all + b.all, a.mixed + b.mixed, a.without_pose + b.without_pose, a.out_of_range + b.out_of_range};
}

RenderedChunk renderChunk(const Parameters& parameters, const Trajectory& T_map_base,
                          const std::vector<LaserInput>& lasers, const std::vector<StereoFrame>& stereo,
                          StampNs begin) {
  RenderedChunk chunk;
  ChunkGrid grid(parameters.voxel, chunkCentre(T_map_base, begin), begin), stereo_grid = grid;
  const StampNs max_gap = std::llround(parameters.max_gap * 1e9);
  std::vector<LaserPoint> points;
  for (const LaserInput& laser : lasers) {
    BeamRenderer renderer(T_map_base, laser.T_base_laser, grid.framePose(), max_gap);
    for (const Scan& scan : laser.scans) {
      points.clear();
      chunk.beams.without_pose += renderer.render(usableBeams(scan, parameters, chunk.beams), points);
      for (const LaserPoint& point : points)
        if (!grid.add(point, laser.laser)) ++chunk.beams.out_of_range;
    }
  }
  if (parameters.stereo)
    for (const StereoFrame& frame : stereo) addStereo(parameters, T_map_base, frame, stereo_grid);
  std::map<Tile, std::vector<MapCell>> parts;
  grid.appendTo(parts);
  stereo_grid.appendTo(parts);
  for (auto& [tile, cells] : parts) chunk.parts.push_back({tile, std::move(cells)});
  return chunk;
}

}  // namespace laser_mapper
