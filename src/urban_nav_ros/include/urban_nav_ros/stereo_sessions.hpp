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

/// Divides the messages of a stereo camera, and of a motion sensor, into sessions: each has one calibration, one
/// mounting and stamps that do not jump back (urban_nav_live::RoundGate). Pairs are the same as offline. Used by one
/// thread.
///
/// A session begins when both camera_info have arrived and /tf_static connects base and camera, at the latest
/// `tf_timeout` after the first image; earlier images are kept. Without the transform the left camera is taken to be at
/// the base, with axes as in REP 103: placeFault() names that, and when the transform arrives, or another one, the
/// session ends and the next begins with it. So are the gyroscope's axes. Where it is not certain that
/// images are rectified, the first pairs are awaited.
class StereoSessions {
 public:
  using Message = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, nav_msgs::OdometryConstPtr,
                               sensor_msgs::ImuConstPtr>;

  struct Options {
    std::string base_frame = urban_nav_core::frames::kBaseLink;
    bool rectified = false;               ///< the images are rectified already
    bool judges_images = false;           ///< `rectified` is a guess: the first pairs decide, where they can
    int queue_size = 200;                 ///< images kept before a session begins, with the messages between them
    double max_lateness = 0.1;            ///< s, by stamps, that an image waits for its partner and for motion inputs
    double sync_tolerance = 0.005;        ///< s between the stamps of left and right image
    double tf_timeout = 1.0;              ///< s
    urban_nav_core::MotionChoice motion;  ///< sensor_msgs/Imu and nav_msgs/Odometry that are motion inputs
    double wheel_noise = 0.0;             ///< of WheelMotion
    double gyro_noise = 0.0;              ///< of GyroMotion, rad/s; 0: as messages state
    std::string where = "stereo";         ///< what an error of the calibration begins with
  };
  struct Camera {
    urban_nav_core::StereoCamera camera;
    urban_nav_core::Pose T_base_left;  ///< of the rectified left camera
    std::string frame;                 ///< of the left camera
    bool rectifies = false;            ///< images are rectified here
    std::string contradiction;         ///< sentence where what the images show contradicts their name
    std::string mounting;              ///< sentence on how T_base_left is known
    bool is_mounting_known = false;
    /// Returns "512x384 px, rectified here; camera at tf kBaseLink -> left".
    std::string sentence() const;
  };
  struct Listener {
    std::function<void(const Camera&)> began;
    std::function<void(DecodedPair&)> pair;
    std::function<void(const std::string& why)> ended;  ///< after the last pair of the session
    /// The calibration makes no session, for this reason; empty: another calibration has arrived.
    std::function<void(const std::string& fault)> refused;
    /// Stamps have jumped back: after the last pair from before it, and before `ended`. Called without a session, too.
    std::function<void()> went_back = {};
  };
  struct Counts {
    std::int64_t late = 0, duplicate = 0;  ///< images refused by the queue
    std::int64_t left_missing = 0, right_missing = 0;
    std::int64_t damaged = 0;    ///< images that do not decode or have a wrong size
    std::int64_t dropped = 0;    ///< images before a session began, and messages from before a jump back in time
    std::int64_t rectified = 0;  ///< images
    std::int64_t pairs = 0, sessions = 0;
    std::int64_t gaps = 0;  ///< pairs that never came, by the gaps between stamps
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
  /// Begins a session whose wait for /tf_static is over. To be called some ten times a second.
  void idle();
  /// Ends the session, if there is one, and forgets messages that wait for one. `deliver`: pairs that still wait are
  /// handed to the listener first.
  void end(const std::string& why, bool deliver = true);

  bool isRunning() const { return feed_.has_value(); }
  /// Returns which places of sensors the running session assumes; empty: none, or no session.
  const std::string& placeFault() const { return place_fault_; }
  /// Returns why the calibration makes no session; empty: nothing is wrong with it.
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
  void wait(const Message& message);
  void setFault(const std::string& fault);
  void tryToBegin();
  void begin(bool are_rectified);
  void deliverPairs();
  /// Places of the sensors by /tf_static; empty: not known.
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
  std::deque<Message> waiting_;  // for a session
  int waiting_images_ = 0;       // of these
  RectificationJudge judge_;
  std::optional<Clock::time_point> first_image_;
  urban_nav_live::RoundGate<Message> rounds_;
  bool goes_back_ = false;  // the session that ends does so because of it
  std::string fault_, place_fault_;
  Places places_;  // of the running session
  std::optional<StereoFeed> feed_;
  std::optional<WheelMotion> wheels_;
  std::optional<GyroMotion> gyroscope_;
  urban_nav_live::FrameGaps gaps_;
  Counts finished_;  // of the sessions that have ended, and what no feed counts
};

}  // namespace urban_nav_ros
