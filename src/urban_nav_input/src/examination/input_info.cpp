// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/input_info.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "recording/bag_order.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_input/folder/euroc_layout.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/folder/kitti_sweeps.hpp"
#include "urban_nav_input/folder/new_college_files.hpp"
#include "urban_nav_input/folder/new_college_log.hpp"
#include "urban_nav_input/recording/connection_definition.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/truth/truth.hpp"
#include "urban_nav_ros/pose.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

namespace {

/// Accumulates the figures of stamps.
class Counter {
 public:
  Counter(std::string name, std::string type) { info_.name = std::move(name), info_.type = std::move(type); }

  void add(StampNs stamp) {
    if (info_.messages++ == 0) {
      info_.first = info_.last = newest_ = stamp;
      return;
    }
    if (stamp <= newest_) ++info_.backward;
    info_.longest_gap_s = std::max(info_.longest_gap_s, urban_nav_core::secondsBetween(newest_, stamp));
    newest_ = stamp;
    info_.first = std::min(info_.first, stamp);
    info_.last = std::max(info_.last, stamp);
  }

  StreamInfo info() const {
    StreamInfo info = info_;
    const double seconds = urban_nav_core::secondsBetween(info.first, info.last);
    info.rate_hz = info.messages > 1 && seconds > 0.0 ? static_cast<double>(info.messages - 1) / seconds : 0.0;
    return info;
  }

 private:
  StreamInfo info_;
  StampNs newest_ = 0;
};

/// Counts a topic by the stamps of its headers, or by receipt if they are not set or constant.
class TopicCounter {
 public:
  explicit TopicCounter(const Connection& connection)
      : has_header_(beginsWithHeader(connection)),
        stamps_(connection.topic, connection.type),
        receipts_(connection.topic, connection.type) {}

  void add(const RecordedMessage& message) {
    receipts_.add(message.receipt());
    if (has_header_ && message.bytes().data != nullptr) stamps_.add(readHeaderStamp(message));
  }

  StreamInfo info() const { return hasStamps() ? stamps_.info() : receipts_.info(); }

  /// Returns a note on the stamps for the user, mostly empty.
  std::string note() const {
    constexpr double kApart = 1.0;  // s
    const StreamInfo stamps = stamps_.info(), receipts = receipts_.info();
    if (!has_header_ || stamps.messages == 0) return {};
    if (!hasStamps())
      return stamps.name + ": stamps are " + (stamps.last == 0 ? "not set" : "all equal") +
             ", so rate and times are by receipt";
    const double begin = urban_nav_core::secondsBetween(stamps.first, receipts.first),
                 length = urban_nav_core::secondsBetween(receipts.first, receipts.last) -
                          urban_nav_core::secondsBetween(stamps.first, stamps.last);
    if (std::abs(begin) < kApart && std::abs(length) < kApart) return {};
    return stamps.name + ": received from " + urban_nav_core::printStamp(receipts.first) + " to " +
           urban_nav_core::printStamp(receipts.last) + " s, which differs from its stamps; the stamps are used";
  }

 private:
  /// Returns whether the messages of a connection begin with a header.
  static bool beginsWithHeader(const Connection& connection) {
    try {
      const MessageDefinition definition = findDefinition(connection);
      const std::vector<MessageField>& fields = definition.layouts.front().fields;
      return !fields.empty() && fields.front().type == "std_msgs/Header";
    } catch (const std::invalid_argument&) {
      return false;  // reported as undecoded
    }
  }

  bool hasStamps() const {
    const StreamInfo stamps = stamps_.info();
    return has_header_ && stamps.last > 0 && (stamps.messages < 2 || stamps.last > stamps.first);
  }

  bool has_header_;
  Counter stamps_, receipts_;
};

template <typename Stamps>
StreamInfo toStream(const std::string& name, const std::string& type, const Stamps& stamps) {
  Counter counter(name, type);
  for (const StampNs stamp : stamps) counter.add(stamp);
  return counter.info();
}

void readBagInfo(const std::string& path, InputInfo& info) {
  Recording recording(path);
  info.kind = recording.kind();
  std::map<std::pair<std::string, std::string>, TopicCounter> counters;  // key: topic and type
  for (const Connection& connection : recording.connections())
    counters.emplace(std::pair(connection.topic, connection.type), TopicCounter(connection));
  std::map<std::string, std::vector<Vector3d>> positions_by_topic;
  MessageSelection all = recording.select(std::nullopt);
  while (const std::optional<RecordedMessage> each = all.next()) {
    counters.at({each->topic(), each->connection().type}).add(*each);
    std::optional<urban_nav_core::Pose> pose;
    if (const auto odometry = each->as<nav_msgs::Odometry>()) pose = urban_nav_ros::toPose(odometry->pose.pose);
    if (const auto stamped = each->as<geometry_msgs::PoseStamped>()) pose = urban_nav_ros::toPose(stamped->pose);
    if (pose) positions_by_topic[each->topic()].push_back(pose->t());
  }
  for (const auto& [key, counter] : counters) {
    info.streams.push_back(counter.info());
    info.streams.back().undecoded = recording.undecoded(key.first, key.second);
    if (std::string note = counter.note(); !note.empty()) info.notes.push_back(std::move(note));
  }
  info.warnings = recording.warnings();
  if (positions_by_topic.empty()) return;
  const auto truth = std::find_if(positions_by_topic.begin(), positions_by_topic.end(), [](const auto& positions) {
    return positions.first.find("truth") != std::string::npos;
  });
  const auto& [topic, positions] = truth != positions_by_topic.end() ? *truth : *positions_by_topic.begin();
  info.distance_m = urban_nav_core::travelledLength(positions);
  info.distance_of = topic;
}

void addKittiStreams(const std::string& path, InputInfo& info) {
  if (const std::optional<KittiLayout> layout = findKittiLayout(path))
    info.streams.push_back(toStream("stereo", "image pairs", listKittiFrames(*layout, 0.0).stamps));
  const std::optional<KittiSweepLayout> sweeps = findKittiSweeps(path);
  if (!sweeps) return;
  const std::map<std::int64_t, std::string> files = listKittiSweeps(*sweeps);
  const KittiLayout layout{path, sweeps->files, sweeps->files, urban_nav_core::KittiPair::Grey};
  const std::int64_t first = files.begin()->first;
  std::vector<std::string> notes;  // reported by the source
  const std::vector<StampNs> all = stampKittiFrames(layout, "sweeps", {first, files.rbegin()->first}, 0.0, notes);
  std::vector<StampNs> stamps;
  for (const auto& [number, file] : files) stamps.push_back(all[static_cast<std::size_t>(number - first)]);
  info.streams.push_back(toStream(sweeps->name, "sweeps", stamps));
}

void examineFolder(const std::string& path, InputKind kind, InputInfo& info) {
  std::vector<StampNs> stamps;
  SourceOptions options;
  options.with_sweeps = true;
  const std::unique_ptr<Source> source = openSource({path}, options);
  info.notes = source->info().notes;
  const urban_nav_core::StereoCamera& camera = source->info().camera;
  if (source->info().has_images)
    info.notes.push_back(std::to_string(camera.left.width) + "x" + std::to_string(camera.left.height) + ", f " +
                         std::to_string(camera.left.fx) + " px, baseline " + std::to_string(camera.baseline) + " m");
  if (kind == InputKind::KittiFolder) {
    addKittiStreams(path, info);
  } else {
    for (const EurocPair& pair : readEurocPairs(eurocFolder(path))) stamps.push_back(pair.stamp);
    info.streams.push_back(toStream("stereo", "image pairs", stamps));
    stamps.clear();
    for (const EurocImu& row : readEurocImu(eurocFolder(path))) stamps.push_back(row.stamp);
    if (!stamps.empty()) info.streams.push_back(toStream("imu0", "rates and accelerations", stamps));
  }
  if (const std::optional<TrajectoryFile> truth = findTruth({{path}}, source->info(), options)) {
    std::vector<Vector3d> positions;
    stamps.clear();
    for (const urban_nav_core::StampedPose& pose : truth->trajectory) {
      positions.push_back(pose.pose.t());
      stamps.push_back(pose.stamp);
    }
    info.streams.push_back(toStream("truth", "poses", stamps));
    info.distance_m = urban_nav_core::travelledLength(positions);
    info.distance_of = truth->path;
  }
}

void examineNewCollege(const std::string& path, InputInfo& info) {
  const NewCollegeFiles files = findNewCollege(path);
  std::vector<StampNs> stamps;
  for (const NewCollegeFiles::Pair& pair : files.stereo) stamps.push_back(pair.stamp);
  info.streams.push_back(toStream("stereo", "image pairs", stamps));
  stamps.clear();
  for (const NewCollegeFiles::Image& image : files.panorama) {
    if (image.camera == 0) stamps.push_back(image.stamp);
  }
  info.streams.push_back(toStream("ladybug", "panoramas", stamps));
  if (files.alog.empty()) return;
  Counter left("laser_left", "scans"), right("laser_right", "scans"), odometry("wheel_odom", "poses");
  std::vector<Vector3d> positions;
  NewCollegeLog log(files.alog);
  while (const std::optional<NewCollegeEvent> event = log.next()) {
    if (const auto* scan = std::get_if<NewCollegeScan>(&*event))
      (scan->side == Side::Left ? left : right).add(scan->stamp);
    if (const auto* pose = std::get_if<NewCollegeOdometry>(&*event)) {
      odometry.add(pose->stamp);
      positions.push_back(pose->T_odom_base.t());
    }
  }
  for (const Counter* counter : {&left, &right, &odometry}) info.streams.push_back(counter->info());
  info.distance_m = urban_nav_core::travelledLength(positions);
  info.distance_of = "wheel_odom";
}

}  // namespace

InputInfo lookInto(const std::string& path) {
  const InputKind kind = inputKind(path);
  InputInfo info;
  info.name = path;
  switch (kind) {
    case InputKind::Bag: readBagInfo(path, info); break;
    case InputKind::NewCollegeFolder:
      info.kind = "New College folder";
      examineNewCollege(path, info);
      break;
    case InputKind::KittiFolder:
    case InputKind::EurocFolder:
      info.kind = kind == InputKind::KittiFolder ? "KITTI folder" : "EuRoC folder";
      examineFolder(path, kind, info);
      break;
  }
  return info;
}

}  // namespace urban_nav_input
