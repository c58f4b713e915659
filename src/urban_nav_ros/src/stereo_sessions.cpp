// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_sessions.hpp"

#include <cmath>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::StampNs;

namespace {

StampNs toNanoseconds(double seconds) { return static_cast<StampNs>(std::llround(seconds * 1e9)); }

}  // namespace

bool isSameCalibration(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  return a.width == b.width && a.height == b.height && a.D == b.D && a.K == b.K && a.R == b.R && a.P == b.P;
}

std::string StereoSessions::Camera::sentence() const {
  return std::to_string(camera.left.width) + "x" + std::to_string(camera.left.height) + " px, " +
         (rectifies ? "rectified here" : "rectified already") + "; " + mounting +
         (contradiction.empty() ? "" : "; " + contradiction);
}

void StereoSessions::Counts::addTo(urban_nav_live::StageReport& report) const {
  report.add("stereo pairs", pairs);
  report.add("dropped: before a session", dropped);
  report.add("dropped: too late", late);
  report.add("dropped: duplicate", duplicate);
  report.add("dropped: IMU or wheels too late", motion_late);
  report.add("left images missing", left_missing);
  report.add("right images missing", right_missing);
  report.add("images damaged", damaged);
  report.add("images rectified", rectified);
  report.add("missing pairs", gaps);
  report.fault_counts.push_back({"pairs were missing", gaps, pairs + gaps,
                                 "the camera, its connection or the recording loses them; check its driver, the "
                                 "load of this computer and the network"});
  report.fault_counts.push_back({"pairs lacked an image", left_missing + right_missing, pairs,
                                 "one camera loses images, they arrive later than max_lateness, or the two are stamped "
                                 "at different times: set input/right_delay, which stereo_rectify reads, or a wider "
                                 "sync_tolerance (`urban_nav doctor` on a recording states which)"});
  report.fault_counts.push_back({"images arrived too late", late, 2 * pairs, "raise max_lateness, or lower the load"});
  report.fault_counts.push_back({"messages of IMU or wheels arrived too late", motion_late, motion_inputs,
                                 "their stamps are earlier than those of the images: synchronise the clocks, set "
                                 "input/imu_delay or input/wheels_delay (`urban_nav doctor` on a recording states "
                                 "which), or raise max_lateness"});
  report.fault_counts.push_back(
      {"images were damaged", damaged, 2 * pairs, "check the encoding, the size in camera_info and the connection"});
}

void StereoSessions::handle(const Message& message) {
  if (const auto* info = std::get_if<InfoInput>(&message)) handleInfo(*info);
  else if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&message)) {
    transforms_.add(**transforms);
    followPlaces();
  } else sortByRound(message);
  if (!feed_) tryToBegin();
  if (feed_) deliverPairs();
}

StereoSessions::Places StereoSessions::findPlaces() const {
  Places places;
  if (left_info_) places.T_base_camera = transforms_.lookup(options_.base_frame, left_info_->header.frame_id);
  if (options_.motion.gyroscope) places.T_base_imu = transforms_.lookup(options_.base_frame, imu_frame_);
  return places;
}

void StereoSessions::followPlaces() {
  if (!feed_) return;
  const Places now = findPlaces();
  const auto differs = [](const auto& known, const auto& then) {
    return known && (!then || !isApprox(*known, *then, 1e-9));
  };
  if (differs(now.T_base_camera, places_.T_base_camera))
    end(places_.T_base_camera ? "the mounting of the camera changed" : "the mounting of the camera was received");
  else if (differs(now.T_base_imu, places_.T_base_imu))
    end(places_.T_base_imu ? "the mounting of the gyroscope changed" : "the mounting of the gyroscope was received");
}

void StereoSessions::idle() {
  if (!feed_) tryToBegin();
}

void StereoSessions::handleInfo(const InfoInput& info) {
  sensor_msgs::CameraInfoConstPtr& known = info.side == Side::Left ? left_info_ : right_info_;
  if (known && isSameCalibration(*known, *info.message)) return;
  if (feed_) end("the calibration changed");
  // A new left camera does not match the old right one: wait for the other camera_info.
  if (known) {
    (info.side == Side::Left ? right_info_ : left_info_).reset();
    judge_.reset();
  }
  known = info.message;
  setFault("");
}

void StereoSessions::setFault(const std::string& fault) {
  if (fault == fault_) return;
  fault_ = fault;
  if (listener_.refused) listener_.refused(fault);
}

void StereoSessions::sortByRound(const Message& message) {
  if (const auto* image = std::get_if<ImageInput>(&message))
    return rounds_.add(image->side == Side::Left ? kLeftStream : kRightStream, image->stamp, message);
  if (const auto* odometry = std::get_if<nav_msgs::OdometryConstPtr>(&message))
    return rounds_.add(kWheelStream, toStampNs((*odometry)->header.stamp), message);
  rounds_.add(kGyroStream, toStampNs(std::get<sensor_msgs::ImuConstPtr>(message)->header.stamp), message);
}

void StereoSessions::goBack() {
  goes_back_ = true;
  end("time went back");
  if (std::exchange(goes_back_, false) && listener_.went_back) listener_.went_back();
}

void StereoSessions::handleSensor(const Message& message) {
  if (const auto* image = std::get_if<ImageInput>(&message)) {
    if (!first_image_) first_image_ = Clock::now();
    judge_.add(*image);
  }
  if (const auto* imu = std::get_if<sensor_msgs::ImuConstPtr>(&message)) imu_frame_ = (*imu)->header.frame_id;
  if (feed_) return feed(message);
  wait(message);
}

// Only images are counted, because motion sensors have higher rates; messages before the oldest image are dropped.
void StereoSessions::wait(const Message& message) {
  constexpr std::size_t kMostPerImage = 50;
  const auto isImage = [](const Message& each) { return std::holds_alternative<ImageInput>(each); };
  waiting_.push_back(message);
  if (isImage(message)) ++waiting_images_;
  const auto most = static_cast<std::size_t>(options_.queue_size);
  while (waiting_images_ > options_.queue_size || waiting_.size() > kMostPerImage * most) {
    if (isImage(waiting_.front())) {
      --waiting_images_;
      ++finished_.dropped;
    }
    waiting_.pop_front();
  }
}

void StereoSessions::feed(const Message& message) {
  if (const auto* image = std::get_if<ImageInput>(&message)) {
    std::visit([&](const auto& pixels) { feed_->add(image->side, pixels); }, image->message);
  } else if (const auto* odometry = std::get_if<nav_msgs::OdometryConstPtr>(&message)) {
    if (const auto motion = wheels_->add(**odometry)) feed(*motion);
  } else if (const auto motion = gyroscope_->add(*std::get<sensor_msgs::ImuConstPtr>(message))) {
    feed(*motion);
  }
}

void StereoSessions::feed(const urban_nav_core::MotionInput& motion) {
  feed_->add(motion);
  if (listener_.motion) listener_.motion(motion);
}

void StereoSessions::tryToBegin() {
  if (!first_image_ || !left_info_ || !right_info_ || !fault_.empty()) return;
  const bool placed = transforms_.lookup(options_.base_frame, left_info_->header.frame_id).has_value();
  if (!placed && Clock::now() - *first_image_ < std::chrono::duration<double>(options_.tf_timeout)) return;
  const bool must_decide = waiting_images_ + 1 >= options_.queue_size;
  try {
    const std::optional<bool> are_rectified =
        judge_.decide(toCameraInfo(*left_info_), toCameraInfo(*right_info_), options_.where, must_decide);
    if (are_rectified) begin(*are_rectified);
  } catch (const urban_nav_core::Error& error) {
    setFault(error.what());
  }
}

void StereoSessions::begin(bool are_rectified) {
  const auto calibration = std::make_shared<StereoCalibration>(toCameraInfo(*left_info_), toCameraInfo(*right_info_),
                                                               are_rectified, options_.where);
  StereoFeed::Options options;
  options.max_lateness = toNanoseconds(options_.max_lateness);
  options.pairing_tolerance = toNanoseconds(options_.sync_tolerance);
  options.delivery = urban_nav_core::DeliveryOrder::OrderedStreams;
  options.motion = options_.motion;

  Camera camera;
  camera.camera = calibration->camera();
  camera.frame = left_info_->header.frame_id;
  camera.rectifies = calibration->rectifies();
  camera.contradiction = judge_.contradiction();
  places_ = findPlaces();
  const auto& T_base_camera = places_.T_base_camera;
  camera.is_mounting_known = T_base_camera.has_value();
  camera.T_base_left = T_base_camera.value_or(opticalInBody()) * calibration->T_optical_rectified();
  camera.mounting = T_base_camera ? "camera at tf " + options_.base_frame + " -> " + camera.frame
                                  : "no static tf from " + options_.base_frame + " to " + camera.frame + ": " +
                                        options_.base_frame + " is assumed at the left camera (REP-103 axes)";
  place_fault_ = T_base_camera ? "" : camera.mounting;
  const auto& T_base_imu = places_.T_base_imu;
  if (options_.motion.gyroscope && !T_base_imu)
    place_fault_ += std::string(place_fault_.empty() ? "" : "; ") + "no static tf from " + options_.base_frame +
                    " to " + imu_frame_ + ": the axes of the gyroscope are assumed to be those of the robot";
  if (listener_.began) listener_.began(camera);
  wheels_.emplace(options_.wheel_noise);
  gyroscope_.emplace(options_.gyro_noise, T_base_imu ? T_base_imu->R() : urban_nav_core::Matrix3d::Identity());
  feed_.emplace(options, calibration);
  ++finished_.sessions;
  waiting_images_ = 0;
  for (const Message& message : std::exchange(waiting_, {})) feed(message);
}

void StereoSessions::deliverPairs() {
  while (auto pair = feed_->take()) {
    ++finished_.pairs;
    gaps_.add(pair->assembled.pair.stamp);
    finished_.damaged += static_cast<std::int64_t>(pair->faults.size());
    listener_.pair(*pair);
  }
}

void StereoSessions::end(const std::string& why, bool deliver) {
  first_image_.reset();
  waiting_.clear();
  waiting_images_ = 0;
  if (!feed_) return;
  if (deliver) {
    feed_->finish();
    deliverPairs();
  }
  finished_ = counts();
  finished_.dropped -= rounds_.dropped();  // added by counts()
  feed_.reset();
  gaps_.restart();
  place_fault_.clear();
  if (std::exchange(goes_back_, false) && listener_.went_back) listener_.went_back();
  if (listener_.ended) listener_.ended(why);
}

StereoSessions::Counts StereoSessions::counts() const {
  Counts counts = finished_;
  counts.dropped += rounds_.dropped();
  counts.gaps = gaps_.missing();
  if (!feed_) return counts;
  for (const Side side : {Side::Left, Side::Right}) {
    counts.late += feed_->counts(side).late;
    counts.duplicate += feed_->counts(side).duplicate;
  }
  for (const auto source : {urban_nav_core::MotionSource::Gyroscope, urban_nav_core::MotionSource::Wheels}) {
    const urban_nav_core::TimeOrderedQueueCounts motion = feed_->counts(source);
    counts.motion_late += motion.late;
    counts.motion_inputs += motion.received;
  }
  counts.left_missing += feed_->missing(Side::Left);
  counts.right_missing += feed_->missing(Side::Right);
  counts.rectified += feed_->rectified();
  return counts;
}

}  // namespace urban_nav_ros
