// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_registration/session/session_lasers.hpp"
#include "urban_nav_store/scan_store.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_registration {

/// Returns the sensors of a session that measure ranges by laser: storedLasers(), and the 3D LiDARs whose sweeps are in
/// the store, with their role as `frame`.
std::vector<LaserAt> storedBeamSources(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// The beams of these sensors, as scans: those of planar lasers, and a scan for each ring of a sweep. Of the sweeps of
/// an interval at most 24 are read, evenly spread, enough for a local cloud. Not thread-safe.
class BeamReader final : public urban_nav_store::ScanStore {
 public:
  /// `store` must outlive it.
  explicit BeamReader(urban_nav_store::Store& store) : store_(store) {}

  /// Throws UserError: the store is only read.
  void put(const urban_nav_store::SessionId& session, const std::string& laser,
           const urban_nav_core::Scan& scan) override;
  std::vector<std::string> lasers(const urban_nav_store::SessionId& session) const override;
  std::int64_t count(const urban_nav_store::SessionId& session, const std::string& laser) const override;
  void forEach(const urban_nav_store::SessionId& session, const std::string& laser, urban_nav_core::StampNs from,
               urban_nav_core::StampNs to, const std::function<void(const urban_nav_core::Scan&)>& take) const override;

 private:
  urban_nav_store::Store& store_;
};

}  // namespace urban_nav_registration
