// SPDX-License-Identifier: BSD-3-Clause
#include "edits/moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/time_query.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_store::NodeRef;

namespace {

constexpr double kNearest = 1.0;  // s

bool isNamed(const PreviousSessions& sessions, std::size_t session, const std::string& text) {
  return sessions.names[session].rfind(text, 0) == 0 || sessions.ids[session].rfind(text, 0) == 0 ||
         sessions.runs[session].input.rfind(text, 0) == 0;
}

std::string listSessions(const PreviousSessions& sessions) {
  std::string text;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) {
    const std::vector<SmoothedFrame>& settled = sessions.runs[s].settled;
    text += (s > 0 ? ", " : "") + sessions.names[s] + " (" + urban_nav_core::printStamp(settled.front().stamp) +
            " to " + urban_nav_core::printStamp(settled.back().stamp) + ")";
  }
  return text;
}

}  // namespace

NodeRef findMoment(const PreviousSessions& sessions, const std::string& text, const std::string& what) {
  const TimeQuery query = parseTimeQuery(text, what);
  const auto exact = query.since_begin ? std::optional<StampNs>() : urban_nav_core::parseStamp(text);
  NodeRef nearest;
  double least = std::numeric_limits<double>::infinity();
  bool any = false;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) {
    if (!query.session.empty() && !isNamed(sessions, s, query.session)) continue;
    any = true;
    const std::vector<SmoothedFrame>& settled = sessions.runs[s].settled;
    for (const SmoothedFrame& frame : settled) {
      const double apart =
          query.since_begin
              ? std::abs(urban_nav_core::secondsBetween(settled.front().stamp, frame.stamp) - query.seconds)
              : std::abs(urban_nav_core::secondsBetween(exact.value_or(query.stamp), frame.stamp));
      if (apart >= least) continue;
      least = apart;
      nearest = {sessions.ids[s], frame.stamp};
    }
  }
  if (!any) throw UserError(what, "no session \"" + query.session + "\"", listSessions(sessions));
  if (!(least <= kNearest))
    throw UserError(what, "no pose within 1 s of " + text, "times of the sessions " + listSessions(sessions));
  return nearest;
}

std::size_t findSession(const PreviousSessions& sessions, const std::string& text) {
  for (std::size_t s = 0; s < sessions.ids.size(); ++s)
    if (sessions.names[s] == text || sessions.ids[s] == text) return s;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s)
    if (!text.empty() && isNamed(sessions, s, text)) return s;
  throw UserError("SESSION", "no session \"" + text + "\"", listSessions(sessions));
}

std::string momentText(const PreviousSessions& sessions, const NodeRef& ref) {
  for (std::size_t s = 0; s < sessions.ids.size(); ++s)
    if (sessions.ids[s] == ref.session)
      return sessions.names[s] + " +" +
             urban_nav_core::formatNumber(
                 urban_nav_core::secondsBetween(sessions.runs[s].settled.front().stamp, ref.stamp), 6) +
             " s";
  return ref.session + " at " + urban_nav_core::printStamp(ref.stamp) + " s";
}

}  // namespace urban_nav
