// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/session_namer.hpp"

#include <algorithm>
#include <memory>
#include <optional>

namespace urban_nav_live {

using urban_nav_core::StampNs;

SessionNamer::Named SessionNamer::begin(const std::string& recording, StampNs start, const std::vector<Session>& stored,
                                        const EndsAt& endsAt) {
  const auto resume = [&](const std::string& name, const auto& fits) -> std::optional<Session> {
    const auto found = std::find_if(stored.begin(), stored.end(), [&](const Session& session) {
      return !isReserved(session.id) && session.robot == robot_ && session.recording == name && fits(session);
    });
    if (found == stored.end()) return std::nullopt;
    Session session = *found;
    session.complete = false;
    return session;
  };
  const auto named = [this](const Session& session, bool resumed, bool continues) {
    reserve(session.id);
    return Named{session, resumed, continues};
  };
  const auto begins_there = [start](const Session& session) { return session.start == start; };
  if (const auto session = resume(recording, begins_there)) return named(*session, true, false);
  const auto ends_there = [&](const Session& session) { return endsAt && endsAt(session, start); };
  if (const auto session = resume(recording, ends_there)) return named(*session, true, true);

  Session session;
  session.name = recording.empty() ? urban_nav_core::printStamp(start) : recording;
  session.robot = robot_;
  session.start = start;
  for (int round = 1;; ++round) {
    session.recording = round == 1 ? recording : recording + " (" + std::to_string(round) + ")";
    session.id = urban_nav_store::makeSessionId({robot_, session.recording, start, ""});
    if (isReserved(session.id)) continue;
    if (const auto again = resume(session.recording, begins_there)) return named(*again, true, false);
    return named(session, false, false);
  }
}

SessionNamer::Named SessionNamer::follow(const urban_nav_core::OdometrySession& announced,
                                         const std::vector<Session>& stored) {
  const auto found =
      std::find_if(stored.begin(), stored.end(), [&](const Session& session) { return session.id == announced.id; });
  Named named;
  named.session = {announced.id, announced.name, announced.robot, announced.recording, announced.start, false};
  named.resumed = found != stored.end();
  reserve(announced.id);
  return named;
}

urban_nav_core::OdometrySessionPtr toOdometrySession(const urban_nav_store::Session& session) {
  return std::make_shared<const urban_nav_core::OdometrySession>(
      urban_nav_core::OdometrySession{session.id, session.name, session.robot, session.recording, session.start});
}

}  // namespace urban_nav_live
