// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include "input/input_parameters.hpp"
#include "input/open.hpp"
#include "labels/drive_bag.hpp"
#include "stage/vo_run.hpp"
#include "stages/vo/vo_recorder.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::Trajectory;

namespace {

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

Trajectory runOdometry(Source& source, const DriveOptions& options, Console& console) {
  VoRun run;
  VoRecorder recorder(options.parameters->get(swf_vo::table()), source.info(), run);
  Progress progress(console, "vo", "frames", source.info().frames);
  while (const auto item = source.next()) {
    recorder.process(*item);
    progress.update(static_cast<std::int64_t>(run.rows.size()));
  }
  recorder.finish({source.closingFaults(), source.forces()});
  progress.finish(static_cast<std::int64_t>(run.rows.size()));
  return smoothedTrajectory(run);
}

/// Returns the transforms of base_link on /tf, to odom or, without these, to map.
Trajectory readTransforms(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "tf"}));
  Trajectory from_odom, from_map;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<tf2_msgs::TFMessage>();
    if (!message) continue;
    for (const geometry_msgs::TransformStamped& transform : message->transforms) {
      if (withoutSlash(transform.child_frame_id) != urban_nav_core::frames::base_link) continue;
      const auto pose = urban_nav_ros::toPose(transform.transform);
      const std::string parent = withoutSlash(transform.header.frame_id);
      if (!pose) continue;
      if (parent == urban_nav_core::frames::odom)
        from_odom.append(urban_nav_ros::toStampNs(transform.header.stamp), *pose);
      else if (parent == urban_nav_core::frames::map)
        from_map.append(urban_nav_ros::toStampNs(transform.header.stamp), *pose);
    }
  }
  return from_odom.empty() ? from_map : from_odom;
}

}  // namespace

Trajectory readDriveTrajectory(const std::string& bag, const DriveOptions& options, Console& console) {
  if (!options.trajectory.empty()) return urban_nav_core::readTum(options.trajectory);
  const InputParameters& input = options.parameters->get(inputTable());
  SourceOptions source_options;
  source_options.topics = options.topics;
  source_options.motion_input = input.motion_input;
  source_options.wheel_noise = input.wheel_noise;
  source_options.gyro_noise = input.gyro_noise;
  source_options.right_delay = input.right_delay;
  std::string reason;
  try {
    const auto source = openSource({bag}, source_options);
    Trajectory trajectory = runOdometry(*source, options, console);
    if (!trajectory.empty()) return trajectory;
    reason = "its odometry has no pose";
  } catch (const urban_nav_core::DataError& error) {
    reason = error.parts().found;
  }
  Trajectory trajectory;
  try {
    trajectory = readTransforms(bag);
  } catch (const rosbag::BagException& error) {
    throw urban_nav_core::DataError(bag, std::string("cannot be read: ") + error.what(), "a whole bag");
  }
  if (trajectory.empty())
    throw urban_nav_core::UserError(bag, "has no trajectory: " + reason + ", and no tf from odom or map to base_link",
                                    "--trajectory FILE.tum");
  console.info(bag + ": poses of its tf");
  return trajectory;
}

}  // namespace urban_nav
