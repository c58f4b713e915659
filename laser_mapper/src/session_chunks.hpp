// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "chunk_store.hpp"
#include "evidence_reader.hpp"

namespace laser_mapper {

/// Returns the scans of a chunk, with the delays of their lasers removed.
std::vector<LaserInput> readLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                                   const std::vector<MountedLaser>& lasers, urban_nav_core::StampNs begin);

/// Updates the chunks of one session for its trajectory. Not thread-safe.
class SessionChunks {
 public:
  /// Returns the number of chunks that a trajectory covers.
  static std::size_t count(const urban_nav_core::Trajectory& T_map_base);

  SessionChunks(const Parameters& parameters, urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                const urban_nav_core::Trajectory& T_map_base);

  /// Renders chunks that are missing or have moved, removes those outside the trajectory, and commits. `progress`:
  /// called with the number of chunks done.
  void update(const std::function<void(std::size_t)>& progress);

  std::size_t chunks() const { return chunks_; }
  std::size_t rendered() const { return rendered_; }
  const BeamCounts& beams() const { return beams_; }
  const std::set<Tile>& tiles() const { return tiles_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Task {
    urban_nav_core::StampNs begin = 0;
    ChunkInput input;
    std::string settings;
    BeamCounts beams;
    std::vector<PackedPart> parts;
  };
  using Stored = std::map<urban_nav_core::StampNs, urban_nav_store::MapChunk>;

  void renderTasks(std::vector<Task>& tasks, const Stored& stored);
  bool isCurrent(const Stored& stored, const Task& task) const;
  void readEvidence(Task& task);
  void readStereo(Task& task) const;
  void readScans(Task& task);
  void checkContinuity(std::size_t laser, const urban_nav_core::Scan& scan);
  void reportGaps();

  const Parameters& parameters_;
  urban_nav_store::Store& store_;
  const urban_nav_store::SessionId session_;
  const urban_nav_core::Trajectory& T_map_base_;
  const urban_nav_core::StampNs max_gap_;
  std::vector<MountedLaser> lasers_;
  ChunkStore chunk_store_;
  EvidenceReader evidence_;
  const std::string settings_;

  std::size_t chunks_ = 0, rendered_ = 0;
  BeamCounts beams_;
  std::set<Tile> tiles_;
  std::vector<std::string> warnings_;
  std::vector<urban_nav_core::StampNs> last_scan_;  ///< of each laser in this update; 0: none
  std::vector<double> silent_;                      ///< s, of each laser: sum of its gaps
};

}  // namespace laser_mapper
