// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/stored_beams.hpp"

#include <algorithm>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace urban_nav_registration {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::SessionId;
using urban_nav_store::Store;
using urban_nav_store::TableStore;

namespace {

constexpr std::size_t kMostSweeps = 24;  // of an interval: one in a metre of the usual path of a local cloud

std::vector<MountedLidar> mountedLidars(Store& store, const SessionId& session) {
  std::vector<MountedLidar> lidars;
  TableStore<MountedLidar>(store).forEach(session, [&](const MountedLidar& row) { lidars.push_back(row); });
  return lidars;
}

bool isLidar(Store& store, const SessionId& session, const std::string& role) {
  const std::vector<MountedLidar> lidars = mountedLidars(store, session);
  return std::any_of(lidars.begin(), lidars.end(), [&](const MountedLidar& lidar) { return lidar.role == role; });
}

/// Returns the reference times of the sweeps of an interval.
std::vector<StampNs> sweepTimes(Store& store, const SessionId& session, const std::string& role, StampNs from,
                                StampNs to) {
  std::vector<StampNs> times;
  TableStore<LidarSweep>(store).forEachBetween({session, role, 0, {}}, from, to,
                                               [&](const LidarSweep& row) { times.push_back(row.reference); });
  return times;
}

}  // namespace

std::vector<LaserAt> storedBeamSources(Store& store, const SessionId& session) {
  std::vector<LaserAt> sources = storedLasers(store, session);
  for (const MountedLidar& lidar : mountedLidars(store, session))
    sources.push_back({lidar.role, lidar.T_base_lidar, 0});
  return sources;
}

void BeamReader::put(const SessionId&, const std::string&, const Scan&) {
  throw urban_nav_core::UserError(store_.path(), "is only read", "");
}

std::vector<std::string> BeamReader::lasers(const SessionId& session) const {
  std::vector<std::string> names = store_.scans().lasers(session);
  for (const MountedLidar& lidar : mountedLidars(store_, session)) names.push_back(lidar.role);
  return names;
}

std::int64_t BeamReader::count(const SessionId& session, const std::string& laser) const {
  if (!isLidar(store_, session, laser)) return store_.scans().count(session, laser);
  std::int64_t sweeps = 0;
  TableStore<LidarSweep>(store_).forEach(session, [&](const LidarSweep& row) { sweeps += row.role == laser ? 1 : 0; });
  return sweeps;
}

void BeamReader::forEach(const SessionId& session, const std::string& laser, StampNs from, StampNs to,
                         const std::function<void(const Scan&)>& take) const {
  if (!isLidar(store_, session, laser)) return store_.scans().forEach(session, laser, from, to, take);
  const std::vector<StampNs> times = sweepTimes(store_, session, laser, from, to);
  const std::size_t count = std::min(kMostSweeps, times.size());
  for (std::size_t i = 0; i < count; ++i) {
    const StampNs time = times[count == 1 ? 0 : i * (times.size() - 1) / (count - 1)];
    const auto sweep = TableStore<LidarSweep>(store_).get({session, laser, time, {}});
    if (!sweep) continue;
    for (const Scan& ring : sweep->rings()) take(ring);
  }
}

}  // namespace urban_nav_registration
