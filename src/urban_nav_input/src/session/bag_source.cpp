// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>

#include "recording/bag_groups.hpp"
#include "recording/bag_order.hpp"
#include "recording/unused_topics.hpp"
#include "session/bag_calibration.hpp"
#include "session/bag_sensors.hpp"
#include "session/given_transforms.hpp"
#include "session/pair_delay.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/sensors/topic_examination.hpp"
#include "urban_nav_input/session/bag_panorama.hpp"
#include "urban_nav_input/session/calibration_file.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace frames = urban_nav_core::frames;

using urban_nav_core::CameraInfo;
using urban_nav_core::DataError;
using urban_nav_core::UserError;
using urban_nav_ros::StereoFeed;

namespace {

constexpr urban_nav_core::StampNs kMaxLateness = 200'000'000;  // ns: offline, waiting costs nothing

constexpr urban_nav_core::StampNs kClockStep = 1'000'000'000;  // ns

constexpr const char* kBagStateName = "reader of bags";
constexpr std::uint32_t kBagStateVersion = 5;
constexpr urban_nav_core::StampNs kReceiptTolerance =
    25'000'000;                            // ns: images of a pair are received one after another
constexpr std::size_t kDepthSamples = 20;  // images at the beginning of each side

/// The bags of one recording, read as one stream in the order of their receipt; the feed brings it into the order of
/// stamps.
class BagSource : public Source {
 public:
  BagSource(const std::vector<std::string>& paths, const SourceOptions& options, const BagEnd* after,
            const ReceiptRange& part)
      : options_(options), part_(part), name_(paths.front()), recording_(paths) {
    topics_ = chooseTopics(recording_.topicTypes(), options.topics);
    if (!topics_.find(Role::Left) || !topics_.find(Role::Right))
      throw DataError(name_, "has no stereo pair of image topics: " + listing(), "");
    info_.name = name_ + (paths.size() > 1 ? " and " + std::to_string(paths.size() - 1) + " more" : "");
    info_.kind = "bag";
    info_.notes = topics_.notes;
    calibrate();
    place();
    startReading();
    if (after != nullptr) resume(*after);
    readGroup();
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<SourceItem> next() override {
    while (true) {
      if (std::optional<urban_nav_ros::DecodedPair> pair = feed_->take()) {
        SourceItem input(std::move(*pair));
        input.bag_end = std::exchange(bag_end_, nullptr);
        input.scans = std::exchange(scans_, {});
        input.panoramas = std::exchange(panoramas_, {});
        return input;
      }
      if (ended_) return std::nullopt;
      if (const RecordedMessage* message = messages_ ? messages_->next() : nullptr) add(*message);
      else endGroup();
    }
  }

  std::vector<LaserInput> scans() const override { return scans_; }
  std::vector<urban_nav_ros::Panorama> panoramas() const override { return panoramas_; }
  std::vector<urban_nav_core::SpecificForce> forces() const override { return sensors_.forces(); }
  std::vector<Finding> sensorFindings() const override { return sensors_.findings(); }
  std::shared_ptr<const BagEnd> bagEnd() const override { return bag_end_; }

  std::vector<std::string> closingFaults() const override {
    std::vector<std::string> faults;
    const auto count = [&](urban_nav_ros::Side side, Role role) {
      const urban_nav_core::TimeOrderedQueueCounts& counts = feed_->counts(side);
      const std::string topic = topics_.find(role)->name;
      if (counts.late > 0)
        faults.push_back(topic + ": " + std::to_string(counts.late) +
                         " images came too late by their stamps and were dropped");
      if (counts.duplicate > 0)
        faults.push_back(topic + ": " + std::to_string(counts.duplicate) +
                         " images have the stamp of another and were dropped");
      if (feed_->missing(side) > 0)
        faults.push_back(topic + ": " + std::to_string(feed_->missing(side)) +
                         " images are missing: no partner within 5 ms" +
                         describeDelay(image_stamps_[0], image_stamps_[1]));
    };
    count(urban_nav_ros::Side::Left, Role::Left);
    count(urban_nav_ros::Side::Right, Role::Right);
    for (std::string& fault : panorama_.faults()) faults.push_back(std::move(fault));
    for (std::string& warning : recording_.warnings()) faults.push_back(std::move(warning));
    return faults;
  }

 private:
  std::string listing() {
    std::string text;
    for (const auto& [topic, type] : recording_.topicTypes()) {
      if (isImageType(type)) text += (text.empty() ? "" : ", ") + topic;
    }
    return text.empty() ? "it has no images at all" : text + " (--topic left:=NAME --topic right:=NAME)";
  }

  template <typename Message>
  boost::shared_ptr<Message> first(const std::string& topic) {
    return recording_.first<Message>(topic);
  }

  /// Frame and size of a camera's first image.
  struct Look {
    std::string frame;
    int width = 0, height = 0;
  };
  Look look(const ChosenTopic& topic) {
    if (topic.type == "sensor_msgs/Image") {
      const auto image = first<sensor_msgs::Image>(topic.name);
      return image ? Look{image->header.frame_id, static_cast<int>(image->width), static_cast<int>(image->height)}
                   : Look{};
    }
    const auto image = first<sensor_msgs::CompressedImage>(topic.name);
    if (!image) return {};
    const cv::Mat pixels = urban_nav_ros::toGrey(*image).pixels;
    return {image->header.frame_id, pixels.cols, pixels.rows};
  }

  sensor_msgs::CameraInfoConstPtr findInfo(Role role) {
    const std::optional<ChosenTopic> topic = topics_.find(role);
    return topic ? first<sensor_msgs::CameraInfo>(topic->name) : nullptr;
  }

  std::pair<CameraInfo, CameraInfo> makeInfos() {
    const auto left = findInfo(Role::LeftInfo), right = findInfo(Role::RightInfo);
    const std::vector<std::string> damage = recording_.warnings();
    if ((!left || !right) && !damage.empty())
      throw DataError(name_, "no camera_info can be read: " + damage.front(), "a recording that is not damaged");
    if (!left && !right)
      throw UserError(name_, "has no camera_info for the left and the right images",
                      "--calibration FILE, or --topic left_info:=NAME --topic right_info:=NAME");
    if (!left || !right)
      throw UserError(name_, std::string("has no camera_info for the ") + (left ? "right" : "left") + " images",
                      std::string("--calibration FILE, or --topic ") +
                          toString(left ? Role::RightInfo : Role::LeftInfo) + ":=NAME");
    camera_frame_ = left->header.frame_id;
    return {urban_nav_ros::toCameraInfo(*left), urban_nav_ros::toCameraInfo(*right)};
  }

  void calibrate() {
    const ChosenTopic left = *topics_.find(Role::Left);
    const Look seen = look(left);
    camera_frame_ = seen.frame;
    const bool given = !options_.calibration.empty();
    const auto [left_info, right_info] =
        given ? readCalibration(options_.calibration, seen.width, seen.height) : makeInfos();
    if (camera_frame_.empty()) camera_frame_ = seen.frame;
    if (left_info.distortion_model.empty() && urban_nav_core::needsRectification(left_info))
      info_.notes.push_back("distortion_model is empty: coefficients are read as those of " +
                            std::string(left_info.D.size() > 5 ? "rational_polynomial" : "plumb_bob"));
    const std::string where = given
                                  ? options_.calibration
                                  : topics_.find(Role::LeftInfo)->name + " and " + topics_.find(Role::RightInfo)->name;
    const StereoTopics topics{left.name, topics_.find(Role::Right)->name,
                              static_cast<urban_nav_core::StampNs>(1e6 * options_.right_delay)};
    calibration_ = std::make_shared<urban_nav_ros::StereoCalibration>(makeCalibration(
        recording_, topics, part_, isRectifiedName(left.name), {left_info, right_info, where}, info_.notes));
    info_.camera = calibration_->camera();
    if (calibration_->rectifies()) info_.notes.push_back("raw images with distortion, rectified on the way");
  }

  void place() {
    urban_nav_ros::StaticTransforms transforms = recording_.transforms();
    giveTransforms(options_.transforms, transforms);
    for (const std::string& given : options_.transforms) info_.notes.push_back("--transform " + given);
    sensors_.add(readerFindings(transforms.faults()));
    sensors_.add(topicFindings(recording_.topicTypes(), topics_));
    if (const std::optional<urban_nav_core::Pose> T_base_optical =
            transforms.lookup(frames::kBaseLink, camera_frame_)) {
      info_.T_base_camera = *T_base_optical * calibration_->T_optical_rectified();
      is_placed_ = true;
    } else {
      info_.T_base_camera = urban_nav_ros::opticalInBody() * calibration_->T_optical_rectified();
      info_.notes.push_back("no static tf from base_link to \"" + camera_frame_ +
                            "\": base_link is taken to be at the left camera (REP-103 axes)");
    }
    const auto imu = topics_.find(Role::Imu) ? first<sensor_msgs::Imu>(topics_.find(Role::Imu)->name) : nullptr;
    const std::optional<urban_nav_core::Pose> T_base_imu =
        imu ? transforms.lookup(frames::kBaseLink, imu->header.frame_id) : std::nullopt;
    if (T_base_imu) R_base_imu_ = T_base_imu->R();
    for (const Role role : {Role::LaserLeft, Role::LaserRight}) {
      const std::optional<ChosenTopic> topic = topics_.find(role);
      const auto scan = topic ? first<sensor_msgs::LaserScan>(topic->name) : nullptr;
      if (!scan) continue;
      if (const auto T_base_laser = transforms.lookup(frames::kBaseLink, scan->header.frame_id)) {
        info_.lasers.push_back({scan->header.frame_id, *T_base_laser});
        laser_topics_.push_back(topic->name);
        sensors_.addLaser(topic->name);
      } else {
        info_.notes.push_back("no static tf from base_link to \"" + scan->header.frame_id + "\": " + topic->name +
                              " is not used");
      }
    }
    panorama_ = BagPanorama(recording_, topics_, transforms);
    info_.panorama = panorama_.cameras();
  }

  /// What is read, and what becomes of it: from the topics and from where the IMU stands.
  void listen() {
    if (R_base_imu_) sensors_.placeImu(*R_base_imu_);
    wheels_.emplace(options_.wheel_noise);
    gyroscope_.emplace(options_.gyro_noise, R_base_imu_.value_or(urban_nav_core::Matrix3d::Identity()));
    names_ = {topics_.find(Role::Left)->name, topics_.find(Role::Right)->name};
    for (const Role role : {Role::Imu, Role::Wheels, Role::Gps})
      if (topics_.find(role)) names_.push_back(topics_.find(role)->name);
    names_.insert(names_.end(), laser_topics_.begin(), laser_topics_.end());
    for (std::string& name : panorama_.topics()) names_.push_back(std::move(name));
  }

  void startReading() {
    const std::vector<std::string> images = {topics_.find(Role::Left)->name, topics_.find(Role::Right)->name};
    StereoFeed::Options feed;
    feed.max_lateness = kMaxLateness;
    const Role motion_role = options_.motion_input == "wheels" ? Role::Wheels : Role::Imu;
    if (options_.motion_input != "none") {
      if (!topics_.find(motion_role))
        throw DataError(name_, "has no topic for input.motion_input = " + options_.motion_input, "");
      feed.motion = true;
    }
    const StampSurvey survey = surveyStamps(recording_, images, part_);
    stamps_are_receipts_ = survey.unset || survey.constant;
    is_sorted_ = survey.needs_sorting;
    if (stamps_are_receipts_) {
      feed.pairing_tolerance = kReceiptTolerance;
      info_.notes.push_back(std::string(survey.unset ? "no header has a stamp" : "all stamps of a topic are equal") +
                            ": the times at which messages were received are used instead");
    }
    if (is_sorted_) info_.notes.push_back("messages lie in another order than their stamps: sorted by stamp");
    if (survey.back > kClockStep)
      info_.notes.push_back("stamps step back by " +
                            urban_nav_core::printNumber(std::round(1e-7 * static_cast<double>(survey.back)) / 100.0) +
                            " s during the recording (a clock was set): images after the step are left out "
                            "until the stamps have caught up");
    feed_.emplace(feed, calibration_);
    listen();
    noteUnused();
    groups_ = groupBags(recording_);
    if (is_sorted_ && groups_.size() > 1) groups_ = asOneGroup(groups_);
    info_.frames += recording_.select(std::vector<std::string>{images.front()}, part_).size();
    MessageSelection stereo = recording_.select(images, part_);
    if (stereo.size() == 0) throw DataError(name_, "holds no images", "");
    std::tie(info_.first, info_.last) =
        stamps_are_receipts_ ? std::make_pair(stereo.first(), stereo.last()) : findStampSpan(stereo);
    expectRange(images);
  }

  void noteUnused() {
    std::set<std::string> used(names_.begin(), names_.end());
    used.insert(options_.read_elsewhere.begin(), options_.read_elsewhere.end());
    for (const auto& [role, topic] : topics_.chosen) used.insert(topic.name);
    const auto leave = [&](Role role, bool is_of_use) {  // it is examined all the same
      if (const auto topic = topics_.find(role); topic && !is_of_use) used.erase(topic->name);
    };
    leave(Role::Wheels, options_.motion_input == "wheels");
    leave(Role::Imu, R_base_imu_ || options_.motion_input == "gyroscope");
    if (std::string sentence = describeUnusedTopics(recording_, used); !sentence.empty())
      info_.notes.push_back(std::move(sentence));
  }

  /// The range of 16-bit images is known before the first of them is decoded.
  void expectRange(const std::vector<std::string>& topics) {
    urban_nav_ros::GreyRange range;
    for (const std::string& topic : topics) {
      RecordedMessages messages = recording_.messages({topic});
      for (std::size_t seen = 0; seen < kDepthSamples; ++seen) {
        const std::optional<RecordedMessage> message = messages.next();
        if (!message) break;
        if (const auto image = message->as<sensor_msgs::Image>()) range.add(*image);
        else if (const auto packed = message->as<sensor_msgs::CompressedImage>()) range.add(*packed);
      }
    }
    range.settle();
    feed_->expectRange(range);
  }

  /// The messages of the next group, if there is one.
  void readGroup() {
    messages_.reset();
    if (group_ < groups_.size())
      messages_ = std::make_unique<BagMessages>(groups_[group_].bags, names_, is_sorted_, part_);
  }

  /// Nothing more comes out of the bags so far until others follow, or it is the end.
  void endGroup() {
    if (group_ < groups_.size()) {
      urban_nav_core::Archive writer;
      archive(writer);
      bag_end_ = std::make_shared<BagEnd>(BagEnd{groups_[group_].end, groups_[group_].receipt,
                                                 urban_nav_core::seal(kBagStateName, kBagStateVersion, writer.take()),
                                                 std::exchange(scans_, {}), std::exchange(panoramas_, {})});
    }
    if (++group_ < groups_.size()) {
      readGroup();
      return;
    }
    feed_->finish();
    panorama_.finish();
    takePanoramas();
    ended_ = true;
  }

  void archive(urban_nav_core::Archive& archive) {
    archive(info_.camera, info_.T_base_camera, R_base_imu_, info_.first);
    for (const Role role : {Role::Left, Role::Right}) archive(topics_.chosen[role].name, topics_.chosen[role].type);
    std::vector<std::pair<std::string, std::pair<std::string, urban_nav_core::Pose>>> lasers;
    for (std::size_t i = 0; i < laser_topics_.size(); ++i)
      lasers.push_back({laser_topics_[i], {info_.lasers[i].frame, info_.lasers[i].T_base_laser}});
    archive(lasers);
    if (archive.isReading() && laser_topics_.empty()) {  // these bags do not say where they stand
      for (const auto& [topic, place] : lasers) {
        laser_topics_.push_back(topic);
        info_.lasers.push_back({place.first, place.second});
        sensors_.addLaser(topic);
      }
    }
    archive(panorama_);
    info_.panorama = panorama_.cameras();
    if (archive.isReading()) listen();
    archive(sensors_, *wheels_, *gyroscope_, *feed_);
  }

  /// After bags that need not exist any more: what stood only in them is taken from the state, and what stands in
  /// both must be the same.
  void resume(const BagEnd& after) {
    const SourceInfo here = info_;
    const BagTopics topics = topics_;
    const std::optional<urban_nav_core::Matrix3d> R_base_imu = R_base_imu_;
    urban_nav_core::Archive reader(urban_nav_core::unseal(kBagStateName, kBagStateVersion, after.reader),
                                   std::string("state of ") + kBagStateName);
    archive(reader);
    reader.finish();
    const auto same = [](const urban_nav_core::Pose& a, const urban_nav_core::Pose& b) {
      return a.q().coeffs() == b.q().coeffs() && a.t() == b.t();
    };
    if (!isApprox(here.camera, info_.camera, 0.0) || (is_placed_ && !same(here.T_base_camera, info_.T_base_camera)) ||
        (R_base_imu && R_base_imu != R_base_imu_))
      throw UserError(name_, "has another calibration than the bags before it", "the same one");
    for (const Role role : {Role::Left, Role::Right})
      if (topics.find(role)->name != topics_.find(role)->name || topics.find(role)->type != topics_.find(role)->type)
        throw UserError(name_, "has other topics than the bags before it", topics_.find(role)->name);
    while (group_ < groups_.size() && groups_[group_].end <= after.bags) ++group_;
    const std::size_t begun = group_ == 0 ? 0 : groups_[group_ - 1].end;
    if (begun != after.bags) throw UserError(name_, "is no end of what was recorded at the same time", "");
    if (after.bags == 0) info_.frames = 0;  // the number in the bags before is unknown
    if (!is_placed_ && !same(here.T_base_camera, info_.T_base_camera)) info_.notes.pop_back();  // they say the place
  }

  void add(const RecordedMessage& instance) {
    const std::string& topic = instance.topic();
    if (topic == topics_.find(Role::Left)->name || topic == topics_.find(Role::Right)->name) {
      const urban_nav_ros::Side side =
          topic == topics_.find(Role::Left)->name ? urban_nav_ros::Side::Left : urban_nav_ros::Side::Right;
      if (const auto image = instance.as<sensor_msgs::Image>()) {
        setStamp(side, instance, image->header);
        feed_->add(side, sensor_msgs::ImageConstPtr(image));
      } else if (const auto compressed = instance.as<sensor_msgs::CompressedImage>()) {
        setStamp(side, instance, compressed->header);
        feed_->add(side, sensor_msgs::CompressedImageConstPtr(compressed));
      }
    } else if (const auto odometry = instance.as<nav_msgs::Odometry>()) {
      sensors_.add(*odometry, topic, instance.receipt());
      if (options_.motion_input != "wheels") return;
      if (const auto motion = wheels_->add(*odometry)) feed_->add(*motion);
    } else if (const auto imu = instance.as<sensor_msgs::Imu>()) {
      sensors_.add(*imu, topic, instance.receipt());
      if (const auto motion = gyroscope_->add(*imu); motion && options_.motion_input == "gyroscope")
        feed_->add(*motion);
    } else if (const auto scan = instance.as<sensor_msgs::LaserScan>()) {
      add(instance, *scan);
    } else if (const auto fix = instance.as<sensor_msgs::NavSatFix>()) {
      sensors_.add(*fix);
    } else if (panorama_.add(instance)) {
      takePanoramas();
    }
  }

  /// Puts right what is known to be wrong with an image's stamp, and remembers the first stamps of each side.
  void setStamp(urban_nav_ros::Side side, const RecordedMessage& instance, std_msgs::Header& header) {
    constexpr std::size_t kRemembered = 400;
    const bool is_right = side == urban_nav_ros::Side::Right;
    if (!is_right)
      sensors_.addImage(instance.topic(), urban_nav_ros::toStampNs(header.stamp), instance.receipt());
    if (stamps_are_receipts_) header.stamp = urban_nav_ros::toRosTime(instance.receipt());
    if (is_right && options_.right_delay != 0.0)
      header.stamp = urban_nav_ros::toRosTime(urban_nav_ros::toStampNs(header.stamp) -
                                              static_cast<urban_nav_core::StampNs>(1e6 * options_.right_delay));
    std::vector<urban_nav_core::StampNs>& stamps = image_stamps_[is_right ? 1 : 0];
    if (stamps.size() < kRemembered) stamps.push_back(urban_nav_ros::toStampNs(header.stamp));
  }

  void takePanoramas() {
    for (urban_nav_ros::Panorama& panorama : panorama_.take()) panoramas_.push_back(std::move(panorama));
  }

  void add(const RecordedMessage& instance, const sensor_msgs::LaserScan& message) {
    const std::string& topic = instance.topic();
    const auto laser =
        static_cast<std::size_t>(std::find(laser_topics_.begin(), laser_topics_.end(), topic) - laser_topics_.begin());
    if (const auto planar = sensors_.read(laser, message, instance.receipt()))
      scans_.push_back({laser, urban_nav_core::toScan(*planar)});
  }

  const SourceOptions options_;
  const ReceiptRange part_;
  const std::string name_;
  Recording recording_;
  BagTopics topics_;
  SourceInfo info_;
  std::string camera_frame_;
  std::shared_ptr<const urban_nav_ros::StereoCalibration> calibration_;
  std::optional<urban_nav_ros::WheelMotion> wheels_;
  std::optional<urban_nav_ros::GyroMotion> gyroscope_;
  std::optional<urban_nav_core::Matrix3d> R_base_imu_;
  std::vector<std::string> laser_topics_;  // in the order of info_.lasers
  BagSensors sensors_{options_, topics_};
  std::vector<LaserInput> scans_;  // since the pair or end of a bag before
  BagPanorama panorama_;
  std::vector<urban_nav_ros::Panorama> panoramas_;  // since the pair or end of a bag before
  std::optional<StereoFeed> feed_;
  bool is_placed_ = false;          // the bags say where the camera stands
  std::vector<std::string> names_;  // of the topics that are read
  std::vector<BagGroup> groups_;
  std::size_t group_ = 0;  // at work
  std::shared_ptr<const BagEnd> bag_end_;
  std::unique_ptr<BagMessages> messages_;  // of the group
  bool is_sorted_ = false;                 // by stamp, else messages come as they were received
  bool stamps_are_receipts_ = false;
  std::array<std::vector<urban_nav_core::StampNs>, 2> image_stamps_;  // left, right: the first of them
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<Source> openBags(const std::vector<std::string>& paths, const SourceOptions& options,
                                 const BagEnd* after, const ReceiptRange& part) {
  return std::make_unique<BagSource>(paths, options, after, part);
}

}  // namespace urban_nav_input
