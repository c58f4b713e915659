// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "map/bag_checkpoint.hpp"
#include "map/run_fingerprint.hpp"

namespace urban_nav {

/// Stores the progress of a run of `map` in session.db of its output folder, committed about once a second, and finds
/// there what an interrupted run has finished.
///
/// A session that an earlier run has finished is restored from the store, bit-exactly, if its fingerprint
/// (run_fingerprint.hpp) is the same; anything else is removed and made again, and the console reports the difference.
/// A run that ends leaves no states: the next one in its folder starts from the beginning.
///
/// If --store names a store to continue from, its sessions are in session.db from the start, and stay. One that is
/// mapped again is replaced; one whose recording the bags continue is continued after its last known bag
/// (bag_checkpoint.hpp). That checkpoint stays in the store for the session that ends last.
class RunCheckpoint {
 public:
  /// Sets id and `continued` of each session, and the name of continued ones. `sessions` must outlive the object.
  RunCheckpoint(const MapOptions& options, const StageList& stages, std::vector<MapSession>& sessions, std::string path,
                Console& console);

  /// Where an unfinished session continues: after `bags` of its bags.
  struct ResumePoint {
    BagCheckpoint checkpoint;
    std::size_t bags = 0;
  };
  const std::optional<ResumePoint>& resumePoint(std::size_t session) const { return plans_[session].resume_point; }
  /// Makes it a session of its own, if resuming has failed.
  void startNewSession(std::size_t session);

  /// Returns the states with which an earlier run finished the session (SessionPass::finished()); empty if it is not
  /// finished.
  std::vector<BagCheckpoint::StageState> finishedStates(std::size_t session);
  /// Starts writing a session from its beginning, or from its resume point. The other calls are about this session.
  void begin(std::size_t session);
  void resume(std::size_t session);
  /// Writes scans, in the frames of the lasers.
  void writeScans(const std::vector<urban_nav_input::LaserInput>& scans);
  /// Writes and commits the checkpoint at the end of a bag; replaces that of the bag before.
  void saveBagEnd(std::vector<BagCheckpoint::StageState> states, const urban_nav_input::BagEnd& end);
  bool isCommitDue() const;
  void commit();
  /// Marks the session as complete, with the states from which it can be restored. Commits.
  void finishSession(const std::vector<BagCheckpoint::StageState>& states);
  /// Ends a run whose files are written: removes all states that are no longer needed, and closes the store.
  void endRun();

  urban_nav_store::Store& store() { return *store_; }

 private:
  using Clock = std::chrono::steady_clock;
  using SessionId = urban_nav_store::SessionId;

  /// What is known of a session before it is read.
  struct SessionPlan {
    SessionId own_id;  ///< unless it continues another one
    RunFingerprint fingerprint;
    std::string name;
    std::vector<std::string> bags;  ///< their fingerprints
    std::optional<ResumePoint> resume_point;
  };
  /// Content of the store of an earlier run in the same folder.
  struct PruneResult {
    std::size_t finished = 0;  ///< sessions that are restored
    std::size_t begun = 0;     ///< sessions that are resumed after a bag
    bool interrupted = false;
    std::string difference;  ///< why sessions were removed, for the user
  };

  /// Matches sessions to those of --store.
  void findContinuedSessions(Console& console);
  /// Opens the store and prints how it is used.
  void open(Console& console);
  /// Removes sessions that this run can neither restore nor resume.
  PruneResult pruneSessions(bool in_place);
  void startNewStore();
  bool isFinished(std::size_t session);
  /// Returns the checkpoint of a stored session if the bags of this one follow it.
  std::optional<ResumePoint> readResumePoint(urban_nav_store::Store& store, const SessionId& id, std::size_t session);
  /// Returns the checkpoint if, besides, program, options and parameters are the same.
  std::optional<ResumePoint> findResumePoint(urban_nav_store::Store& store, const SessionId& id, std::size_t session);
  std::string configurationDifferences(urban_nav_store::Store& store, const SessionId& id, std::size_t session) const;
  void writeSession(std::size_t session);

  const MapOptions& options_;
  const std::string path_;
  std::vector<MapSession>& sessions_;
  std::vector<SessionPlan> plans_;  // one per session
  std::vector<std::string> keys_;   // of the stages; a state of the first one marks a session that can be restored
  std::optional<urban_nav_store::Store> store_;
  std::size_t current_ = 0;
  Clock::time_point committed_;
};

}  // namespace urban_nav
