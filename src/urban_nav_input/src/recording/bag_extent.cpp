// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_extent.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "recording/bag_order.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kLongestSplitNs = static_cast<StampNs>(1e9 * kLongestSplit);
// A recorder restarted before the end of the previous one records an overlap.
constexpr StampNs kMostTwice = 1'000'000'000;  // ns

BagExtent::Span readReceipts(MessageSelection& images) { return {images.first(), images.last()}; }

BagExtent::Span readStamps(MessageSelection& images) {
  std::optional<RecordedMessage> first = images.next(), last = first;
  while (const std::optional<RecordedMessage> each = images.next()) last = each;
  return {readHeaderStamp(*first), readHeaderStamp(*last)};
}

/// Returns the topics of images; without any, those of the clouds of 3D LiDARs.
std::vector<std::string> findLeadingTopics(const Recording& bag) {
  for (const auto& is_leading : {isImageType, isCloudType}) {
    std::vector<std::string> topics;
    for (const auto& [topic, type] : bag.topicTypes())
      if (is_leading(type)) topics.push_back(topic);
    if (!topics.empty()) return topics;
  }
  return {};
}

/// Sets the spans of images by `span_of`. Returns whether all have a valid span.
template <typename SpanOf>
bool useImages(Recording& bag, BagExtent& extent, const SpanOf& span_of) {
  extent.images.clear();
  for (const std::string& topic : findLeadingTopics(bag)) {
    MessageSelection images = bag.select(std::vector<std::string>{topic});
    if (images.size() == 0) continue;
    const BagExtent::Span span = span_of(images);
    const bool is_constant = images.size() > 1 && span.second == span.first;
    if (span.first == 0 || span.second < span.first || is_constant) return false;
    extent.images[topic] = span;
  }
  return !extent.images.empty();
}

BagExtent computeExtent(const std::string& path) {
  Recording bag(path);
  const MessageSelection all = bag.select(std::nullopt);
  if (all.size() == 0) throw DataError(path, "holds no messages (" + bag.description() + ")", "");
  BagExtent extent;
  extent.path = path;
  extent.receipts = {all.first(), all.last()};
  extent.messages = all.size();
  extent.by_stamps = useImages(bag, extent, readStamps);
  return extent;
}

/// Returns whether two spans overlap by more than a restart of the recorder explains.
bool overlap(const BagExtent::Span& a, const BagExtent::Span& b) {
  const StampNs shorter = std::min(a.second - a.first, b.second - b.first);
  return std::min(a.second, b.second) - std::max(a.first, b.first) > std::min(kMostTwice, shorter / 2);
}

/// Returns whether both have images of one topic with stamps of the same time: two robots, two runs of a simulation or
/// of a board whose clock restarts, or a recording whose clock was set. Ignores times of receipt, which may be those of
/// a conversion.
bool areSimultaneous(const BagExtent& a, const BagExtent& b) {
  return std::any_of(a.images.begin(), a.images.end(), [&](const auto& topic) {
    const auto other = b.images.find(topic.first);
    return other != b.images.end() && overlap(topic.second, other->second);
  });
}

/// Returns the bytes of the first and the last image of a topic.
std::pair<std::string, std::string> readEnds(Recording& recording, const std::string& topic) {
  const auto toBytes = [](const RecordedMessage& message) {
    const ByteView bytes = message.bytes();
    return std::string(bytes.data, bytes.data + bytes.size);
  };
  MessageSelection messages = recording.select(std::vector<std::string>{topic});
  const std::optional<RecordedMessage> first = messages.next();
  if (!first) return {};
  std::string first_bytes = toBytes(*first);
  std::optional<RecordedMessage> last = first;
  while (const std::optional<RecordedMessage> each = messages.next()) last = each;
  return {std::move(first_bytes), toBytes(*last)};
}

}  // namespace

bool isSameRecording(const BagExtent& a, const BagExtent& b) {
  if (a.receipts != b.receipts || a.images != b.images || a.messages != b.messages || a.images.empty()) return false;
  Recording first(a.path), second(b.path);
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
      Recording bag(extent.path);
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
  struct Group {
    std::vector<BagExtent> bags;
    StampNs end = 0;
  };
  std::vector<Group> recordings;
  for (const BagExtent& bag : bags) {
    Group* nearest = nullptr;  // group whose end is nearest to the begin of this bag
    const auto apart = [&](const Group& recording) { return std::abs(bag.span.first - recording.end); };
    for (Group& recording : recordings) {
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
  for (Group& recording : recordings) made.push_back(std::move(recording.bags));
  return made;
}

}  // namespace urban_nav_input
