// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/sensor_pass.hpp"

#include <algorithm>

#include "map/state_bytes.hpp"
#include "topics/lasers/map_colour.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::TableStore;

namespace {

constexpr const char* kSensorPassName = "sweeps of a session";
constexpr std::uint32_t kSensorPassVersion = 2;
constexpr double kSweepDistance = 0.25, kSweepAngle = 0.1;  // m, rad
constexpr double kPanoramaDistance = 0.5 * kViewDistance, kPanoramaAngle = 0.5 * kViewAngle;
constexpr const char* kPanorama = "panorama";
constexpr StampNs kLongestRest = 10'000'000'000;

std::string frameName(const urban_nav_input::SourceInfo& info, const std::string& role) {
  for (const urban_nav_input::InputStream& input : info.inputs)
    if (input.role == role) return input.frame;
  return role;
}

}  // namespace

SensorPass::SensorPass(MapContext& context, const Stage::SessionStart& start)
    : store_(*context.store), session_(context.sessions[start.session]), panoramas_(context, start) {
  if (start.checkpoint) unpackState(kSensorPassName, kSensorPassVersion, *start.checkpoint, state_);
}

SensorPass::LastStored* SensorPass::findLast(const std::string& role) {
  const auto found =
      std::find_if(state_.last.begin(), state_.last.end(), [&](const LastStored& each) { return each.role == role; });
  return found == state_.last.end() ? nullptr : &*found;
}

bool SensorPass::takes(const std::string& role, StampNs stamp, double distance, double angle) {
  const std::vector<OdometryFrame>& frames = session_.odometry->frames;
  const std::optional<Pose> now = frames.empty() ? std::nullopt : std::optional(frames.back().T_odom_base);
  LastStored* last = findLast(role);
  if (last == nullptr) {
    state_.last.push_back({role, stamp, now});
    return true;
  }
  const bool has_moved = now.has_value() != last->T_odom_base.has_value() ||
                         (now && (distanceBetween(*now, *last->T_odom_base) >= distance ||
                                  angleBetween(*now, *last->T_odom_base) >= angle));
  if (!has_moved && stamp - last->stamp < kLongestRest) return false;
  *last = {role, stamp, now};
  return true;
}

void SensorPass::process(const urban_nav_ros::Panorama& panorama) {
  if (takes(kPanorama, panorama.stamp, kPanoramaDistance, kPanoramaAngle)) panoramas_.process(panorama);
}

void SensorPass::process(const urban_nav_input::SweepInput& input) {
  if (input.is_planar) return;  // stored as scans
  if (findLast(input.role) == nullptr)
    TableStore<MountedLidar>(store_).put(
        {session_.id, input.role, frameName(session_.info, input.role), input.T_base_lidar});
  if (takes(input.role, input.sweep.reference, kSweepDistance, kSweepAngle))
    TableStore<LidarSweep>(store_).put({session_.id, input.role, input.sweep.reference, LidarSweep::pack(input.sweep)});
}

std::string SensorPass::checkpoint() { return packState(kSensorPassName, kSensorPassVersion, state_); }

}  // namespace urban_nav
