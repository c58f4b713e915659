// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/command.hpp"
#include "scene_labeler/class_map.hpp"
#include "topics/labels/drive_bag.hpp"
#include "topics/labels/scene_files.hpp"

namespace urban_nav {

/// SRC of `labels`: bags and scenes.
struct LabelSources {
  std::vector<std::string> bags;     ///< in the order of their names
  std::vector<DriveOptions> drives;  ///< one per bag
  std::vector<SceneFiles> scenes;    ///< in the order of their names
};

/// Returns the sources of a command. `parameters` must outlive them. Throws UserError for a source that is neither a
/// bag nor has scenes, a duplicate source, and if the numbers of --trajectory and bags differ.
LabelSources findLabelSources(const Arguments& arguments, const ParameterSet& parameters,
                              const OdometryRunner& run_odometry);

/// Option --classes of a command that reads labels, and its value.
Option classesOption();
scene_labeler::ClassMap readClassMap(const Arguments& arguments);

/// Options of a command that reads bags: --topic and --trajectory.
std::vector<Option> driveCommandOptions();

}  // namespace urban_nav
