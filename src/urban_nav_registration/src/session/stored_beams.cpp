// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/stored_beams.hpp"

#include <algorithm>
#include <limits>

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

}  // namespace

std::vector<LaserAt> storedBeamSources(Store& store, const SessionId& session) {
  std::vector<LaserAt> sources = storedLasers(store, session);
  for (const MountedLidar& lidar : mountedLidars(store, session))
    sources.push_back({lidar.role, lidar.T_base_lidar, 0, true});
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
  constexpr auto kEver = std::numeric_limits<StampNs>::max();
  return static_cast<std::int64_t>(
      TableStore<LidarSweep>(store_).keysBetween({session, laser, 0, {}}, -kEver, kEver).size());
}

void BeamReader::forEach(const SessionId& session, const std::string& laser, StampNs from, StampNs to,
                         const std::function<void(const Scan&)>& take) const {
  if (!isLidar(store_, session, laser)) return store_.scans().forEach(session, laser, from, to, take);
  const std::vector<StampNs> times = TableStore<LidarSweep>(store_).keysBetween({session, laser, 0, {}}, from, to);
  const std::size_t count = std::min(kMostSweeps, times.size());
  for (std::size_t i = 0; i < count; ++i) {
    const StampNs time = times[count == 1 ? 0 : i * (times.size() - 1) / (count - 1)];
    const auto sweep = TableStore<LidarSweep>(store_).get({session, laser, time, {}});
    if (!sweep) continue;
    for (const Scan& ring : sweep->rings()) take(ring);
  }
}

}  // namespace urban_nav_registration
