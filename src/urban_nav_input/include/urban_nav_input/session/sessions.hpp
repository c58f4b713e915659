// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/receipt_range.hpp"

namespace urban_nav_input {

/// Inputs of one session: one folder, or the bags of a recording in the order of time.
struct InputSession {
  std::vector<std::string> paths;
  urban_nav_core::StampNs begin = 0;  ///< receipt of the first message of the first bag; 0 for a folder
  std::string name = {};              ///< of the stored session continued by these bags; empty: by the first path
  ReceiptRange part = {};             ///< of the bags; {0, 0}: all of them
  std::string note = {};              ///< reason why the bags are several sessions, for the user; mostly empty
};
/// Rule that determines which recordings form a session.
enum class SessionRule {
  Auto,     ///< those less than 5 s apart, unless they have images of the same topic at the same time
  Apart,    ///< each recording is a session
  Together  ///< all recordings are one session
};

/// Returns the sessions of inputs: each folder is one, bags less than 5 s apart are one (a split recording) unless they
/// have images of the same topic at the same time (separateRecordings()). A new session begins where the stamps of the
/// stereo images step back because a clock was set. `topics`: ROLE:=NAME, for bags. `rule`: overrides this grouping.
/// Throws UserError for an input of unknown kind, DataError for a bag that cannot be read.
std::vector<InputSession> findSessions(const std::vector<std::string>& inputs,
                                       const std::vector<std::string>& topics = {},
                                       SessionRule rule = SessionRule::Auto);

/// Returns the names of sessions in closures.csv, those of `earlier` ones first: the folder's name, or the stem of the
/// first bag. Of two equal names the later one gets a number ("quad", "quad_2").
std::vector<std::string> sessionNames(const std::vector<InputSession>& sessions,
                                      const std::vector<std::string>& earlier = {});
/// Returns the session name for a word in a file of closures: `word` if a session has this name, else the name of the
/// session with this number, from 0, after the first `earlier` ones; `word` if there is neither.
std::string sessionMeant(const std::string& word, const std::vector<std::string>& names, std::size_t earlier);
/// Return the name of an input, and the first unused one of this name and its numbered variants.
std::string plainName(const std::string& input);
std::string uniqueName(const std::string& plain, const std::vector<std::string>& taken);

}  // namespace urban_nav_input
