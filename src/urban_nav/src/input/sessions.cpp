// SPDX-License-Identifier: BSD-3-Clause
#include "input/sessions.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <list>
#include <map>
#include <optional>
#include <utility>

#include "input/bag_contents.hpp"
#include "input/bag_order.hpp"
#include "input/bag_topics.hpp"
#include "input/open.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::DataError;

namespace {

struct Extent {
  std::string path;
  double begin = 0.0, end = 0.0;                // s: by the stamps of the images, else of receipt
  urban_nav_core::StampNs first = 0, last = 0;  // receipts
  bool by_stamps = false;
};

/// Sets the extent by stamps, which tell what belongs together also where bags were converted or written anew, all at
/// the same time. Without effect where a topic has no stamps, or ends before it begins.
void useStamps(rosbag::Bag& bag, Extent& extent) {
  rosbag::View images(bag,
                      rosbag::TypeQuery(std::vector<std::string>{"sensor_msgs/Image", "sensor_msgs/CompressedImage"}));
  std::map<std::string, std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs>> topics;
  for (const rosbag::ConnectionInfo* connection : images.getConnections()) {
    rosbag::View view(bag, rosbag::TopicQuery(connection->topic));
    if (view.size() == 0) continue;
    auto last = view.begin();
    for (auto each = view.begin(); each != view.end(); ++each) last = each;
    topics[connection->topic] = {readHeaderStamp(*view.begin()), readHeaderStamp(*last)};
  }
  std::optional<std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs>> all;
  for (const auto& [topic, stamps] : topics) {
    if (stamps.first == 0 || stamps.second < stamps.first) return;
    all = all ? std::make_pair(std::min(all->first, stamps.first), std::max(all->second, stamps.second)) : stamps;
  }
  if (!all) return;
  extent.by_stamps = true;
  extent.begin = 1e-9 * static_cast<double>(all->first);
  extent.end = 1e-9 * static_cast<double>(all->second);
}

Extent computeExtent(const std::string& path) {
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag);
    if (view.size() == 0) throw DataError(path, "holds no messages", "");
    Extent extent{path, view.getBeginTime().toSec(), view.getEndTime().toSec(),
                  urban_nav_ros::toStampNs(view.getBeginTime()), urban_nav_ros::toStampNs(view.getEndTime())};
    useStamps(bag, extent);
    return extent;
  } catch (const rosbag::BagUnindexedException&) {
    throw DataError(path, "has no index: the recording was cut off (rosbag reindex " + path + " repairs that)", "");
  } catch (const rosbag::BagException& error) {
    throw DataError(path, std::string("cannot be read: ") + error.what(),
                    "a whole bag (`rosbag reindex` mends one that was cut off)");
  }
}

/// Returns the places at which the stamps of the stereo images of a recording step back.
std::vector<ClockStep> findStereoSteps(const std::vector<std::string>& paths, const std::vector<std::string>& wishes) {
  std::list<rosbag::Bag> bags;
  for (const std::string& path : paths) bags.emplace_back(path, rosbag::bagmode::Read);
  std::vector<std::string> topics;
  try {
    const BagTopics chosen = chooseTopics(topicTypes(bags), wishes);
    for (const Role role : {Role::Left, Role::Right})
      if (const std::optional<ChosenTopic> topic = chosen.find(role)) topics.push_back(topic->name);
  } catch (const urban_nav_core::UserError&) {
    return {};  // reported by the reader of the bags
  }
  return findClockSteps(bags, topics);
}

/// Returns the bags of a session that hold messages of a part of it.
std::vector<std::string> bagsWithin(const std::vector<Extent>& bags, const ReceiptRange& part) {
  std::vector<std::string> paths;
  for (const Extent& bag : bags)
    if (bag.last >= part.begin && (part.end == 0 || bag.first < part.end)) paths.push_back(bag.path);
  return paths;
}

/// Appends the session of some bags, or several where a clock was set back.
void appendSessions(const std::vector<Extent>& bags, const std::vector<std::string>& topics,
                    std::vector<InputSession>& sessions) {
  std::vector<std::string> paths;
  for (const Extent& bag : bags) paths.push_back(bag.path);
  const std::vector<ClockStep> steps = findStereoSteps(paths, topics);
  if (steps.empty()) {
    sessions.push_back({paths, bags.front().first});
    return;
  }
  for (std::size_t i = 0; i <= steps.size(); ++i) {
    InputSession session;
    session.part = {i == 0 ? 0 : steps[i - 1].receipt, i == steps.size() ? 0 : steps[i].receipt};
    session.begin = i == 0 ? bags.front().first : session.part.begin;
    session.paths = bagsWithin(bags, session.part);
    if (i > 0)
      session.note = "stamps step back by " +
                     urban_nav_core::printNumber(std::round(1e-7 * static_cast<double>(steps[i - 1].back)) / 100.0) +
                     " s during the recording (a clock was set): a new session begins there";
    sessions.push_back(session);
  }
}

}  // namespace

std::vector<InputSession> findSessions(const std::vector<std::string>& inputs, const std::vector<std::string>& topics) {
  std::vector<InputSession> sessions;
  std::vector<Extent> bags;
  for (const std::string& input : inputs) {
    if (inputKind(input) == InputKind::Bag) {
      bags.push_back(computeExtent(input));
    } else {
      sessions.push_back({{input}, 0});
    }
  }
  // Stamps and times of receipt cannot be compared: if one bag has to be placed by receipt, all are.
  if (std::any_of(bags.begin(), bags.end(), [](const Extent& bag) { return !bag.by_stamps; }))
    for (Extent& bag : bags) {
      bag.begin = 1e-9 * static_cast<double>(bag.first);
      bag.end = 1e-9 * static_cast<double>(bag.last);
    }
  std::stable_sort(bags.begin(), bags.end(), [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
  std::vector<Extent> recording;
  double end = 0.0;
  for (const Extent& bag : bags) {
    if (!recording.empty() && bag.begin - end >= kLongestSplit) {
      appendSessions(recording, topics, sessions);
      recording.clear();
    }
    end = recording.empty() ? bag.end : std::max(end, bag.end);
    recording.push_back(bag);
  }
  if (!recording.empty()) appendSessions(recording, topics, sessions);
  return sessions;
}

std::string plainName(const std::string& input) {
  std::filesystem::path path = std::filesystem::absolute(input).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return (path.extension() == ".bag" ? path.stem() : path.filename()).string();
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

}  // namespace urban_nav
