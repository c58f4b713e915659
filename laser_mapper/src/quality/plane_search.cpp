// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_search.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include "laser_mapper/quality/map_quality.hpp"
#include "laser_mapper/revisits.hpp"
#include "mounted_laser.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"

namespace laser_mapper {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr double kPassReach = 15.0;              // m: more distant passes have few planes in common
constexpr StampNs kThinnedSpacing = 30'000'000;  // at walking speed, scans 30 ms apart still fill cubes of 5 cm
constexpr StampNs kDelayMargin = 1'000'000'000;  // more than the delay of any laser

/// Temporary store, removed by the destructor.
class ScratchStore {
 public:
  explicit ScratchStore(const std::string& path) : path_(path) {
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
  }
  ~ScratchStore() {
    store_.reset();
    try {
      urban_nav_store::removeStore(path_);
    } catch (const urban_nav_core::Error&) {  // a remaining temporary file is harmless
    }
  }
  ScratchStore(const ScratchStore&) = delete;
  ScratchStore& operator=(const ScratchStore&) = delete;

  Store& operator*() { return *store_; }

 private:
  const std::string path_;
  std::unique_ptr<Store> store_;
};

/// Copies lasers with their adopted calibration, and subsampled scans of the given chunks.
void copyScans(Store& from, Store& to, const SessionId& session, const std::set<StampNs>& chunks) {
  to.sessions().put(urban_nav_store::Session{session, "", "", "", 0, true});
  urban_nav_registration::writeCalibration(to, session, urban_nav_registration::readCalibration(from, session));
  for (const MountedLaser& laser : statedLasers(from, session)) {
    to.sessions().put(session, urban_nav_store::Extrinsic{laser.frame, laser.T_base_laser});
    StampNs last = 0;
    for (const StampNs begin : chunks)
      from.scans().forEach(session, laser.frame, begin - kDelayMargin, begin + kChunkNs + kDelayMargin,
                           [&](const urban_nav_core::Scan& scan) {
                             if (scan.stamp - last < kThinnedSpacing) return;
                             last = scan.stamp;
                             to.scans().put(session, laser.frame, scan);
                           });
  }
  to.commit();
}

}  // namespace

std::vector<PlaneConstraint> searchPlaneConstraints(const Parameters& parameters, Store& store,
                                                    const std::vector<MappedSession>& sessions,
                                                    const std::vector<const OdometryDrift*>& drifts,
                                                    const std::string& scratch_path) {
  std::vector<const Trajectory*> T_map_base;
  for (const MappedSession& session : sessions) T_map_base.push_back(session.T_map_base);
  const std::vector<std::set<StampNs>> chunks = findRevisitedChunks(T_map_base, kPassReach);
  if (std::all_of(chunks.begin(), chunks.end(), [](const auto& each) { return each.empty(); })) return {};
  ScratchStore scratch(scratch_path);
  std::vector<MappedSession> mapped;
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    copyScans(store, *scratch, sessions[s].id, chunks[s]);
    mapped.push_back({sessions[s].id, sessions[s].T_map_base, nullptr});
  }
  Parameters for_planes = parameters;
  for_planes.ghosts = for_planes.stereo = false;
  LaserMap map(for_planes, *scratch, mapped);
  map.render();
  return findPlaneConstraints(MapQuality(map).places(), T_map_base, parameters.range_bias, drifts);
}

}  // namespace laser_mapper
