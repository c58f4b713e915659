// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/sessions.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "recording/bag_extent.hpp"
#include "recording/clock_steps.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;

namespace {

/// Returns the times at which the stamps of the stereo images of a recording step back; without images, of the clouds.
std::vector<ClockStep> findStereoSteps(const std::vector<std::string>& paths, const std::vector<std::string>& wishes) {
  Recording recording(paths);
  std::vector<std::string> topics;
  try {
    const BagTopics chosen = chooseTopics(recording.topicTypes(), wishes);
    for (const Role role : {Role::Left, Role::Right})
      if (const std::optional<ChosenTopic> topic = chosen.find(role)) topics.push_back(topic->name);
    for (std::size_t lidar = 0; topics.empty() && lidar < kPointsTopics; ++lidar)
      if (const std::optional<ChosenTopic> topic = chosen.find(pointsRole(lidar))) topics.push_back(topic->name);
  } catch (const urban_nav_core::UserError&) {
    return {};  // reported by the reader of the bags
  }
  return findClockSteps(recording, topics);
}

/// Returns the bags of a session with messages within a part of it.
std::vector<std::string> bagsWithin(const std::vector<BagExtent>& bags, const ReceiptRange& part) {
  std::vector<std::string> paths;
  for (const BagExtent& bag : bags)
    if (bag.receipts.second >= part.begin && (part.end == 0 || bag.receipts.first < part.end))
      paths.push_back(bag.path);
  return paths;
}

/// Appends the session of some bags, or several if a clock was set back.
void appendSessions(const std::vector<BagExtent>& bags, const std::vector<std::string>& topics,
                    std::vector<InputSession>& sessions) {
  std::vector<std::string> paths;
  for (const BagExtent& bag : bags) paths.push_back(bag.path);
  const std::vector<ClockStep> steps = findStereoSteps(paths, topics);
  if (steps.empty()) {
    sessions.push_back({paths, bags.front().receipts.first});
    return;
  }
  for (std::size_t i = 0; i <= steps.size(); ++i) {
    InputSession session;
    session.part = {i == 0 ? 0 : steps[i - 1].receipt, i == steps.size() ? 0 : steps[i].receipt};
    session.begin = i == 0 ? bags.front().receipts.first : session.part.begin;
    session.paths = bagsWithin(bags, session.part);
    if (i > 0)
      session.note = "stamps step back by " +
                     urban_nav_core::printNumber(std::round(1e-7 * static_cast<double>(steps[i - 1].back)) / 100.0) +
                     " s during the recording (a clock was set): a new session begins there";
    sessions.push_back(session);
  }
}

/// Returns the bags without copies; `copies`: a sentence by the path of the kept bag.
std::vector<BagExtent> takeOnce(const std::vector<BagExtent>& bags, std::map<std::string, std::string>& copies) {
  std::vector<BagExtent> kept;
  for (const BagExtent& bag : bags) {
    const auto same =
        std::find_if(kept.begin(), kept.end(), [&](const BagExtent& other) { return isSameRecording(other, bag); });
    if (same == kept.end()) {
      kept.push_back(bag);
      continue;
    }
    std::string& sentence = copies[same->path];
    sentence += (sentence.empty() ? "" : "; ") + bag.path + " holds the same messages as " + same->path +
                ": given twice, used once";
  }
  return kept;
}

/// Returns the bags of each recording.
std::vector<std::vector<BagExtent>> groupBags(const std::vector<BagExtent>& bags, SessionRule rule) {
  if (rule == SessionRule::Auto) return separateRecordings(bags);
  std::vector<std::vector<BagExtent>> recordings;
  for (const BagExtent& bag : bags) {
    if (recordings.empty() || rule == SessionRule::Apart) recordings.emplace_back();
    recordings.back().push_back(bag);
  }
  return recordings;
}

}  // namespace

std::vector<InputSession> findSessions(const std::vector<std::string>& inputs, const std::vector<std::string>& topics,
                                       SessionRule rule) {
  std::vector<InputSession> sessions;
  std::vector<std::string> paths;
  for (const std::string& input : inputs) {
    if (inputKind(input) == InputKind::Bag) paths.push_back(input);
    else sessions.push_back({{input}, 0});
  }
  std::vector<BagExtent> earlier;
  std::map<std::string, std::string> copies;
  for (const std::vector<BagExtent>& recording : groupBags(takeOnce(findExtents(paths), copies), rule)) {
    const std::size_t first = sessions.size();
    appendSessions(recording, topics, sessions);
    const auto simultaneous = std::find_if(earlier.begin(), earlier.end(), [&](const BagExtent& bag) {
      return bag.span.second > recording.front().span.first;
    });
    if (rule == SessionRule::Auto && simultaneous != earlier.end())
      sessions[first].note = "holds images of the same topics at the same time as " + simultaneous->path +
                             ": a separate session (--set input.sessions=together if they are one recording)";
    for (const BagExtent& bag : recording)
      if (const auto copy = copies.find(bag.path); copy != copies.end())
        sessions[first].note += (sessions[first].note.empty() ? "" : "; ") + copy->second;
    earlier.insert(earlier.end(), recording.begin(), recording.end());
  }
  return sessions;
}

std::string plainName(const std::string& input) {
  std::filesystem::path path = std::filesystem::absolute(input).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (const std::string ending = path.extension().string(); ending == ".zstd" || ending == ".zst") path = path.stem();
  const std::string ending = path.extension().string();
  return (ending == ".bag" || ending == ".mcap" || ending == ".db3" ? path.stem() : path.filename()).string();
}

std::string uniqueName(const std::string& plain, const std::vector<std::string>& taken) {
  std::string name = plain;
  for (int i = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++i)
    name = plain + "_" + std::to_string(i);
  return name;
}

std::vector<std::string> sessionNames(const std::vector<InputSession>& sessions,
                                      const std::vector<std::string>& earlier) {
  std::vector<std::string> names = earlier;
  for (const InputSession& session : sessions)
    names.push_back(uniqueName(plainName(session.name.empty() ? session.paths.front() : session.name), names));
  return names;
}

std::string sessionMeant(const std::string& word, const std::vector<std::string>& names, std::size_t earlier) {
  if (std::find(names.begin(), names.end(), word) != names.end()) return word;
  const std::optional<std::int64_t> number = urban_nav_core::parseInteger(word);
  if (!number || *number < 0 || *number >= static_cast<std::int64_t>(names.size() - earlier)) return word;
  return names[earlier + static_cast<std::size_t>(*number)];
}

}  // namespace urban_nav_input
