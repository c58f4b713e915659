// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "command_line/console.hpp"
#include "pipeline/bag_checkpoint.hpp"
#include "pipeline/run_fingerprint.hpp"
#include "stage/store_keys.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Keeps what a run of `map` makes in session.db of its folder, committed about once a second, and finds there what a run
/// that was cut off had finished.
///
/// A session that an earlier run had finished is taken from the store where inputs, options, parameters and program
/// (run_identity.hpp) are the same, with its own bytes; anything else is removed and made again, and the console says why. A run
/// that has come to its end leaves no states behind: the next one in its folder begins anew.
///
/// Where the request names a store to go on from, its sessions are there from the start, and stay. One that is mapped
/// again is replaced; one whose recording the bags go on with is gone on in, behind the last bag that is known (bag_state.hpp). That state stays in
/// the store for the session that ends last.
class StoreStage {
 public:
  /// Sessions that are gone on in get their names.
  StoreStage(const MapRequest& request, std::vector<Session>& sessions, const std::string& path, Console& console);

  /// Where a session that is not finished goes on, and how many of its bags are behind that.
  struct Behind {
    BagState state;
    std::size_t bags = 0;
  };
  const std::optional<Behind>& behind(std::size_t session) const { return behind_[session]; }
  /// It cannot be gone on there: the session is one of its own.
  void giveUp(std::size_t session, Session& inputs);

  /// To be called for each session in their order. The finished run where there is one; else the session is begun.
  std::optional<VoRun> begin(std::size_t session, const SourceInfo& info);
  /// Instead, with the run as it was behind(): the session is begun, and has what it had there.
  void goOn(std::size_t session, const SourceInfo& info, const VoRun& run);
  /// Scans of the session that was begun, in the lasers' frames.
  void keep(const SourceInfo& info, const std::vector<LaserInput>& scans);
  /// A view of the session that was begun.
  void keep(const urban_nav_store::StoredKeyframe& view);
  /// The views of it that were kept before it was begun or gone on in.
  std::vector<urban_nav_core::StampNs> viewsKept();
  /// A bag of the session has come to its end. Commits; the state of the bag before goes.
  void keepBag(const VoStage& stage, const BagEnd& end);
  /// What is new in the run of the session that was begun; commits when a second has gone by.
  void keepUp(const VoRun& run);
  /// The run is complete.
  void finish(const VoRun& run);
  /// So is everything else that `map` writes.
  void end();

  urban_nav_store::Store& store() { return *store_; }
  /// Is a session of this run one of the store that was gone on from? Its closures are there still.
  bool isContinued(std::size_t session) const { return continued_[session]; }
  /// Of the sessions of this run, in their order.
  const std::vector<urban_nav_store::SessionId>& ids() const { return ids_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool isFinished(std::size_t session);
  /// Opens the store, and leaves in it the sessions that this run can go on behind.
  void open(Console& console);
  /// What is in the store of an earlier run in the same folder.
  struct Found {
    std::size_t finished = 0;  ///< sessions to go on behind
    std::size_t begun = 0;     ///< and to go on in, behind a bag
    bool cut_off = false;
    std::string other;  ///< what differs, for people
  };
  Found sift(bool goes_on_here);
  /// The state of a stored session that the bags of this one follow.
  std::optional<Behind> follow(urban_nav_store::Store& store, const urban_nav_store::SessionId& id,
                               std::size_t session);
  /// What of program, options and parameters is not as it was then; empty: nothing.
  std::string otherThan(urban_nav_store::Store& store, const urban_nav_store::SessionId& id, std::size_t session) const;
  /// follow() where nothing is other.
  std::optional<Behind> look(urban_nav_store::Store& store, const urban_nav_store::SessionId& id, std::size_t session);
  /// Bags that go on with a recording of the store that the request names: their sessions are those.
  void findContinued(std::vector<Session>& sessions, Console& console);
  void put(std::size_t session, const SourceInfo& info);
  void beginAnew();
  void add(const VoRun& run);

  const MapRequest& request_;
  const std::string path_;
  std::vector<urban_nav_store::SessionId> ids_, own_ids_;  // own: were none gone on in
  std::vector<RunIdentity> identities_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> bags_;   // of each session
  std::vector<urban_nav_core::StampNs> begins_;  // likewise
  std::vector<bool> continued_;                  // likewise: of the store that the request names
  std::vector<std::optional<Behind>> behind_;    // likewise
  std::optional<urban_nav_store::Store> store_;
  std::size_t session_ = 0;           // at work
  std::size_t rows_ = 0, nodes_ = 0;  // of it, written
  Clock::time_point committed_;
};

}  // namespace urban_nav
