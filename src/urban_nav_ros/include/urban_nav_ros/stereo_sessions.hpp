// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/frame_gaps.hpp"
#include "urban_nav_live/round_gate.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/rectification_judge.hpp"
#include "urban_nav_ros/stereo_feed.hpp"
#include "urban_nav_ros/stereo_input.hpp"

namespace urban_nav_ros {

/// Divides the messages of a stereo camera and of a motion sensor into sessions: each has one calibration, one mounting
/// and stamps that do not jump back (urban_nav_live::RoundGate). Pairs are the same as offline. Used by one thread.
///
/// A session begins when both camera_info have arrived and /tf_static connects base and camera, at the latest
/// `tf_timeout` after the first image; earlier images are kept. Without the transform the left camera is assumed at the
/// base, with axes as in REP 103, and placeFault() reports it; when the transform arrives or changes, the session ends
/// and the next one begins. The same applies to the axes of the gyroscope. While it is uncertain whether images are
/// rectified, the session waits for the first pairs.
class StereoSessions {
 public:
  using Message = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, nav_msgs::OdometryConstPtr,
                               sensor_msgs::ImuConstPtr>;

  struct Options {
    std::string base_frame = urban_nav_core::frames::kBaseLink;
    bool rectified = false;               ///< the images are rectified already
    bool judges_images = false;           ///< `rectified` is uncertain: the first pairs decide, if possible
    int queue_size = 200;                 ///< images kept before a session begins, with the messages between them
    double max_lateness = 0.1;            ///< s of stamps that an image waits for its partner and for motion inputs
    double sync_tolerance = 0.005;        ///< s between the stamps of left and right image
    double tf_timeout = 1.0;              ///< s
    urban_nav_core::MotionChoice motion;  ///< sensor_msgs/Imu and nav_msgs/Odometry that are motion inputs
    double wheel_noise = 0.0;             ///< parameter of WheelMotion
    double gyro_noise = 0.0;              ///< parameter of GyroMotion, rad/s; 0: as stated by messages
    std::string where = "stereo";         ///< prefix of errors of the calibration
  };
  struct Camera {
    urban_nav_core::StereoCamera camera;
    urban_nav_core::Pose T_base_left;  ///< rectified left camera
    std::string frame;                 ///< frame of the left camera
    bool rectifies = false;            ///< images are rectified here
    std::string contradiction;         ///< message if the images contradict the topic's name
    std::string mounting;              ///< origin of T_base_left, for messages
    bool is_mounting_known = false;
    /// Returns "512x384 px, rectified here; camera at tf kBaseLink -> left".
    std::string sentence() const;
  };
  struct Listener {
    std::function<void(const Camera&)> began;
    std::function<void(DecodedPair&)> pair;
    std::function<void(const std::string& why)> ended;  ///< after the last pair of the session
    /// The calibration does not permit a session, for this reason; empty: another calibration has arrived.
    std::function<void(const std::string& fault)> refused;
    /// Stamps have jumped back. Called after the last pair before the jump and before `ended`, also without a session.
    std::function<void()> went_back = {};
    /// Receives the motion inputs of a session as they arrive; pairs contain them again.
    std::function<void(const urban_nav_core::MotionInput&)> motion = {};
  };
  struct Counts {
    std::int64_t late = 0, duplicate = 0;  ///< images dropped by the queue
    std::int64_t motion_late = 0, motion_inputs = 0;  ///< of IMU and wheels: dropped by the queue, and all
    std::int64_t left_missing = 0, right_missing = 0;
    std::int64_t damaged = 0;    ///< images that cannot be decoded or have a wrong size
    std::int64_t dropped = 0;    ///< images before a session began, and messages from before a backward jump in time
    std::int64_t rectified = 0;  ///< images
    std::int64_t pairs = 0, sessions = 0;
    std::int64_t gaps = 0;  ///< missing pairs, by the gaps between stamps
    void addTo(urban_nav_live::StageReport& report) const;
  };

  StereoSessions(Options options, Listener listener)
      : options_(std::move(options)),
        listener_(std::move(listener)),
        judge_(options_.rectified, options_.judges_images, options_.sync_tolerance),
        rounds_(urban_nav_live::RoundGate<Message>::Options{{kLeftStream, kRightStream}},
                {[this](Message& message) { handleSensor(message); }, [this] { goBack(); }}) {}

  /// Handles a message; calls the listener.
  void handle(const Message& message);
  /// Begins a session whose wait for /tf_static has ended. Call about ten times a second.
  void idle();
  /// Ends the session, if any, and drops messages that wait for one. `deliver`: pending pairs are passed to the
  /// listener first.
  void end(const std::string& why, bool deliver = true);

  bool isRunning() const { return feed_.has_value(); }
  /// Returns which mountings the running session assumes; empty: none, or no session.
  const std::string& placeFault() const { return place_fault_; }
  /// Returns why the calibration does not permit a session; empty: no fault.
  const std::string& fault() const { return fault_; }
  const StaticTransforms& transforms() const { return transforms_; }
  Counts counts() const;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kLeftStream = 0, kRightStream = 1, kWheelStream = 2, kGyroStream = 3;
  void sortByRound(const Message& message);
  void goBack();
  void handleInfo(const InfoInput& info);
  void handleSensor(const Message& message);
  void feed(const Message& message);
  void feed(const urban_nav_core::MotionInput& motion);
  void wait(const Message& message);
  void setFault(const std::string& fault);
  void tryToBegin();
  void begin(bool are_rectified);
  void deliverPairs();
  /// Mountings of the sensors from /tf_static; empty: unknown.
  struct Places {
    std::optional<urban_nav_core::Pose> T_base_camera, T_base_imu;
  };
  Places findPlaces() const;
  void followPlaces();

  const Options options_;
  const Listener listener_;
  StaticTransforms transforms_;
  sensor_msgs::CameraInfoConstPtr left_info_, right_info_;
  std::string imu_frame_ = urban_nav_core::frames::kImu;
  std::deque<Message> waiting_;  // messages before a session
  int waiting_images_ = 0;       // number of images among them
  RectificationJudge judge_;
  std::optional<Clock::time_point> first_image_;
  urban_nav_live::RoundGate<Message> rounds_;
  bool goes_back_ = false;  // the session is being ended by a backward jump
  std::string fault_, place_fault_;
  Places places_;  // of the running session
  std::optional<StereoFeed> feed_;
  std::optional<WheelMotion> wheels_;
  std::optional<GyroMotion> gyroscope_;
  urban_nav_live::FrameGaps gaps_;
  Counts finished_;  // counts of ended sessions, and those outside any feed
};

}  // namespace urban_nav_ros
