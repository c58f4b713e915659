// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav {

/// What belongs to one session: one folder, or the bags of a recording in the order of time.
struct Session {
  std::vector<std::string> paths;
};

/// Each folder is a session; bags less than 5 s apart are one (a split recording). UserError where there is nothing
/// that is known.
std::vector<Session> findSessions(const std::vector<std::string>& inputs);

}  // namespace urban_nav
