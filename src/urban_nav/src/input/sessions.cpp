// SPDX-License-Identifier: BSD-3-Clause
#include "input/sessions.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "input/bag_order.hpp"
#include "input/open.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::DataError;

namespace {

struct Extent {
  std::string path;
  double begin = 0.0, end = 0.0;  // s: by the stamps of the images, else of receipt
  urban_nav_core::StampNs first = 0;
};

/// Stamps tell what belongs together also where bags were converted or written anew, all at the same time.
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
  extent.begin = 1e-9 * static_cast<double>(all->first);
  extent.end = 1e-9 * static_cast<double>(all->second);
}

Extent computeExtent(const std::string& path) {
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag);
    if (view.size() == 0) throw DataError(path, "holds no messages", "");
    Extent extent{path, view.getBeginTime().toSec(), view.getEndTime().toSec(),
                  urban_nav_ros::toStampNs(view.getBeginTime())};
    useStamps(bag, extent);
    return extent;
  } catch (const rosbag::BagUnindexedException&) {
    throw DataError(path, "has no index: the recording was cut off (rosbag reindex " + path + " repairs that)", "");
  } catch (const rosbag::BagException& error) {
    throw DataError(path, std::string("cannot be read: ") + error.what(),
                    "a whole bag (`rosbag reindex` mends one that was cut off)");
  }
}

}  // namespace

std::vector<InputSession> findSessions(const std::vector<std::string>& inputs) {
  std::vector<InputSession> sessions;
  std::vector<Extent> bags;
  for (const std::string& input : inputs) {
    if (inputKind(input) == InputKind::Bag) {
      bags.push_back(computeExtent(input));
    } else {
      sessions.push_back({{input}, 0});
    }
  }
  std::stable_sort(bags.begin(), bags.end(), [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
  double end = 0.0;
  bool first = true;
  for (const Extent& bag : bags) {
    if (first || bag.begin - end >= kLongestSplit) sessions.push_back({{}, bag.first});
    sessions.back().paths.push_back(bag.path);
    end = first ? bag.end : std::max(end, bag.end);
    first = false;
  }
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
