// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/Imu.h>

#include <limits>

#include "convert/bag_writer.hpp"
#include "convert/colour_topic.hpp"
#include "convert/convert.hpp"
#include "convert/stereo_topics.hpp"
#include "convert/sweep_topics.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/folder/euroc_layout.hpp"
#include "urban_nav_input/truth/truth.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;

namespace {

/// Offset of stamps that begin at zero, to a valid ROS time (2001-09-09).
constexpr StampNs kEpoch = 1'000'000'000'000'000'000;
constexpr StampNs kEarliest = 1'000'000'000;

geometry_msgs::PoseStamped truthMessage(const urban_nav_core::StampedPose& pose, StampNs shift) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = urban_nav_ros::toRosTime(pose.stamp + shift);
  message.header.frame_id = "ground_truth";
  message.pose = urban_nav_ros::toPoseMessage(pose.pose);
  return message;
}

/// Messages other than images, in the order of stamps.
class Companions {
 public:
  Companions(std::vector<sensor_msgs::Imu> imu, KittiSweepTopic sweeps,
             std::optional<urban_nav_input::TrajectoryFile> truth, StampNs shift)
      : imu_(std::move(imu)), sweeps_(std::move(sweeps)), truth_(std::move(truth)), shift_(shift) {}

  /// Writes all messages up to a stamp of the folder.
  void writeUntil(StampNs stamp, BagWriter& bag) {
    for (; next_imu_ < imu_.size() && urban_nav_ros::toStampNs(imu_[next_imu_].header.stamp) <= stamp; ++next_imu_) {
      sensor_msgs::Imu& message = imu_[next_imu_];
      const StampNs at = urban_nav_ros::toStampNs(message.header.stamp) + shift_;
      message.header.stamp = urban_nav_ros::toRosTime(at);
      bag.write(urban_nav_ros::topics::fromRoot(urban_nav_ros::topics::kImu), at, message);
    }
    sweeps_.writeUntil(stamp, shift_, bag);
    if (!truth_) return;
    for (; next_truth_ < truth_->trajectory.size() && truth_->trajectory[next_truth_].stamp <= stamp; ++next_truth_) {
      const urban_nav_core::StampedPose& pose = truth_->trajectory[next_truth_];
      bag.write(urban_nav_ros::topics::fromRoot(urban_nav_ros::topics::kTruthPose), pose.stamp + shift_,
                truthMessage(pose, shift_));
    }
  }

 private:
  std::vector<sensor_msgs::Imu> imu_;
  KittiSweepTopic sweeps_;
  std::optional<urban_nav_input::TrajectoryFile> truth_;
  StampNs shift_;
  std::size_t next_imu_ = 0, next_truth_ = 0;
};

void refuseFaults(const urban_nav_input::SourceItem& input) {
  if (!input.faults.empty()) throw DataError("", input.faults.front(), "");
}

}  // namespace

Converted convertStereoFolder(const std::string& folder, const std::string& path,
                              urban_nav_input::SourceOptions options, Console& console, bool ahead) {
  options.with_sweeps = options.with_colour = true;
  std::unique_ptr<urban_nav_input::Source> source = urban_nav_input::openSource({folder}, options);
  if (ahead) source = urban_nav_input::readAhead(std::move(source), 4);
  const urban_nav_input::SourceInfo& info = source->info();
  const StampNs shift = info.first < kEarliest ? kEpoch : 0;
  Converted converted;
  converted.notes = info.notes;
  if (shift != 0)
    converted.notes.push_back("stamps begin at zero: shifted by 1000000000 s, since zero is not a valid ROS time");

  std::vector<sensor_msgs::Imu> imu;
  std::vector<geometry_msgs::TransformStamped> transforms;
  if (info.has_images) transforms = stereoTransforms(info.camera, info.T_base_camera);
  for (const auto& transform : colourTransforms(info)) transforms.push_back(transform);
  if (urban_nav_input::inputKind(folder) == urban_nav_input::InputKind::EurocFolder) {
    for (const urban_nav_input::EurocImu& row : urban_nav_input::readEurocImu(urban_nav_input::eurocFolder(folder)))
      imu.push_back(urban_nav_input::toImuMessage(row));
    if (!imu.empty())
      transforms.push_back(urban_nav_ros::toStaticTransform(
          urban_nav_core::frames::kBaseLink, urban_nav_core::frames::kImu,
          urban_nav_input::readEurocRig(urban_nav_input::eurocFolder(folder)).T_base_body));
  }
  KittiSweepTopic sweeps(folder, options.rate);
  if (const auto T_camera_lidar = sweeps.T_camera_lidar())
    transforms.push_back(urban_nav_ros::toStaticTransform(urban_nav_core::frames::kBaseLink, sweeps.frame(),
                                                          info.T_base_camera * *T_camera_lidar));
  for (const std::string& note : sweeps.notes()) converted.notes.push_back(note);
  Companions companions(std::move(imu), std::move(sweeps), urban_nav_input::findTruth({{folder}}, info, options),
                        shift);

  BagWriter bag(path);
  bag.writeStaticTransforms(info.first + shift, transforms);
  Progress progress(console, "convert", "frames", info.frames);
  std::int64_t frames = 0;
  while (const std::optional<urban_nav_input::SourceItem> input = source->next()) {
    refuseFaults(*input);
    if (!input->has_pair) continue;  // of a LiDAR
    const urban_nav_core::StereoPair& pair = input->assembled.pair;
    companions.writeUntil(pair.stamp, bag);
    writeStereo(pair, pair.stamp + shift, info.camera, bag);
    writeColours(*input, info, shift, bag);
    progress.update(++frames);
  }
  companions.writeUntil(std::numeric_limits<StampNs>::max(), bag);
  bag.commit();
  progress.finish(frames);
  converted.counts = bag.counts();
  return converted;
}

}  // namespace urban_nav
