// SPDX-License-Identifier: BSD-3-Clause
#include "ghosts/chunk_beams.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::Beam;
using urban_nav_core::Scan;

namespace {

constexpr double kNearBeam = 0.1;     // m: distance of beams to a point that are evaluated
constexpr float kDepthMargin = 0.3F;  // m: more than errors of poses between passes and the beam width
constexpr float kLeastViewRange = 0.5F, kMostViewRange = 20.0F;  // m
constexpr float kBeamSpacing = 0.014F;                           // rad: beams 0.5 deg apart, with a margin
constexpr int kFewestBeams = 4;
constexpr std::size_t kSweepStep = 4, kStretch = 24;

}  // namespace

ChunkBeams::ChunkBeams(const urban_nav_core::Trajectory& T_map_base, const std::vector<LaserInput>& lasers,
                       urban_nav_core::StampNs max_gap) {
  std::vector<std::pair<float, float>> beams;
  for (const LaserInput& laser : lasers) {
    lasers_.emplace_back();
    for (const Scan& scan : laser.scans) {
      if (scan.beams.empty()) continue;
      const auto T_map_base_then = T_map_base.at(scan.beams[scan.beams.size() / 2].stamp, max_gap);
      if (!T_map_base_then) continue;
      const urban_nav_core::Pose T_laser_map = (*T_map_base_then * laser.T_base_laser).inverse();
      beams.clear();
      for (const Beam& beam : scan.beams)
        beams.emplace_back(std::atan2(beam.direction.y(), beam.direction.x()), beam.range);
      std::sort(beams.begin(), beams.end());
      Sweep sweep;
      sweep.R_laser_map = T_laser_map.q().toRotationMatrix();
      sweep.t_laser_map = T_laser_map.t();
      sweep.first = static_cast<std::uint32_t>(angles_.size());
      for (const auto& [angle, range] : beams) {
        angles_.push_back(angle);
        ranges_.push_back(range);
      }
      sweep.last = static_cast<std::uint32_t>(angles_.size());
      lasers_.back().sweeps.push_back(sweep);
      lasers_.back().planes.push_back({sweep.R_laser_map.row(2).transpose(), sweep.t_laser_map.z()});
    }
    divide(lasers_.back());
  }
}

void ChunkBeams::divide(Laser& laser) {
  const std::vector<Sweep>& sweeps = laser.sweeps;
  for (std::size_t first = 0; first + 1 < sweeps.size(); first += kStretch) {
    Stretch stretch;
    stretch.first = first;
    stretch.last = std::min(first + kStretch + 1, sweeps.size());  // the next one begins with the last sweep
    const std::size_t middle = (stretch.first + stretch.last) / 2;
    stretch.middle = laser.planes[middle];
    for (std::size_t i = stretch.first; i < stretch.last; ++i) {
      const Vector3d origin = -(sweeps[i].R_laser_map.transpose() * sweeps[i].t_laser_map);
      const double turn = (laser.planes[i].normal - stretch.middle.normal).norm();
      stretch.reach = std::max(stretch.reach, std::abs(stretch.middle.height(origin)) + turn * kMostViewRange);
    }
    laser.stretches.push_back(stretch);
  }
}

std::size_t ChunkBeams::bytes() const {
  std::size_t all = 8 * angles_.size();
  for (const Laser& laser : lasers_) all += (sizeof(Sweep) + sizeof(SweepPlane)) * laser.sweeps.size();
  return all;
}

void ChunkBeams::lookIn(const Sweep& sweep, const Vector3d& p, Found& found) const {
  const Vector3d q = sweep.R_laser_map * p + sweep.t_laser_map;
  const auto range = static_cast<float>(std::hypot(q.x(), q.y()));
  if (range < kLeastViewRange || range > kMostViewRange) return;
  const auto angle = static_cast<float>(std::atan2(q.y(), q.x()));
  const float half = static_cast<float>(kNearBeam) / range + kBeamSpacing;
  const auto begin = angles_.begin() + sweep.first, end = angles_.begin() + sweep.last;
  const auto low = std::lower_bound(begin, end, angle - half);
  const auto at = std::lower_bound(low, end, angle);
  const auto high = std::upper_bound(at, end, angle + half);
  // Unknown if beams on either side of the point have no echo.
  if (at == low || at == high || angle - *(at - 1) > kBeamSpacing || *at - angle > kBeamSpacing) return;
  for (auto beam = low; beam != high; ++beam) {
    const float excess = ranges_[static_cast<std::size_t>(beam - angles_.begin())] - range;
    found.least_excess = std::min(found.least_excess, excess);
    found.hit = found.hit || std::abs(excess) < kDepthMargin;
    ++found.beams;
  }
}

void ChunkBeams::lookAlong(const Laser& laser, const Stretch& stretch, const Vector3d& p, Found& found) const {
  if (std::abs(stretch.middle.height(p)) > stretch.reach + kNearBeam) return;
  const std::vector<Sweep>& sweeps = laser.sweeps;
  const std::vector<SweepPlane>& planes = laser.planes;
  double before = 0.0;
  for (std::size_t i = stretch.first; i < stretch.last; i += kSweepStep) {
    const double height = planes[i].height(p);
    if (std::abs(height) < kNearBeam) {
      lookIn(sweeps[i], p, found);
    } else if (i > stretch.first && std::abs(before) >= kNearBeam && (before < 0.0) != (height < 0.0)) {
      for (std::size_t j = i - kSweepStep + 1; j < i; ++j)
        if (std::abs(planes[j].height(p)) < kNearBeam || (planes[j - 1].height(p) < 0.0) != (planes[j].height(p) < 0.0))
          lookIn(sweeps[j], p, found);
    }
    before = height;
  }
}

Sight ChunkBeams::look(const Vector3d& p) const {
  Found found;
  for (const Laser& laser : lasers_)
    for (const Stretch& stretch : laser.stretches) lookAlong(laser, stretch, p, found);
  if (found.beams < kFewestBeams) return Sight::None;
  if (found.least_excess > kDepthMargin) return Sight::Through;
  return found.hit ? Sight::Hit : Sight::None;
}

}  // namespace laser_mapper
