// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo_recorder.hpp"

#include <chrono>

#include "pose_graph/level.hpp"
#include "topics/lo/lo_run_state.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

constexpr const char* kLoStateName = "laser odometry of a session";
constexpr std::uint32_t kLoStateVersion = 2;
constexpr double kSampleStep = 10.0;            // m between samples of the surface
constexpr double kSampleReach = 30.0;           // m, of a sample
constexpr std::size_t kSurfacePoints = 60'000;  // for the picture

}  // namespace

LoRecorder::LoRecorder(const laser_odometry::Parameters& parameters, const urban_nav_input::SourceInfo& info,
                       LoRun& run)
    : parameters_(parameters), run_(run) {
  run_.input = info.name;
  run_.source = OdometrySource::Laser;
  if (info.has_images) run_.camera = info.camera;
  run_.T_base_camera = info.T_base_camera;
}

LoRecorder::LoRecorder(const laser_odometry::Parameters& parameters, const urban_nav_input::SourceInfo& info,
                       LoRun& run, std::string_view state)
    : LoRecorder(parameters, info, run) {
  const std::string where = std::string("state of ") + kLoStateName;
  urban_nav_core::Archive archive(urban_nav_core::unseal(kLoStateName, kLoStateVersion, state), where);
  std::string packed_run, odometry;
  archive(packed_run, odometry, T_base_lidar_, sampled_at_, others_, untimed_, inputs_);
  archive.finish();
  std::optional<LoRun> found = unpackLoRun(packed_run);
  if (!found) throw urban_nav_core::DataError(where, "is damaged: its sweeps cannot be read", "");
  found->input = run.input;
  found->camera = run.camera;
  found->T_base_camera = run.T_base_camera;
  run_ = std::move(*found);
  if (!odometry.empty()) odometry_.emplace(parameters, T_base_lidar_, odometry, scanner());
}

laser_odometry::Scanner LoRecorder::scanner() const {
  return run_.is_planar ? laser_odometry::Scanner::Planar : laser_odometry::Scanner::Spatial;
}

void LoRecorder::process(const urban_nav_input::SweepInput& input) {
  inputs_.insert(inputs_.end(), input.inputs.begin(), input.inputs.end());
  if (run_.role.empty()) run_.role = input.role;
  if (input.role != run_.role) {
    ++others_;
    return;
  }
  if (!odometry_) {
    T_base_lidar_ = input.T_base_lidar;
    run_.T_base_lidar = T_base_lidar_;
    run_.is_planar = input.is_planar;
    odometry_.emplace(parameters_, T_base_lidar_, scanner());
  }
  if (input.sweep.times == urban_nav_core::Sweep::Times::Unknown) ++untimed_;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const laser_odometry::LaserPose pose = odometry_->process(input.sweep, inputs_);
  inputs_.clear();
  run_.motion = odometry_->motion();
  record(pose, std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
  if (pose.accepted) sampleSurface();
}

void LoRecorder::record(const laser_odometry::LaserPose& pose, double ms) {
  OdometryFrame row;
  row.frame = static_cast<std::int64_t>(run_.frames.size());
  row.stamp = pose.stamp;
  row.accepted = pose.accepted;
  row.status = pose.status;
  row.T_odom_base = pose.T_odom_base;
  run_.figures.push_back({pose.statistics, pose.free_directions, ms});
  if (pose.accepted) {
    run_.settled.push_back({row.frame, pose.stamp, {pose.T_odom_base, pose.covariance}, pose.step, pose.status});
  }
  run_.frames.push_back(std::move(row));
}

void LoRecorder::sampleSurface() {
  const urban_nav_core::Vector3d here = run_.settled.back().T_odom_base.pose.t();
  if (run_.settled.size() < 3 || (sampled_at_ && (here - *sampled_at_).norm() < kSampleStep)) return;
  sampled_at_ = here;
  for (const laser_odometry::MapPoint& point : odometry_->localMap())
    if ((point.p_odom.cast<double>() - here).norm() < kSampleReach) run_.surface.push_back(point.p_odom);
  if (run_.surface.size() <= kSurfacePoints) return;
  std::size_t kept = 0;  // keeps every second point, so that early and late parts are equally dense
  for (std::size_t i = 0; i < run_.surface.size(); i += 2) run_.surface[kept++] = run_.surface[i];
  run_.surface.resize(kept);
}

std::string LoRecorder::state() const {
  urban_nav_core::Archive archive;
  std::string run = packLoRun(run_), odometry = odometry_ ? odometry_->state() : "";
  urban_nav_core::Pose place = T_base_lidar_;
  std::optional<urban_nav_core::Vector3d> sampled_at = sampled_at_;
  std::int64_t others = others_, untimed = untimed_;
  std::vector<urban_nav_core::MotionInput> inputs = inputs_;
  archive(run, odometry, place, sampled_at, others, untimed, inputs);
  return urban_nav_core::seal(kLoStateName, kLoStateVersion, archive.take());
}

void LoRecorder::finish(const PassEnd& end) {
  run_.faults.insert(run_.faults.begin(), end.faults.begin(), end.faults.end());
  run_.faults_total += static_cast<std::int64_t>(end.faults.size());
  if (others_ > 0) {
    run_.faults.push_back(run_.input + ": " + std::to_string(others_) + " sweeps of other LiDARs than " + run_.role +
                          " are not used for odometry");
    ++run_.faults_total;
  }
  if (untimed_ > 0) {
    run_.faults.push_back(run_.input + ": " + std::to_string(untimed_) + " of " + std::to_string(run_.frames.size()) +
                          " sweeps are not deskewed: without times of their " +
                          (run_.is_planar ? "beams (time_increment is zero)" : "points (input.points_time)"));
    ++run_.faults_total;
  }
  std::vector<urban_nav_core::StampNs> stamps;
  for (const SmoothedFrame& settled : run_.settled) stamps.push_back(settled.stamp);
  run_.forces = pose_graph::forcesAt(stamps, end.forces);
}

}  // namespace urban_nav
