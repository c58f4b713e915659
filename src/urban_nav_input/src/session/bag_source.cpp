// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>

#include "recording/bag_groups.hpp"
#include "recording/bag_order.hpp"
#include "session/bag_calibration.hpp"
#include "session/bag_cameras.hpp"
#include "session/bag_colour.hpp"
#include "session/bag_continuation.hpp"
#include "session/bag_depth.hpp"
#include "session/bag_images.hpp"
#include "session/bag_inputs.hpp"
#include "session/bag_sensors.hpp"
#include "session/bag_sweeps.hpp"
#include "session/given_transforms.hpp"
#include "session/moved_sweeps.hpp"
#include "session/planar_laser.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/sensors/pairing_examination.hpp"
#include "urban_nav_input/sensors/place_finding.hpp"
#include "urban_nav_input/sensors/topic_examination.hpp"
#include "urban_nav_input/session/bag_panorama.hpp"
#include "urban_nav_input/session/calibration_file.hpp"
#include "urban_nav_input/session/grey_survey.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/planar_clouds.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace frames = urban_nav_core::frames;

using urban_nav_core::CameraInfo;
using urban_nav_core::DataError;
using urban_nav_core::UserError;
using urban_nav_ros::RecordedImage;
using urban_nav_ros::StereoFeed;

namespace {

constexpr urban_nav_core::StampNs kMaxLateness = 200'000'000;  // ns, of messages of one topic
constexpr urban_nav_core::StampNs kLongestWait =
    1'000'000'000;  // ns, for a topic whose stamps are earlier than those of the images
constexpr const char* kBagStateName = "reader of bags";
constexpr std::uint32_t kBagStateVersion = 14;
constexpr urban_nav_core::StampNs kReceiptTolerance =
    25'000'000;                         // ns: images of a pair are received one after another
constexpr std::size_t kMostSweeps = 4;  // waiting for a pair

/// The bags of one recording, read as one stream in the order of receipt, which the feed sorts by stamps.
class BagSource : public Source {
 public:
  BagSource(const std::vector<std::string>& paths, const SourceOptions& options, const BagEnd* after,
            const ReceiptRange& part)
      : options_(options), part_(part), name_(paths.front()), convention_(options.pairing), recording_(paths) {
    topics_ = chooseTopics(recording_.topicTypes(), options.topics);
    planar_clouds_ = PlanarClouds(recording_, part_, options.topics, topics_);
    info_.has_images = topics_.find(Role::Left) && topics_.find(Role::Right);
    const bool has_sweeps = options.with_sweeps && topics_.find(Role::Points0);
    if (!info_.has_images && !has_sweeps && !(mayUsePlanarLaser() && hasLaser(topics_)))
      throw DataError(name_, describeNoImages(recording_, topics_, planar_clouds_.findings()), "");
    motion_ = chooseMotion(topics_, options.motion_input, name_);
    info_.name = name_ + (paths.size() > 1 ? " and " + std::to_string(paths.size() - 1) + " more" : "");
    info_.kind = "bag";
    info_.notes = topics_.notes;
    info_.right_delay = options.pairing.right_delay;
    for (const Role role : {Role::Left, Role::Right, Role::LeftInfo, Role::RightInfo})
      if (const auto topic = topics_.find(role)) info_.topics.emplace_back(toString(role), topic->name);
    if (info_.has_images) calibrate();
    place();
    info_.inputs = describeInputs(recording_, topics_, sweeps_in_bag_.streams());
    startReading();
    if (after != nullptr) resume(*after);
    readGroup();
  }

  const SourceInfo& info() const override { return info_; }
  std::optional<SourceItem> next() override {
    while (true) {
      if (feed_)
        if (std::optional<urban_nav_ros::DecodedPair> pair = feed_->take()) return makeItem(std::move(*pair), true);
      if (sweeps_.size() >= (info_.has_images ? kMostSweeps : 1)) return makeItem({}, false);
      if (ended_) return std::nullopt;
      if (const RecordedMessage* message = messages_ ? messages_->next() : nullptr) add(*message);
      else endGroup();
    }
  }

  std::vector<LaserInput> scans() const override { return scans_; }
  std::vector<SweepInput> sweeps() const override { return sweeps_; }
  std::vector<DepthInput> depths() const override { return depth_.pending(); }
  std::vector<ColourInput> colours() const override { return colour_.pending(); }
  std::vector<urban_nav_ros::Panorama> panoramas() const override { return panoramas_; }
  std::vector<urban_nav_core::SpecificForce> forces() const override { return sensors_.forces(); }
  std::vector<Finding> sensorFindings() const override {
    using urban_nav_ros::Side;
    std::vector<Finding> findings;
    if (feed_)
      findings = pairing_.findings({{topics_.find(Role::Left)->name, topics_.find(Role::Right)->name}},
                                   {{feed_->missing(Side::Left), feed_->missing(Side::Right)}}, convention_);
    for (Finding& finding : sensors_.findings()) findings.push_back(std::move(finding));
    for (Finding& finding : sweeps_in_bag_.findings()) findings.push_back(std::move(finding));
    return findings;
  }
  std::vector<Finding> sightFindings(const Sight& sight, double stereo_scale) const override {
    return sensors_.sightFindings(sight, stereo_scale, is_placed_);
  }
  std::shared_ptr<const BagEnd> bagEnd() const override { return bag_end_; }

  std::vector<std::string> closingFaults() const override {
    std::vector<std::string> faults = feed_ ? droppedMessages(*feed_, topics_) : std::vector<std::string>();
    for (std::string& fault : panorama_.faults()) faults.push_back(std::move(fault));
    for (std::string& warning : recording_.warnings()) faults.push_back(std::move(warning));
    return faults;
  }

 private:
  SourceItem makeItem(urban_nav_ros::DecodedPair pair, bool has_pair) {
    SourceItem item(std::move(pair));
    item.has_pair = has_pair;
    item.bag_end = std::exchange(bag_end_, nullptr);
    item.scans = std::exchange(scans_, {});
    item.panoramas = std::exchange(panoramas_, {});
    item.sweeps = std::exchange(sweeps_, {});
    item.depths = depth_.take();
    item.colours = colour_.take();
    return item;
  }

  /// Returns whether scans of a planar laser are read as sweeps, if there is a horizontal one.
  bool mayUsePlanarLaser() const {
    return options_.with_sweeps && !topics_.find(Role::Points0) && (!info_.has_images || options_.with_planar_sweeps);
  }

  void calibrate() {
    const ChosenTopic left = *topics_.find(Role::Left);
    const FirstImage seen = findFirstImage(recording_, left);
    camera_frame_ = seen.frame;
    const bool given = !options_.calibration.empty();
    CameraInfo left_info, right_info;
    if (given) {
      std::tie(left_info, right_info) = readCalibration(options_.calibration, seen.width, seen.height);
    } else {
      const CameraInfos infos = readCameraInfos(recording_, topics_, name_);
      std::tie(left_info, right_info) = std::tie(infos.left, infos.right);
      if (!infos.frame.empty()) camera_frame_ = infos.frame;
    }
    scaleBaseline(options_.baseline_scale, left_info, right_info);
    left_info_ = left_info;
    noteDistortionModel(left_info, info_.notes);
    const std::string where = given
                                  ? options_.calibration
                                  : topics_.find(Role::LeftInfo)->name + " and " + topics_.find(Role::RightInfo)->name;
    const StereoTopics topics{left.name, topics_.find(Role::Right)->name, convention_};
    calibration_ = std::make_shared<urban_nav_ros::StereoCalibration>(makeCalibration(
        recording_, topics, part_, isRectifiedName(left.name), {left_info, right_info, where}, info_.notes));
    info_.camera = calibration_->camera();
    if (calibration_->rectifies()) info_.notes.push_back("raw images with distortion, rectified on the way");
  }

  void placeCamera(const urban_nav_ros::StaticTransforms& transforms) {
    if (const std::optional<urban_nav_core::Pose> T_base_optical =
            transforms.lookup(frames::kBaseLink, camera_frame_)) {
      sensors_.add(placeFindings(camera_frame_, *T_base_optical));
      info_.T_base_camera = *T_base_optical * calibration_->T_optical_rectified();
      is_placed_ = true;
      return;
    }
    info_.T_base_camera = urban_nav_ros::opticalInBody() * calibration_->T_optical_rectified();
    info_.notes.push_back(describeAssumedPlace(camera_frame_));
  }

  void place() {
    urban_nav_ros::StaticTransforms transforms = recording_.transforms();
    for (std::string& sentence : giveTransforms(options_.transforms, transforms))
      info_.notes.push_back(std::move(sentence));
    sensors_.add(readerFindings(transforms.faults()));
    sensors_.add(topicFindings(recording_.topicTypes(), topics_));
    sensors_.add(planar_clouds_.findings());
    if (info_.has_images) placeCamera(transforms);
    if (options_.with_sweeps)
      sweeps_in_bag_ = BagSweeps(recording_, topics_, transforms, options_.points, part_, info_.has_images);
    info_.notes.insert(info_.notes.end(), sweeps_in_bag_.notes().begin(), sweeps_in_bag_.notes().end());
    if (!info_.has_images && sweeps_in_bag_.empty() && !mayUsePlanarLaser())
      throw DataError(name_, "has no images, and no sweep that can be used: " + sweeps_in_bag_.notes().back(), "");
    const auto imu =
        topics_.find(Role::Imu) ? recording_.first<sensor_msgs::Imu>(topics_.find(Role::Imu)->name) : nullptr;
    const std::optional<urban_nav_core::Pose> T_base_imu =
        imu ? transforms.lookup(frames::kBaseLink, imu->header.frame_id) : std::nullopt;
    if (T_base_imu) R_base_imu_ = T_base_imu->R();
    else if (imu)
      info_.notes.push_back("no static tf from base_link to \"" + imu->header.frame_id + "\": the axes of " +
                            topics_.find(Role::Imu)->name +
                            " are assumed to be those of base_link for its gyroscope; its accelerometer is not used");
    placeLasers(transforms);
    panorama_ = BagPanorama(recording_, topics_, transforms);
    info_.panorama = panorama_.cameras();
    if (options_.with_depth) depth_ = BagDepth(recording_, topics_, transforms);
    info_.depth_cameras = depth_.cameras();
    info_.notes.insert(info_.notes.end(), depth_.notes().begin(), depth_.notes().end());
    if (options_.with_colour) colour_ = BagColour(recording_, topics_, transforms, leftCamera());
    info_.colour_cameras = colour_.cameras();
    info_.notes.insert(info_.notes.end(), colour_.notes().begin(), colour_.notes().end());
  }

  std::optional<LeftCamera> leftCamera() const {
    if (!info_.has_images) return std::nullopt;
    return LeftCamera{left_info_, info_.T_base_camera * calibration_->T_optical_rectified().inverse()};
  }

  void placeLasers(const urban_nav_ros::StaticTransforms& transforms) {
    const bool is_alone = mayUsePlanarLaser() && !info_.has_images;
    const PlacedLasers placed = PlacedLasers::find(recording_, topics_, planar_clouds_, transforms, is_alone);
    info_.notes.insert(info_.notes.end(), placed.notes.begin(), placed.notes.end());
    sensors_.add(sideFindings(placed, topics_));
    for (const PlacedLaser& laser : placed.lasers) {
      info_.lasers.push_back({laser.frame, laser.T_base_laser});
      laser_topics_.push_back(laser.topic);
      sensors_.addLaser(laser.topic, laser.frame, laser.T_base_laser);
      sensors_.add(placeFindings(laser.frame, laser.T_base_laser));
    }
    if (!mayUsePlanarLaser()) return;
    planar_laser_ = PlanarLaser::choose(placed);
    if (planar_laser_) {
      info_.planar_role = planar_laser_->role();
      info_.notes.push_back(planar_laser_->note());
    } else if (is_alone) {
      throw DataError(name_, PlanarLaser::describeFailure(placed, planar_clouds_.findings()), "");
    }
  }

  /// Selects the sensors to read, from the topics and the extrinsics of the IMU.
  void listen() {
    if (R_base_imu_) sensors_.placeImu(*R_base_imu_);
    wheels_.emplace(options_.wheel_noise);
    gyroscope_.emplace(options_.gyro_noise, R_base_imu_.value_or(urban_nav_core::Matrix3d::Identity()));
    names_ = info_.has_images ? imageTopics(topics_) : std::vector<std::string>();
    for (const Role role : {Role::Imu, Role::Wheels, Role::Gps})
      if (topics_.find(role)) names_.push_back(topics_.find(role)->name);
    for (const auto& names : {laser_topics_, panorama_.topics(), sweeps_in_bag_.topics(), colour_.topics()})
      names_.insert(names_.end(), names.begin(), names.end());
    for (const DepthCamera& camera : depth_.cameras()) names_.push_back(camera.topic);
  }

  /// Returns the topics whose stamps are those of the frames, or of the sweeps without images.
  std::vector<std::string> leadingTopics() const {
    if (info_.has_images) return imageTopics(topics_);
    if (planar_laser_) return {planar_laser_->topic()};
    return sweeps_in_bag_.topics();
  }

  void startReading() {
    const std::vector<std::string> leading = leadingTopics();
    StereoFeed::Options feed;
    feed.max_lateness = kMaxLateness;
    feed.longest_wait = kLongestWait;
    feed.motion = motion_;
    surveyOrder(leading);
    feed.pairing_tolerance = convention_.tolerance;
    if (info_.has_images) feed_.emplace(feed, calibration_);
    moved_sweeps_.expect({kMaxLateness, kLongestWait, urban_nav_core::DeliveryOrder::Shuffled, motion_});
    listen();
    const UsedTopics used{names_, options_.read_elsewhere, sweeps_in_bag_.topics(), motion_, R_base_imu_.has_value()};
    if (std::string sentence = describeUnused(recording_, topics_, planar_clouds_, used); !sentence.empty())
      info_.notes.push_back(std::move(sentence));
    groups_ = groupBags(recording_);
    if (is_sorted_ && groups_.size() > 1) groups_ = asOneGroup(groups_);
    MessageSelection frames = recording_.select(leading, part_);
    info_.frames +=
        info_.has_images ? recording_.select(std::vector<std::string>{leading.front()}, part_).size() : frames.size();
    if (frames.size() == 0)
      throw DataError(name_, info_.has_images ? "holds no images" : "holds no clouds or scans", "");
    std::tie(info_.first, info_.last) =
        stamps_are_receipts_ ? std::make_pair(frames.first(), frames.last()) : findStampSpan(frames);
    if (info_.has_images) feed_->expectRange(surveyGreyRange(recording_, leading));
  }

  /// Determines the order in which messages are read, by the topics of images, or of clouds without images.
  void surveyOrder(const std::vector<std::string>& leading) {
    const StampSurvey survey = surveyStamps(recording_, leading, part_);
    stamps_are_receipts_ = survey.unset || survey.constant;
    is_sorted_ = survey.needs_sorting;
    if (info_.has_images && !sweeps_in_bag_.empty())
      is_sorted_ = is_sorted_ || surveyStamps(recording_, sweeps_in_bag_.topics(), part_).needs_sorting;
    if (stamps_are_receipts_) convention_.tolerance = std::max(convention_.tolerance, kReceiptTolerance);
    for (std::string& note : describeOrder(survey, is_sorted_)) info_.notes.push_back(std::move(note));
  }

  /// Opens the messages of the next group, if there is one.
  void readGroup() {
    messages_.reset();
    if (group_ < groups_.size())
      messages_ = std::make_unique<BagMessages>(groups_[group_].bags, names_, is_sorted_, part_);
  }

  /// Ends a group: all pending items of the bags so far are complete.
  void endGroup() {
    sweeps_in_bag_.flush();
    takeSweeps();
    if (group_ < groups_.size()) {
      urban_nav_core::Archive writer;
      archive(writer);
      bag_end_ = std::make_shared<BagEnd>(BagEnd{groups_[group_].end, groups_[group_].receipt,
                                                 urban_nav_core::seal(kBagStateName, kBagStateVersion, writer.take()),
                                                 std::exchange(scans_, {}), std::exchange(panoramas_, {}),
                                                 std::exchange(sweeps_, {}), depth_.take(), colour_.take()});
    }
    if (++group_ < groups_.size()) {
      readGroup();
      return;
    }
    if (feed_) feed_->finish();
    moved_sweeps_.finish();
    takeSweeps();
    panorama_.finish();
    takePanoramas();
    ended_ = true;
  }

  void archive(urban_nav_core::Archive& archive) {
    bool has_images = info_.has_images, has_planar_laser = planar_laser_.has_value();
    archive(has_images);
    archive.require(has_images == info_.has_images, "images in all bags, or in none");
    if (has_images) {
      archive(info_.camera, info_.T_base_camera);
      for (const Role role : {Role::Left, Role::Right}) archive(topics_.chosen[role].name, topics_.chosen[role].type);
    }
    archive(R_base_imu_, info_.first);
    std::vector<std::pair<std::string, std::pair<std::string, urban_nav_core::Pose>>> lasers;
    for (std::size_t i = 0; i < laser_topics_.size(); ++i)
      lasers.push_back({laser_topics_[i], {info_.lasers[i].frame, info_.lasers[i].T_base_laser}});
    archive(lasers);
    if (archive.isReading() && laser_topics_.empty()) {  // these bags have no extrinsics
      for (const auto& [topic, place] : lasers) {
        laser_topics_.push_back(topic);
        info_.lasers.push_back({place.first, place.second});
        sensors_.addLaser(topic, place.first, place.second);
      }
    }
    archive(panorama_, sweeps_in_bag_, moved_sweeps_, depth_, colour_, has_planar_laser);
    archive.require(has_planar_laser == planar_laser_.has_value(), "a horizontal planar laser in all bags, or in none");
    if (planar_laser_) archive(*planar_laser_);
    info_.panorama = panorama_.cameras();
    info_.depth_cameras = depth_.cameras();
    info_.colour_cameras = colour_.cameras();
    if (archive.isReading()) listen();
    archive(sensors_, *wheels_, *gyroscope_);
    if (feed_) archive(*feed_);
  }

  /// Continues after previous bags, which need not exist any more: restores their data from the state, and checks that
  /// common data are equal.
  void resume(const BagEnd& after) {
    const SourceInfo here = info_;
    const BagTopics topics = topics_;
    const std::optional<urban_nav_core::Matrix3d> R_base_imu = R_base_imu_;
    urban_nav_core::Archive reader(urban_nav_core::unseal(kBagStateName, kBagStateVersion, after.reader),
                                   std::string("state of ") + kBagStateName);
    archive(reader);
    reader.finish();
    requireSameCameras(name_, {here, topics, is_placed_}, {info_, topics_, true});
    if (R_base_imu && R_base_imu != R_base_imu_) throw differentCalibration(name_);
    while (group_ < groups_.size() && groups_[group_].end <= after.bags) ++group_;
    const std::size_t begun = group_ == 0 ? 0 : groups_[group_ - 1].end;
    if (begun != after.bags) throw UserError(name_, "is not the last bag of those recorded at the same time", "");
    if (after.bags == 0) info_.frames = 0;  // the number in the bags before is unknown
    if (info_.has_images && !is_placed_ && !isSamePose(here.T_base_camera, info_.T_base_camera))
      info_.notes.erase(std::find(info_.notes.begin(), info_.notes.end(), describeAssumedPlace(camera_frame_)));
    info_.inputs = describeInputs(recording_, topics_, sweeps_in_bag_.streams());
  }

  void add(const RecordedMessage& instance) {
    const std::string& topic = instance.topic();
    if (sweeps_in_bag_.add(instance)) {
      if (const auto reference = sweeps_in_bag_.lastReference())
        sensors_.addSweep(instance.topic(), *reference, instance.receipt());
      takeSweeps();
    } else if (info_.has_images &&
               (topic == topics_.find(Role::Left)->name || topic == topics_.find(Role::Right)->name)) {
      const urban_nav_ros::Side side =
          topic == topics_.find(Role::Left)->name ? urban_nav_ros::Side::Left : urban_nav_ros::Side::Right;
      if (const auto image = instance.as<sensor_msgs::Image>()) addImage(side, instance, image);
      else if (const auto compressed = instance.as<sensor_msgs::CompressedImage>())
        addImage(side, instance, compressed);
    } else if (const auto odometry = instance.as<nav_msgs::Odometry>()) {
      if (!sensors_.add(*odometry, topic, instance.receipt()) || !motion_.wheels) return;
      if (const auto motion = wheels_->add(*odometry)) add(*motion);
    } else if (const auto imu = instance.as<sensor_msgs::Imu>()) {
      if (!sensors_.add(*imu, topic, instance.receipt())) return;
      if (const auto motion = gyroscope_->add(*imu); motion && motion_.gyroscope) add(*motion);
    } else if (const auto scan = planar_clouds_.read(instance)) {
      add(instance, *scan);
    } else if (const auto fix = instance.as<sensor_msgs::NavSatFix>()) {
      sensors_.add(*fix, topic, instance.receipt());
    } else if (!depth_.add(instance) && !colour_.add(instance) && panorama_.add(instance)) {
      takePanoramas();
    }
  }

  template <typename MessagePtr>
  void addImage(urban_nav_ros::Side side, const RecordedMessage& instance, const MessagePtr& image) {
    setStamp(side, instance, image->header);
    using ConstPtr = boost::shared_ptr<const typename MessagePtr::element_type>;
    feed_->add(side, ConstPtr(image));
    if (side == urban_nav_ros::Side::Left) colour_.addLeft(RecordedImage(ConstPtr(image)));
  }

  /// Corrects known errors of the stamp of an image.
  void setStamp(urban_nav_ros::Side side, const RecordedMessage& instance, std_msgs::Header& header) {
    const bool is_right = side == urban_nav_ros::Side::Right;
    if (!is_right) sensors_.addImage(instance.topic(), urban_nav_ros::toStampNs(header.stamp), instance.receipt());
    if (stamps_are_receipts_) header.stamp = urban_nav_ros::toRosTime(instance.receipt());
    const urban_nav_core::StampNs stamp = urban_nav_ros::toStampNs(header.stamp);
    pairing_.add(is_right ? 1 : 0, stamp);
    if (is_right && convention_.right_delay != 0)
      header.stamp = urban_nav_ros::toRosTime(stamp - convention_.right_delay);
  }

  void add(const urban_nav_core::MotionInput& input) {
    if (feed_) feed_->add(input);
    moved_sweeps_.add(input);
    takeSweeps();
  }

  void takeSweeps() {
    moved_sweeps_.add(sweeps_in_bag_.take());
    for (auto& sweep : moved_sweeps_.take()) sweeps_.push_back(std::move(sweep));
  }
  void takePanoramas() {
    for (auto& panorama : panorama_.take()) panoramas_.push_back(std::move(panorama));
  }

  void add(const RecordedMessage& instance, const sensor_msgs::LaserScan& message) {
    const std::string& topic = instance.topic();
    const auto laser =
        static_cast<std::size_t>(std::find(laser_topics_.begin(), laser_topics_.end(), topic) - laser_topics_.begin());
    const auto planar = sensors_.read(laser, message, instance.receipt());
    if (!planar) return;
    scans_.push_back({laser, urban_nav_core::toScan(*planar)});
    if (!planar_laser_ || planar_laser_->topic() != topic) return;
    moved_sweeps_.add({planar_laser_->read(*planar)});
    takeSweeps();
  }

  const SourceOptions options_;
  const ReceiptRange part_;
  const std::string name_;
  PairingConvention convention_;
  Recording recording_;
  BagTopics topics_;
  PlanarClouds planar_clouds_;
  SourceInfo info_;
  std::string camera_frame_;
  std::shared_ptr<const urban_nav_ros::StereoCalibration> calibration_;
  urban_nav_core::MotionChoice motion_;
  std::optional<urban_nav_ros::WheelMotion> wheels_;
  std::optional<urban_nav_ros::GyroMotion> gyroscope_;
  std::optional<urban_nav_core::Matrix3d> R_base_imu_;
  std::vector<std::string> laser_topics_;  // in the order of info_.lasers
  BagSensors sensors_{options_, topics_};
  std::vector<LaserInput> scans_;  // since the previous pair or end of a bag
  BagPanorama panorama_;
  std::vector<urban_nav_ros::Panorama> panoramas_;  // since the previous pair or end of a bag
  BagSweeps sweeps_in_bag_;
  BagDepth depth_;
  BagColour colour_;
  CameraInfo left_info_;                     // with images
  std::optional<PlanarLaser> planar_laser_;  // read as sweeps
  MovedSweeps moved_sweeps_;
  std::vector<SweepInput> sweeps_;  // since the previous item or end of a bag
  std::optional<StereoFeed> feed_;  // with images
  bool is_placed_ = false;          // the bags have the extrinsics of the camera
  std::vector<std::string> names_;  // of the read topics
  std::vector<BagGroup> groups_;
  std::size_t group_ = 0;  // current group
  std::shared_ptr<const BagEnd> bag_end_;
  std::unique_ptr<BagMessages> messages_;  // of the group
  bool is_sorted_ = false;                 // by stamp, else in the order of receipt
  bool stamps_are_receipts_ = false;
  PairingExamination pairing_;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<Source> openBags(const std::vector<std::string>& paths, const SourceOptions& options,
                                 const BagEnd* after, const ReceiptRange& part) {
  return std::make_unique<BagSource>(paths, options, after, part);
}

}  // namespace urban_nav_input
