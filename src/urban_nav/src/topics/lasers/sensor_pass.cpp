// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/sensor_pass.hpp"

#include <algorithm>

#include "map/state_bytes.hpp"
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
constexpr std::uint32_t kSensorPassVersion = 1;
constexpr double kSweepDistance = 0.25, kSweepAngle = 0.1;  // m, rad
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

SensorPass::StoredSweep& SensorPass::lastPassFor(const urban_nav_input::SweepInput& input) {
  const auto found = std::find_if(state_.last.begin(), state_.last.end(),
                                  [&](const StoredSweep& each) { return each.role == input.role; });
  if (found != state_.last.end()) return *found;
  TableStore<MountedLidar>(store_).put(
      {session_.id, input.role, frameName(session_.info, input.role), input.T_base_lidar});
  state_.last.push_back({input.role, 0, std::nullopt});
  return state_.last.back();
}

void SensorPass::process(const urban_nav_input::SweepInput& input) {
  const bool is_first = std::none_of(state_.last.begin(), state_.last.end(),
                                     [&](const StoredSweep& each) { return each.role == input.role; });
  StoredSweep& last = lastPassFor(input);
  const std::vector<OdometryFrame>& frames = session_.odometry->frames;
  const std::optional<Pose> now = frames.empty() ? std::nullopt : std::optional(frames.back().T_odom_base);
  const bool has_moved = now.has_value() != last.T_odom_base.has_value() ||
                         (now && (distanceBetween(*now, *last.T_odom_base) >= kSweepDistance ||
                                  angleBetween(*now, *last.T_odom_base) >= kSweepAngle));
  if (!is_first && !has_moved && input.sweep.reference - last.stamp < kLongestRest) return;
  last.stamp = input.sweep.reference;
  last.T_odom_base = now;
  TableStore<LidarSweep>(store_).put({session_.id, input.role, input.sweep.reference, LidarSweep::pack(input.sweep)});
}

std::string SensorPass::checkpoint() { return packState(kSensorPassName, kSensorPassVersion, state_); }

}  // namespace urban_nav
