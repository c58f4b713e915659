// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav {

/// A session in the stores of a fleet.
struct FleetSession {
  urban_nav_store::Session session;
  std::string store;       ///< relative to the folder
  std::string map;         ///< id of the session whose first pose is the origin of its map
  std::size_t in_map = 0;  ///< number of sessions in its map in that store, itself included
  urban_nav_core::StampNs first = 0, last = 0;
  double distance_m = 0.0;
  double good_share = 1.0;   ///< of poses whose odometry is OK
  double sigma_m = 0.0;      ///< largest standard deviation of a position in its map
  std::size_t accepted = 0;  ///< closures with other sessions
  std::size_t candidates = 0;
  double disagreement_m = 0.0;        ///< median residual of accepted closures with other sessions
  std::string day;                    ///< of its start, UTC: "2008-11-03"
  std::vector<Eigen::Vector2d> path;  ///< positions in its map, m, about 1 m apart
  std::string camera;                 ///< its calibration (calibrationFingerprint); empty: unknown
};

/// Sessions and releases in the stores below a folder.
struct Fleet {
  std::string folder;
  std::vector<FleetSession> sessions;  ///< of session stores, in the order of their start; each once
  std::vector<std::string> releases;   ///< files, relative to the folder
  std::vector<std::pair<std::string, std::string>> unreadable;  ///< files with the reason
  /// Recordings that the workflow could not map: the folder of each, relative to `folder`, with the reason.
  std::vector<std::pair<std::string, std::string>> failed;
  std::vector<std::string> drifts;  ///< sentences on calibrations that differ between sessions of one robot
};

/// Reads all stores below a folder, in the order of their names. A session of several stores is taken from the
/// one with the largest map. Unreadable stores are listed, and so are the folders whose summary.json states that a
/// recording failed; stores in these are left out. Throws UserError if `folder` is not a folder.
Fleet readFleet(const std::string& folder);

Page fleetPage(const Fleet& fleet);
Json toJson(const Fleet& fleet);

}  // namespace urban_nav
