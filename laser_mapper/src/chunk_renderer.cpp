// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/chunk_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "chunk_grid.hpp"
#include "laser_mapper/mixed_pixels.hpp"
#include "laser_mapper/sensors.hpp"
#include "lidar/sweep_view.hpp"
#include "stereo/depth_fusion.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"

namespace laser_mapper {

using urban_nav_core::BeamRenderer;
using urban_nav_core::LaserPoint;
using urban_nav_core::Pose;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr std::size_t kMostViews = 24;  // depth images compared with a point
constexpr float kWeightSigma = 0.01F;   // m: standard deviation of a stereo point with weight 1
constexpr int kFewestThrough = 2;       // sweeps required to see through a moved object

Eigen::Vector3d chunkCentre(const Trajectory& T_map_base, StampNs begin) {
  if (T_map_base.empty()) return Eigen::Vector3d::Zero();
  return T_map_base[T_map_base.nearest(begin + kChunkNs / 2)].pose.t();
}

/// Removes beams that must not be rendered.
Scan usableBeams(const Scan& scan, std::uint8_t sensor, const Parameters& parameters, BeamCounts& counts) {
  std::vector<std::uint8_t> mixed(scan.beams.size(), 0);
  if (parameters.mixed_pixels) {
    MixedPixelModel model;
    model.range_sigma = beamNoise(parameters, sensor).range_sigma;
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

/// Returns a stereo measurement as a beam from the camera whose range is its standard deviation.
LaserPoint stereoPoint(StampNs stamp, const Eigen::Vector3d& p, const Eigen::Vector3d& camera, float sigma,
                       float grey) {
  LaserPoint point;
  point.stamp = stamp;
  point.p = p.cast<float>();
  point.origin = (p + static_cast<double>(sigma) * (camera - p).normalized()).cast<float>();
  point.range = sigma;
  point.intensity = grey;
  return point;
}

void addStereo(const Parameters& parameters, const Trajectory& T_map_base, const StereoFrame& frame, ChunkGrid& grid) {
  const auto T_map_then = T_map_base.at(frame.stamp, std::llround(parameters.max_gap * 1e9));
  if (!T_map_then) return;
  const Pose T_frame_base = grid.framePose() * *T_map_then;
  const Eigen::Vector3d camera = T_frame_base * frame.camera_base;
  for (const StereoFrame::Point& point : frame.points) {
    if (!(static_cast<double>(point.sigma) <= parameters.stereo_sigma)) continue;
    const Eigen::Vector3d p = T_frame_base * point.p_base.cast<double>();
    grid.add(stereoPoint(frame.stamp, p, camera, point.sigma, point.grey), kStereo);
  }
}

/// Returns at most kMostViews views, evenly subsampled.
std::vector<PosedDepth> chooseViews(const std::vector<PosedDepth>& views) {
  const std::size_t step = (views.size() + kMostViews - 1) / kMostViews;
  std::vector<PosedDepth> chosen;
  for (std::size_t i = 0; i < views.size(); i += std::max<std::size_t>(step, 1)) chosen.push_back(views[i]);
  return chosen;
}

/// Adds points on which the depth images of a chunk and those around it agree.
void addViews(const Parameters& parameters, const Trajectory& T_map_base,
              const std::vector<std::shared_ptr<const DepthFrame>>& views, StampNs begin, ChunkGrid& grid) {
  std::vector<PosedDepth> posed;
  for (const std::shared_ptr<const DepthFrame>& view : views)
    if (const auto T_map_then = T_map_base.at(view->stamp, std::llround(parameters.max_gap * 1e9)))
      posed.push_back({view.get(), grid.framePose() * *T_map_then * view->T_base_camera});
  const std::vector<PosedDepth> others = chooseViews(posed);
  FusionRule rule;
  rule.sigma_limit = static_cast<float>(parameters.stereo_sigma);
  rule.farthest = static_cast<float>(parameters.max_range);
  for (const PosedDepth& own : posed) {
    if (own.frame->stamp < begin || own.frame->stamp >= begin + kChunkNs) continue;
    const Eigen::Vector3d camera = own.T_frame_camera.t();
    for (const FusedPoint& point : fuseDepth(own, others, rule))
      grid.add(stereoPoint(own.frame->stamp, point.p.cast<double>(), camera, point.sigma, point.grey),
               own.frame->sensor, kWeightSigma * kWeightSigma / (point.sigma * point.sigma), point.views);
  }
}

void addLasers(const Parameters& parameters, const Trajectory& T_map_base, const std::vector<LaserInput>& lasers,
               ChunkGrid& grid, BeamCounts& counts) {
  std::vector<LaserPoint> points;
  for (const LaserInput& laser : lasers) {
    const auto sensor = static_cast<std::uint8_t>(laser.laser);
    BeamRenderer renderer(T_map_base, laser.T_base_laser, grid.framePose(), std::llround(parameters.max_gap * 1e9));
    for (const Scan& scan : laser.scans) {
      points.clear();
      counts.without_pose += renderer.render(usableBeams(scan, sensor, parameters, counts), points);
      for (const LaserPoint& point : points)
        if (!grid.add(point, sensor)) ++counts.out_of_range;
    }
  }
}

void addLidars(const Parameters& parameters, const Trajectory& T_map_base, const std::vector<LidarInput>& lidars,
               ChunkGrid& grid, BeamCounts& counts) {
  for (const LidarInput& lidar : lidars)
    for (const auto& sweep : lidar.sweeps)
      addLasers(parameters, T_map_base, {{lidar.T_base_lidar, lidar.sensor, sweep->rings()}}, grid, counts);
}

/// Marks moving objects in 3D LiDAR data: voxels that more of the sweeps around them see through than see occupied.
void markMoving(const Parameters& parameters, const Trajectory& T_map_base, const std::vector<LidarInput>& lidars,
                ChunkGrid& grid) {
  std::vector<SweepView> views;
  const StampNs max_gap = std::llround(parameters.max_gap * 1e9);
  for (const LidarInput& lidar : lidars)
    for (const auto& sweep : lidar.evidence)
      views.emplace_back(sweep->rings(), T_map_base, lidar.T_base_lidar, grid.framePose(), max_gap);
  if (views.empty()) return;
  grid.markGhosts(isLidar, [&](const Eigen::Vector3d& p) {
    int through = 0, hits = 0;
    for (const SweepView& view : views) {
      const Sight sight = view.classify(p);
      through += sight == Sight::Through ? 1 : 0;
      hits += sight == Sight::Hit ? 1 : 0;
    }
    return through >= kFewestThrough && through > hits;
  });
}

}  // namespace

StampNs chunkBegin(StampNs stamp) {
  const StampNs rest = stamp % kChunkNs;
  return stamp - (rest < 0 ? rest + kChunkNs : rest);
}

BeamCounts operator+(const BeamCounts& a, const BeamCounts& b) {
  return {a.all + b.all, a.mixed + b.mixed, a.without_pose + b.without_pose, a.out_of_range + b.out_of_range};
}

RenderedChunk renderChunk(const Parameters& parameters, const Trajectory& T_map_base, const ChunkInput& input,
                          StampNs begin) {
  RenderedChunk chunk;
  ChunkGrid grid(parameters.voxel, chunkCentre(T_map_base, begin), begin), stereo_grid = grid;
  addLasers(parameters, T_map_base, input.lasers, grid, chunk.beams);
  addLidars(parameters, T_map_base, input.lidars, grid, chunk.beams);
  if (parameters.ghosts) markMoving(parameters, T_map_base, input.lidars, grid);
  if (parameters.stereo)
    for (const StereoFrame& frame : input.stereo) addStereo(parameters, T_map_base, frame, stereo_grid);
  addViews(parameters, T_map_base, input.views, begin, stereo_grid);
  std::map<Tile, std::vector<MapCell>> parts;
  grid.appendTo(parts);
  stereo_grid.appendTo(parts);
  for (auto& [tile, cells] : parts) chunk.parts.push_back({tile, std::move(cells)});
  return chunk;
}

}  // namespace laser_mapper
