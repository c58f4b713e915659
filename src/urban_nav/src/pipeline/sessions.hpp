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

/// What sessions are called in closures.csv: the folder's name, or the stem of the first bag; where two would be called the
/// same, the later one gets a number ("quad", "quad_2").
std::vector<std::string> sessionNames(const std::vector<Session>& sessions);

}  // namespace urban_nav
