// SPDX-License-Identifier: BSD-3-Clause
#include <tf2_msgs/TFMessage.h>

#include "topics/labels/drive_bag.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using urban_nav_core::Trajectory;

namespace {

std::string withoutSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

/// Returns the transforms of kBaseLink on /tf, to odom or, without these, to map.
Trajectory readTransforms(const std::string& path) {
  urban_nav_input::Recording recording(path);
  urban_nav_input::RecordedMessages messages = recording.messages({urban_nav_ros::topics::kTransforms, "tf"});
  Trajectory from_odom, from_map;
  while (const auto each = messages.next()) {
    const auto message = each->as<tf2_msgs::TFMessage>();
    if (!message) continue;
    for (const geometry_msgs::TransformStamped& transform : message->transforms) {
      if (withoutSlash(transform.child_frame_id) != urban_nav_core::frames::kBaseLink) continue;
      const auto pose = urban_nav_ros::toPose(transform.transform);
      const std::string parent = withoutSlash(transform.header.frame_id);
      if (!pose) continue;
      if (parent == urban_nav_core::frames::kOdom)
        from_odom.append(urban_nav_ros::toStampNs(transform.header.stamp), *pose);
      else if (parent == urban_nav_core::frames::kMap)
        from_map.append(urban_nav_ros::toStampNs(transform.header.stamp), *pose);
    }
  }
  return from_odom.empty() ? from_map : from_odom;
}

}  // namespace

Trajectory readDriveTrajectory(const std::string& bag, const DriveOptions& options, Console& console) {
  if (!options.trajectory.empty()) return urban_nav_core::readTum(options.trajectory);
  const urban_nav_input::InputParameters& input = options.parameters->get(urban_nav_input::inputTable());
  urban_nav_input::SourceOptions source_options;
  source_options.topics = options.topics;
  apply(input, source_options);
  std::string reason;
  for (const bool with_sweeps : {false, true}) {
    source_options.with_sweeps = with_sweeps;
    try {
      const auto source = urban_nav_input::openSource({bag}, source_options);
      Trajectory trajectory = options.run_odometry(*source, *options.parameters, console);
      if (!trajectory.empty()) return trajectory;
      reason = "its odometry has no pose";
      break;
    } catch (const urban_nav_core::DataError& error) {
      reason = error.parts().found;
    }
  }
  const Trajectory trajectory = readTransforms(bag);
  if (trajectory.empty())
    throw urban_nav_core::UserError(bag, "has no trajectory: " + reason + ", and no tf from odom or map to base_link",
                                    "--trajectory FILE.tum");
  console.info(bag + ": poses of its tf");
  return trajectory;
}

}  // namespace urban_nav
