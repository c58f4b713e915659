// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_input {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kMostApart = 500'000'000;  // ns: longest wait for sweeps of another LiDAR

struct PlacedLidar {
  InputStream stream;
  std::optional<Pose> T_base_lidar;
};

LidarStream makeStream(const InputStream& stream, const Pose& T_base_lidar, const PointsOptions& points) {
  double delay = 0.0;  // ms
  for (std::size_t i = 0; i < points.delays.size(); ++i)
    if (stream.role == toString(pointsRole(i))) delay = points.delays[i];
  return LidarStream(stream, T_base_lidar, toCloudOptions(points, false),
                     static_cast<StampNs>(std::llround(1e6 * delay)));
}

}  // namespace

BagSweeps::BagSweeps(Recording& recording, const BagTopics& topics, const urban_nav_ros::StaticTransforms& transforms,
                     const PointsOptions& points, const ReceiptRange& part, bool has_images)
    : points_(points) {
  std::vector<PlacedLidar> lidars;
  for (std::size_t i = 0; i < kPointsTopics; ++i) {
    const std::optional<ChosenTopic> topic = topics.find(pointsRole(i));
    if (!topic) continue;
    PlacedLidar lidar;
    lidar.stream.role = toString(pointsRole(i));
    lidar.stream.topic = topic->name;
    lidar.stream.messages = static_cast<std::int64_t>(recording.count(topic->name));
    RecordedMessages messages = recording.messages({topic->name}, part);
    const std::optional<RecordedMessage> first = messages.next();
    const std::optional<CloudMessages::Cloud> cloud = first ? messages_.read(*first) : std::nullopt;
    lidar.stream.frame = cloud ? cloud->frame : "";
    lidar.T_base_lidar = transforms.lookup(urban_nav_core::frames::kBaseLink, lidar.stream.frame);
    lidars.push_back(std::move(lidar));
  }
  const bool is_placed = has_images || std::any_of(lidars.begin(), lidars.end(), [](const PlacedLidar& lidar) {
                           return lidar.T_base_lidar.has_value();
                         });
  for (PlacedLidar& lidar : lidars) {
    if (!lidar.T_base_lidar) {
      const bool is_base = !is_placed && &lidar == &lidars.front();
      notes_.push_back("no static tf from base_link to \"" + lidar.stream.frame + "\": " +
                       (is_base ? "base_link is assumed at this LiDAR, " + lidar.stream.topic
                                : lidar.stream.topic + " is not used"));
      if (!is_base) continue;
    }
    LidarStream stream = makeStream(lidar.stream, lidar.T_base_lidar.value_or(Pose()), points_);
    if (survey(recording, part, stream)) {
      notes_.push_back(stream.note());
      streams_.push_back(std::move(stream));
    }
  }
  newest_.assign(streams_.size(), 0);
}

bool BagSweeps::survey(Recording& recording, const ReceiptRange& part, LidarStream& stream) {
  urban_nav_core::CloudSurvey survey(stream.options());
  RecordedMessages messages = recording.messages({stream.topic()}, part);
  std::int64_t clouds = 0;
  while (!survey.isComplete()) {
    const std::optional<RecordedMessage> message = messages.next();
    if (!message) break;
    ++clouds;
    if (const std::optional<CloudMessages::Cloud> cloud = messages_.read(*message)) survey.add(cloud->view);
  }
  const urban_nav_core::CloudConvention convention = survey.conclude();
  if (convention.clouds == 0) {
    findings_.push_back({FindingKind::PointsInvalid,
                         stream.topic() + ": no valid points in any of its " + std::to_string(clouds) +
                             " clouds: all are NaN or at the origin, or their fields cannot be read; it is not used",
                         "check the driver and whether the LiDAR is covered"});
    notes_.push_back(findings_.back().text);
    return false;
  }
  if (points_.times && points_.times->areKnown() && !convention.times.areKnown())
    throw urban_nav_core::UserError(
        "input.points_time",
        "\"" + points_.times->field + "\" is no field of " + stream.topic() + " that holds one number",
        survey.fieldNames());
  stream.setConvention(convention);
  return true;
}

std::vector<std::string> BagSweeps::topics() const {
  std::vector<std::string> topics;
  for (const LidarStream& stream : streams_) topics.push_back(stream.topic());
  return topics;
}

bool BagSweeps::add(const RecordedMessage& message) {
  const auto stream = std::find_if(streams_.begin(), streams_.end(),
                                   [&](const LidarStream& each) { return each.topic() == message.topic(); });
  last_reference_.reset();
  if (stream == streams_.end()) return false;
  const std::optional<CloudMessages::Cloud> cloud = messages_.read(message);
  if (!cloud) {
    stream->addFault("its size does not match its type");
    return true;
  }
  if (std::optional<SweepInput> sweep = stream->read(cloud->view)) {
    last_reference_ = newest_[static_cast<std::size_t>(stream - streams_.begin())] = sweep->sweep.reference;
    waiting_.push_back(std::move(*sweep));
    const auto [oldest, newest] = std::minmax_element(newest_.begin(), newest_.end());
    release(std::max(*oldest, *newest - kMostApart));
  }
  return true;
}

void BagSweeps::release(StampNs until) {
  std::stable_sort(waiting_.begin(), waiting_.end(),
                   [](const SweepInput& a, const SweepInput& b) { return a.sweep.reference < b.sweep.reference; });
  const auto later = std::find_if(waiting_.begin(), waiting_.end(),
                                  [until](const SweepInput& sweep) { return sweep.sweep.reference > until; });
  std::move(waiting_.begin(), later, std::back_inserter(ready_));
  waiting_.erase(waiting_.begin(), later);
}

void BagSweeps::flush() {
  for (const StampNs newest : newest_) release(newest);
}

std::vector<SweepInput> BagSweeps::take() {
  std::vector<SweepInput> taken;
  taken.swap(ready_);
  return taken;
}

std::vector<InputStream> BagSweeps::streams() const {
  std::vector<InputStream> streams;
  for (const LidarStream& stream : streams_) streams.push_back(stream.describe());
  return streams;
}

std::vector<Finding> BagSweeps::findings() const {
  std::vector<Finding> findings = findings_;
  for (const LidarStream& stream : streams_)
    for (Finding& finding : stream.findings()) findings.push_back(std::move(finding));
  return findings;
}

void BagSweeps::archive(urban_nav_core::Archive& archive) {
  std::vector<std::pair<std::string, std::string>> lidars;  // role, topic
  for (const LidarStream& stream : streams_) lidars.emplace_back(stream.describe().role, stream.topic());
  archive(lidars);
  if (archive.isReading()) {  // these bags may lack their mounting
    const std::vector<InputStream> here = streams();
    streams_.clear();
    for (const auto& [role, topic] : lidars) {
      InputStream stream;
      stream.role = role;
      stream.topic = topic;
      for (const InputStream& known : here)
        if (known.topic == topic) stream.messages = known.messages;
      streams_.push_back(makeStream(stream, Pose(), points_));
    }
  }
  for (LidarStream& stream : streams_) archive(stream);
  archive(newest_);
  archive.require(newest_.size() == streams_.size(), "references to unknown LiDARs");
}

}  // namespace urban_nav_input
