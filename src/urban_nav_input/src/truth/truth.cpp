// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/truth/truth.hpp"

#include <geometry_msgs/PoseStamped.h>

#include <cstdint>
#include <filesystem>

#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/euroc_layout.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"
#include "urban_nav_input/folder/kitti_sweeps.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::UserError;

namespace {

TrajectoryFile stamped(const std::string& path, const Trajectory& trajectory) {
  TrajectoryFile file{path, true, trajectory, {}, {}};
  for (const urban_nav_core::StampedPose& pose : trajectory) file.poses.push_back(pose.pose);
  return file;
}

void noteLeftOut(TrajectoryFile& file, std::int64_t count, const std::string& why) {
  if (count > 0)
    file.notes.push_back(file.path + ": " + std::to_string(count) + (count == 1 ? " pose has " : " poses have ") + why +
                         ", and " + (count == 1 ? "is" : "are") + " left out");
}

/// Converts poses of the left camera relative to its first pose to poses of base_link.
Trajectory baseOfCamera(const std::vector<Pose>& poses, const std::vector<StampNs>& stamps, const Pose& T_base_camera,
                        const std::string& path) {
  if (poses.size() != stamps.size())
    throw UserError(path, std::to_string(poses.size()) + " poses for " + std::to_string(stamps.size()) + " frames",
                    "one line a frame");
  Trajectory trajectory;
  for (std::size_t i = 0; i < poses.size(); ++i)
    trajectory.append(stamps[i], T_base_camera * poses[i] * T_base_camera.inverse());
  return trajectory;
}

/// Returns the frames of the lines of poses.txt: those of the images, or of the sweeps without images.
KittiFrames listFramesWithTruth(const std::string& folder, double rate) {
  if (const std::optional<KittiLayout> layout = findKittiLayout(folder)) return listKittiFrames(*layout, rate);
  KittiFrames frames;
  const std::optional<KittiSweepLayout> sweeps = findKittiSweeps(folder);
  const std::map<std::int64_t, std::string> files = listKittiSweeps(*sweeps);
  const std::int64_t first = files.begin()->first, last = files.rbegin()->first;
  for (std::int64_t number = first; number <= last; ++number) frames.numbers.push_back(number);
  const KittiLayout layout{folder, sweeps->files, sweeps->files, urban_nav_core::KittiPair::Grey};
  frames.stamps = stampKittiFrames(layout, "sweeps", {first, last}, rate, frames.notes);
  return frames;
}

std::optional<TrajectoryFile> kittiTruth(const std::string& folder, const SourceInfo& info,
                                         const SourceOptions& options) {
  const std::string path = (fs::path(folder) / "poses.txt").string();
  if (!fs::exists(path)) return std::nullopt;
  std::vector<Pose> poses = urban_nav_core::readKitti(path);
  const KittiFrames frames = listFramesWithTruth(folder, options.rate);
  const std::size_t lines = poses.size();
  if (lines != frames.stamps.size() && frames.numbers.back() < static_cast<std::int64_t>(lines))
    poses = {poses.begin() + frames.numbers.front(), poses.begin() + frames.numbers.back() + 1};
  TrajectoryFile file = stamped(path, baseOfCamera(poses, frames.stamps, info.T_base_camera, path));
  noteLeftOut(file, static_cast<std::int64_t>(lines - poses.size()), "no frame in the folder");
  return file;
}

std::optional<TrajectoryFile> bagTruth(const InputSession& session, const SourceOptions& options) {
  Recording recording(session.paths);
  const std::optional<ChosenTopic> topic = chooseTopics(recording.topicTypes(), options.topics).find(Role::Truth);
  if (!topic) return std::nullopt;
  Trajectory trajectory;
  std::int64_t not_finite = 0, out_of_order = 0;
  RecordedMessages messages = recording.messages({topic->name}, session.part);
  while (const std::optional<RecordedMessage> each = messages.next()) {
    const auto message = each->as<geometry_msgs::PoseStamped>();
    if (!message) continue;
    const std::optional<Pose> pose = urban_nav_ros::toPose(message->pose);
    if (!pose) ++not_finite;
    else if (!trajectory.append(urban_nav_ros::toStampNs(message->header.stamp), *pose)) ++out_of_order;
  }
  const std::string where = session.paths.front() + ", topic " + topic->name;
  if (trajectory.size() < 2) throw UserError(where, "has fewer than two poses", "");
  TrajectoryFile file = stamped(where, trajectory);
  noteLeftOut(file, not_finite, "an invalid rotation, or a number that is not finite");
  noteLeftOut(file, out_of_order, "a stamp that is not later than the previous one");
  return file;
}

}  // namespace

std::optional<TrajectoryFile> findTruth(const InputSession& session, const SourceInfo& info,
                                        const SourceOptions& options) {
  const std::string& path = session.paths.front();
  switch (inputKind(path)) {
    case InputKind::KittiFolder: return kittiTruth(path, info, options);
    case InputKind::EurocFolder: {
      const std::string mav0 = eurocFolder(path);
      const std::optional<Trajectory> truth = readEurocTruth(mav0, readEurocRig(mav0).T_base_body);
      return truth && truth->size() > 1
                 ? std::optional<TrajectoryFile>(stamped(mav0 + "/state_groundtruth_estimate0", *truth))
                 : std::nullopt;
    }
    case InputKind::Bag: return bagTruth(session, options);
    case InputKind::NewCollegeFolder: break;
  }
  return std::nullopt;
}

TrajectoryFile truthOfBase(const TrajectoryFile& file, const SourceInfo& info, const std::vector<StampNs>& stamps) {
  if (file.stamped) return file;
  const Pose T_body_optical = urban_nav_ros::opticalInBody();
  std::vector<Pose> camera;
  for (const Pose& pose : file.poses) camera.push_back(T_body_optical.inverse() * pose * T_body_optical);
  TrajectoryFile base = stamped(file.path, baseOfCamera(camera, stamps, info.T_base_camera, file.path));
  base.notes = file.notes;
  return base;
}

}  // namespace urban_nav_input
