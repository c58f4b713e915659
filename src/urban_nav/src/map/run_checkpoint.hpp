// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "map/bag_checkpoint.hpp"
#include "map/run_fingerprint.hpp"

namespace urban_nav {

/// Stores the progress of a run of `map` in session.db of its output folder, committed about once a second, and reads
/// the progress of an interrupted run from there.
///
/// A session that an earlier run has finished is restored from the store, bit-exactly, if its fingerprint
/// (run_fingerprint.hpp) is the same; other sessions are removed and recomputed, and the difference is reported on the
/// console. A completed run leaves no states: the next one in its folder starts from the beginning.
///
/// With --store, the sessions of that store are in session.db from the start. A session that is mapped again is
/// replaced; one whose recording continues in the bags is continued after its last known bag (bag_checkpoint.hpp). The
/// checkpoint of the session that begins last is kept in the store if its last bag is a part of a split recording.
class RunCheckpoint {
 public:
  /// Sets id and `continued` of each session, and the name of continued ones. `sessions` must outlive the object.
  RunCheckpoint(const MapOptions& options, const StageList& stages, std::vector<MapSession>& sessions, std::string path,
                Console& console);

  /// Point from which an unfinished session continues: after `bags` of its bags.
  struct ResumePoint {
    BagCheckpoint checkpoint;
    std::size_t bags = 0;
  };
  const std::optional<ResumePoint>& resumePoint(std::size_t session) const { return plans_[session].resume_point; }
  /// Makes it a new session, if resuming has failed.
  void startNewSession(std::size_t session);

  /// Returns the states of the session from an earlier run that finished it (SessionPass::finished()); empty if
  /// unfinished.
  std::vector<BagCheckpoint::StageState> finishedStates(std::size_t session);
  /// Starts writing a session from its beginning, or from its resume point. Other calls refer to this session.
  void begin(std::size_t session);
  void resume(std::size_t session);
  /// Writes scans, in the frames of the lasers.
  void writeScans(const std::vector<urban_nav_input::LaserInput>& scans);
  /// Writes and commits the checkpoint at the end of a bag; replaces that of the previous bag.
  void saveBagEnd(std::vector<BagCheckpoint::StageState> states, const urban_nav_input::BagEnd& end);
  bool isCommitDue() const;
  void commit();
  /// Marks the session as complete, with the states from which it can be restored. Commits.
  void finishSession(const std::vector<BagCheckpoint::StageState>& states);
  /// Ends a run after its files are written: removes all unneeded states, then the marks of an unfinished run, and
  /// closes the store.
  void endRun();

  urban_nav_store::Store& store() { return *store_; }

 private:
  using Clock = std::chrono::steady_clock;
  using SessionId = urban_nav_store::SessionId;

  /// Identity and resume point of a session, determined before reading.
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
    std::string difference;  ///< reason why sessions were removed, for the user
  };

  /// Returns whether the bags of a session follow those of a stored one of which no checkpoint is kept.
  bool followsWhole(urban_nav_store::Store& store, const SessionId& id, std::size_t session) const;
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
  /// Like readResumePoint(), but only if program, options and parameters are the same.
  std::optional<ResumePoint> findResumePoint(urban_nav_store::Store& store, const SessionId& id, std::size_t session);
  std::string configurationDifferences(urban_nav_store::Store& store, const SessionId& id, std::size_t session) const;
  void writeSession(std::size_t session);
  /// Removes the checkpoint of a session after which no bag can come, except which bags it covers.
  void dropCheckpoint(std::size_t session);

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
