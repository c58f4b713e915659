// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "map/previous_sessions.hpp"
#include "urban_nav_store/graph_store.hpp"

namespace urban_nav {

/// Returns the stored pose nearest to a time in the form of parseTimeQuery(). `what`: its name in errors. Throws
/// UserError if no session has a pose within 1 s of it.
urban_nav_store::NodeRef findMoment(const PreviousSessions& sessions, const std::string& text, const std::string& what);

/// Returns the index in `sessions` of the session whose name or id begins with `text`. Throws UserError listing the
/// sessions.
std::size_t findSession(const PreviousSessions& sessions, const std::string& text);

/// Returns the text for a stored pose: "day1 +3.5 s".
std::string momentText(const PreviousSessions& sessions, const urban_nav_store::NodeRef& ref);

}  // namespace urban_nav
