// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav_live {

/// Names the live sessions of a robot and decides which stored session is resumed. Odometry applies this rule, and all
/// other stages follow it (OdometrySession); without announced sessions, each stage applies the rule itself. Stores of
/// one robot merge only if the ids agree. Not thread-safe.
///
/// A stored session with the same robot and recording is resumed if it begins at the same time (the recording is
/// replayed) or if its newest pose is at the start (odometry continues). Otherwise a new session begins. A recording
/// replayed within one process becomes "name (2)", "name (3)", ...
class SessionNamer {
 public:
  using Session = urban_nav_store::Session;
  using SessionId = urban_nav_store::SessionId;
  /// Returns true if the newest pose of a stored session is at the given stamp.
  using EndsAt = std::function<bool(const Session&, urban_nav_core::StampNs)>;

  struct Named {
    Session session;
    bool resumed = false;    ///< it is a stored session
    bool continues = false;  ///< resumed at its newest pose, not from its start
  };

  explicit SessionNamer(std::string robot) : robot_(std::move(robot)) {}

  /// Returns the session that begins at `start`, marked incomplete. `recording`: its name, may be empty. `stored`:
  /// sessions in the store from earlier processes.
  Named begin(const std::string& recording, urban_nav_core::StampNs start, const std::vector<Session>& stored = {},
              const EndsAt& endsAt = {});
  /// Returns the session announced by odometry, resumed if it is one of the stored sessions.
  Named follow(const urban_nav_core::OdometrySession& announced, const std::vector<Session>& stored = {});
  /// Reserves an id that new sessions must not have: in use, or of a session from another source.
  void reserve(const SessionId& id) { used_.insert(id); }
  bool isReserved(const SessionId& id) const { return used_.count(id) > 0; }
  /// Releases all ids.
  void clear() { used_.clear(); }

 private:
  const std::string robot_;
  std::set<SessionId> used_;
};

/// Returns the announcement of a session named by odometry.
urban_nav_core::OdometrySessionPtr toOdometrySession(const urban_nav_store::Session& session);

}  // namespace urban_nav_live
