// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "live/live_sweeps.hpp"
#include "live/live_teaching.hpp"
#include "scene_labeler/drive/drive_labeler.hpp"
#include "scene_labeler/drive/side_drive.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_live/round_gate.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace scene_labeler {

/// Labels the returns of both side lasers and of 3D LiDARs while the robot drives: scans, sweeps and images wait until
/// odometry covers their time. A return of a side laser is labelled when the robot has left its surroundings; a sweep,
/// when labelSweep() is called. Odometry whose stamps jump back begins a new drive (urban_nav_live::RoundGate). Sides:
/// 0 left, 1 right. Not thread-safe.
class LiveLabels {
 public:
  /// Decodes an image on demand.
  using Decode = std::function<cv::Mat()>;
  /// `image`: called with each frame.
  struct Outputs {
    DriveLabeler::TakeLabels cloud;
    std::function<void(std::size_t side, const DriveFrame& frame, const cv::Mat& classes)> image;
    LiveSweeps::Take sweep = {};
  };
  /// Statistics for the operator.
  struct Counts {
    std::size_t scans = 0, images = 0, poses = 0;
    std::size_t dropped = 0;  ///< scans and images for which no odometry was received
    std::size_t drives = 0;
    std::size_t frames = 0, imaged_frames = 0, blind_frames = 0, upside_down_frames = 0, class_frames = 0,
                new_place_frames = 0;
    LiveSweeps::Counts sweeps;

    void addTo(urban_nav_live::StageReport& report) const;
  };

  LiveLabels(const Parameters& parameters, LabelModel model, Outputs outputs);

  void setLaser(std::size_t side, const urban_nav_core::Pose& T_base_laser) {
    sides_[side].T_base_laser = T_base_laser;
  }
  void setCamera(std::size_t side, const SideRig::Camera& camera) { sides_[side].camera = camera; }
  bool hasLaser(std::size_t side) const { return sides_[side].T_base_laser.has_value(); }
  bool hasCamera(std::size_t side) const { return sides_[side].camera.has_value(); }

  void addPose(const urban_nav_core::StampedPose& T_odom_base);
  void addScan(std::size_t side, urban_nav_core::PlanarScan scan);
  void placeLidar(const std::string& frame, const urban_nav_core::Pose& T_base_lidar) {
    sweeps_.place(frame, T_base_lidar);
  }
  bool hasLidar(const std::string& frame) const { return sweeps_.isPlaced(frame); }
  /// Adds a sweep of a placed LiDAR.
  void addSweep(const std::string& frame, urban_nav_core::Sweep sweep);
  /// Labels the oldest waiting sweep that odometry covers. Returns whether it labelled one.
  bool labelSweep() { return sweeps_.labelNext(model_, parameters_.superpixel); }
  /// Returns a sentence if sweeps come faster than they are labelled; else empty.
  std::string sweepFault() const { return sweeps_.fault(); }
  void addImage(std::size_t side, urban_nav_core::StampNs stamp, Decode decode);
  /// Adds a class image of another source (CV_8U, SceneClass), for the image with this stamp. If there is a class
  /// topic, images wait for theirs for at most 2 s.
  void addClasses(std::size_t side, urban_nav_core::StampNs stamp, const cv::Mat& classes);
  /// Processes measurements that arrived after the poses of their time, without waiting for the next pose.
  void catchUp();
  /// Begins a new drive. Mountings of lasers and cameras and corrections are kept.
  void reset();

  /// Corrects the superpixels at a position in the world (LiveTeaching::correct()).
  std::string correct(const Eigen::Vector3f& place, SceneClass label) { return teaching_.correct(place, label); }
  /// Switches to the retrained model if it is ready, after labelling what the old one has processed. Returns whether it
  /// did.
  bool adoptTaughtModel();
  const LiveTeaching& teaching() const { return teaching_; }
  /// Returns the current model.
  const LabelModel& model() const { return *model_; }

  Counts counts() const;
  urban_nav_core::StampNs newest() const { return trajectory_.empty() ? 0 : trajectory_.back().stamp; }

 private:
  struct WaitingImage {
    urban_nav_core::StampNs stamp = 0;
    Decode decode;
  };
  struct LiveSide {
    std::optional<urban_nav_core::Pose> T_base_laser;
    std::optional<SideRig::Camera> camera;
    std::deque<urban_nav_core::PlanarScan> scans;
    std::deque<WaitingImage> images;
    std::map<urban_nav_core::StampNs, cv::Mat> classes;  // by the stamp of their image
    std::unique_ptr<DriveLabeler> labeler;
    std::unique_ptr<DriveWindow> window;
    std::unique_ptr<SideDrive> drive;
  };
  using Add = std::function<void()>;
  // Streams of scans, images and classes once per side.
  enum Stream { kOdometryStream = 0, kScanStream = 1, kImageStream = 3, kClassStream = 5, kSweepStream = 7 };
  void sortByRound();
  /// Labels the remaining returns of the drive, and begins another one.
  void beginDrive();
  void clear();
  void take(const urban_nav_core::StampedPose& T_odom_base);
  void take(std::size_t side, const urban_nav_core::PlanarScan& scan);
  void work(std::size_t side);
  void start(std::size_t side);
  void count(const LiveSide& side, Counts& counts) const;
  /// Adds the images at times covered by odometry. Returns false if one waits for its class image.
  bool workImages(LiveSide& side);

  const Parameters parameters_;
  std::shared_ptr<const LabelModel> model_;
  LiveTeaching teaching_;
  const Outputs outputs_;
  urban_nav_core::Trajectory trajectory_;
  std::unique_ptr<TravelledPath> path_;
  std::array<LiveSide, 2> sides_;
  LiveSweeps sweeps_;
  Counts counts_;
  std::unique_ptr<urban_nav_live::RoundGate<Add>> rounds_;
};

}  // namespace scene_labeler
