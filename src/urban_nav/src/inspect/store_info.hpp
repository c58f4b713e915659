// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "urban_nav_input/examination/input_info.hpp"
#include "urban_nav_store/release.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Contents of a session in a session store, in figures.
struct StoredSession {
  urban_nav_store::Session session;
  std::int64_t nodes = 0;
  urban_nav_core::StampNs first = 0, last = 0;  ///< of the nodes
  double length_m = 0.0;                        ///< along the relaxed poses if there are any
  std::map<std::string, std::int64_t> status_counts;
  /// Edges from nodes of this session, by kind and verdict.
  std::map<std::string, std::map<std::string, std::int64_t>> edges;
  std::vector<urban_nav_input::StreamInfo> streams;  ///< inputs of the stages; `type`: "n not used"
  std::map<std::string, std::int64_t> scans;         ///< stored, by laser
  std::map<std::string, std::int64_t> places;        ///< observations of places by the hash of the model of their words
  std::map<std::string, std::int64_t>
      keyframe_places;              ///< keyframes stored in addition to panoramas, by the hash of the model
  std::vector<std::string> frames;  ///< sensors with extrinsics
  std::string map;                  ///< id of the session whose first pose is the origin of its map
  bool relaxed = false;
  bool resumable = false;        ///< has the state of an interrupted run
  bool next_bag = false;         ///< has the state at the end of a bag, from which the next bag continues
  std::int64_t state_bytes = 0;  ///< size of these states
};

struct StoreInfo {
  std::string path;
  std::int64_t bytes = 0;                               ///< including the write-ahead log
  std::optional<urban_nav_store::ReleaseHead> release;  ///< nullopt: a session store
  std::vector<StoredSession> sessions;
  /// Groups of sessions joined by accepted closures, as indices in `sessions`; a separate session is a group of one.
  std::vector<std::vector<std::size_t>> joined;
};

/// Reads the complete store. Throws the errors of urban_nav_store.
StoreInfo readStoreInfo(const std::string& path);

std::string toText(const StoreInfo& info);
Json toJson(const StoreInfo& info);

}  // namespace urban_nav
