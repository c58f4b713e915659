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

/// What a session store holds of one session, in figures.
struct StoredSession {
  urban_nav_store::Session session;
  std::int64_t nodes = 0;
  urban_nav_core::StampNs first = 0, last = 0;  ///< of the nodes
  double length_m = 0.0;                        ///< along the relaxed poses where there are some
  std::map<std::string, std::int64_t> status_counts;
  /// Edges from nodes of this session, by kind and verdict.
  std::map<std::string, std::map<std::string, std::int64_t>> edges;
  std::vector<urban_nav_input::StreamInfo>
      streams;                                 ///< what the stages saw, by the order of inputs; `type`: "n not used"
  std::map<std::string, std::int64_t> scans;   ///< kept, by laser
  std::map<std::string, std::int64_t> places;  ///< observations of places by the hash of the model of their words
  std::map<std::string, std::int64_t> keyframe_places;  ///< keyframes beside panoramas, by the hash of the model
  std::vector<std::string> frames;                      ///< sensors whose place on the robot is known
  std::string map;                                      ///< id of the session that gives its map the frame
  bool relaxed = false;
  bool resumable = false;        ///< holds the state of a run that was cut off
  bool next_bag = false;         ///< holds the state at the end of a bag, from which the next one goes on
  std::int64_t state_bytes = 0;  ///< room that these states take
};

struct StoreInfo {
  std::string path;
  std::int64_t bytes = 0;                               ///< with the log beside the file
  std::optional<urban_nav_store::ReleaseHead> release;  ///< nullopt: a session store
  std::vector<StoredSession> sessions;
  /// Sessions that accepted closures tie together, by place in `sessions`; one of its own for each that stands alone.
  std::vector<std::vector<std::size_t>> joined;
};

/// Reads the store whole; errors as urban_nav_store has them.
StoreInfo readStoreInfo(const std::string& path);

std::string toText(const StoreInfo& info);
Json toJson(const StoreInfo& info);

}  // namespace urban_nav
