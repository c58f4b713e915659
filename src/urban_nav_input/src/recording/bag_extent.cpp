// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_extent.hpp"

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "recording/bag_order.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/receipt_range.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kLongestSplitNs = static_cast<StampNs>(1e9 * kLongestSplit);
// A recorder that is started again before the one before it has ended records a little twice.
constexpr StampNs kMostTwice = 1'000'000'000;  // ns

BagExtent::Span readReceipts(rosbag::View& view) {
  return {urban_nav_ros::toStampNs(view.getBeginTime()), urban_nav_ros::toStampNs(view.getEndTime())};
}

BagExtent::Span readStamps(rosbag::View& view) {
  auto last = view.begin();
  for (auto each = view.begin(); each != view.end(); ++each) last = each;
  return {readHeaderStamp(*view.begin()), readHeaderStamp(*last)};
}

/// Sets the spans of images by `span_of`. Whether all have one that does not end before it begins.
template <typename SpanOf>
bool useImages(rosbag::Bag& bag, BagExtent& extent, const SpanOf& span_of) {
  rosbag::View images(bag,
                      rosbag::TypeQuery(std::vector<std::string>{"sensor_msgs/Image", "sensor_msgs/CompressedImage"}));
  extent.images.clear();
  for (const rosbag::ConnectionInfo* connection : images.getConnections()) {
    rosbag::View view(bag, rosbag::TopicQuery(connection->topic));
    if (view.size() == 0) continue;
    const BagExtent::Span span = span_of(view);
    const bool is_constant = view.size() > 1 && span.second == span.first;
    if (span.first == 0 || span.second < span.first || is_constant) return false;
    extent.images[connection->topic] = span;
  }
  return !extent.images.empty();
}

BagExtent computeExtent(const std::string& path) {
  try {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag);
    if (view.size() == 0) throw DataError(path, "holds no messages", "");
    BagExtent extent;
    extent.path = path;
    extent.receipts = readReceipts(view);
    extent.messages = view.size();
    extent.by_stamps = useImages(bag, extent, readStamps);
    return extent;
  } catch (const rosbag::BagUnindexedException&) {
    throw DataError(path, "has no index: the recording was cut off (rosbag reindex " + path + " repairs that)", "");
  } catch (const rosbag::BagException& error) {
    throw DataError(path, std::string("cannot be read: ") + error.what(),
                    "a whole bag (`rosbag reindex` mends one that was cut off)");
  }
}

/// Whether two spans share more than a recorder's restart explains.
bool overlap(const BagExtent::Span& a, const BagExtent::Span& b) {
  const StampNs shorter = std::min(a.second - a.first, b.second - b.first);
  return std::min(a.second, b.second) - std::max(a.first, b.first) > std::min(kMostTwice, shorter / 2);
}

/// Whether both hold images of one topic with stamps of the same time: two robots, two runs of a simulation or of a
/// board whose clock starts anew, or a recording whose clock was set. Times of receipt do not count: they may be those
/// of a conversion.
bool areSimultaneous(const BagExtent& a, const BagExtent& b) {
  return std::any_of(a.images.begin(), a.images.end(), [&](const auto& topic) {
    const auto other = b.images.find(topic.first);
    return other != b.images.end() && overlap(topic.second, other->second);
  });
}

/// Returns the bytes of the first and the last image of a topic.
std::pair<std::string, std::string> readEnds(rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  const auto toBytes = [](const rosbag::MessageInstance& message) {
    std::string bytes(message.size(), '\0');
    ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()), message.size());
    message.write(stream);
    return bytes;
  };
  if (view.size() == 0) return {};
  auto last = view.begin();
  for (auto each = view.begin(); each != view.end(); ++each) last = each;
  return {toBytes(*view.begin()), toBytes(*last)};
}

}  // namespace

bool isSameRecording(const BagExtent& a, const BagExtent& b) {
  if (a.receipts != b.receipts || a.images != b.images || a.messages != b.messages || a.images.empty()) return false;
  rosbag::Bag first(a.path, rosbag::bagmode::Read), second(b.path, rosbag::bagmode::Read);
  return std::all_of(a.images.begin(), a.images.end(),
                     [&](const auto& topic) { return readEnds(first, topic.first) == readEnds(second, topic.first); });
}

std::vector<BagExtent> findExtents(const std::vector<std::string>& paths) {
  std::vector<BagExtent> bags;
  for (const std::string& path : paths) bags.push_back(computeExtent(path));
  const bool by_stamps =
      std::all_of(bags.begin(), bags.end(), [](const BagExtent& extent) { return extent.by_stamps; });
  for (BagExtent& extent : bags) {
    extent.by_stamps = by_stamps;
    extent.span = extent.receipts;
    if (!by_stamps) {
      rosbag::Bag bag(extent.path, rosbag::bagmode::Read);
      useImages(bag, extent, readReceipts);
      continue;
    }
    extent.span = extent.images.begin()->second;
    for (const auto& [topic, span] : extent.images)
      extent.span = {std::min(extent.span.first, span.first), std::max(extent.span.second, span.second)};
  }
  std::stable_sort(bags.begin(), bags.end(),
                   [](const BagExtent& a, const BagExtent& b) { return a.span.first < b.span.first; });
  return bags;
}

std::vector<std::vector<BagExtent>> separateRecordings(const std::vector<BagExtent>& bags) {
  struct Recording {
    std::vector<BagExtent> bags;
    StampNs end = 0;
  };
  std::vector<Recording> recordings;
  for (const BagExtent& bag : bags) {
    Recording* nearest = nullptr;  // of those side by side, whose end this bag's begin is nearest to
    const auto apart = [&](const Recording& recording) { return std::abs(bag.span.first - recording.end); };
    for (Recording& recording : recordings) {
      const bool is_other = std::any_of(recording.bags.begin(), recording.bags.end(),
                                        [&](const BagExtent& member) { return areSimultaneous(member, bag); });
      if (is_other || bag.span.first - recording.end >= kLongestSplitNs) continue;
      if (!nearest || apart(recording) < apart(*nearest)) nearest = &recording;
    }
    if (!nearest) nearest = &recordings.emplace_back();
    nearest->end = nearest->bags.empty() ? bag.span.second : std::max(nearest->end, bag.span.second);
    nearest->bags.push_back(bag);
  }
  std::vector<std::vector<BagExtent>> made;
  for (Recording& recording : recordings) made.push_back(std::move(recording.bags));
  return made;
}

}  // namespace urban_nav_input
