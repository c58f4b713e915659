// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// What belongs to one session: one folder, or the bags of a recording in the order of time.
struct Session {
  std::vector<std::string> paths;
  urban_nav_core::StampNs begin = 0;  ///< of the first bag: when its first message was received; 0 for a folder
  std::string name = {};  ///< as a store calls the session that these bags go on in; empty: by the first path
};
/// Parts of one recording are less than this apart.
constexpr double kLongestSplit = 5.0;  // s

/// Each folder is a session; bags less than 5 s apart are one (a split recording). UserError where there is nothing
/// that is known.
std::vector<Session> findSessions(const std::vector<std::string>& inputs);

/// What sessions are called in closures.csv: the folder's name, or the stem of the first bag; where two would be called the
/// same, the later one gets a number ("quad", "quad_2"). Behind the names of `earlier` ones, which come first in the result.
std::vector<std::string> sessionNames(const std::vector<Session>& sessions,
                                      const std::vector<std::string>& earlier = {});
/// The name that a file of closures means: its own where there is a session of this name, else that of the session with this number, from 0, among
/// those behind the first `earlier` names; the word itself where there is neither.
std::string sessionMeant(const std::string& word, const std::vector<std::string>& names, std::size_t earlier);
/// The two halves of sessionNames(): the name of an input, and that name or the first numbered one that is not taken.
std::string plainName(const std::string& input);
std::string uniqueName(const std::string& plain, const std::vector<std::string>& taken);

}  // namespace urban_nav
