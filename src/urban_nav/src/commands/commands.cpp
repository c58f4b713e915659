// SPDX-License-Identifier: BSD-3-Clause
#include "commands/commands.hpp"

#include "commands/stages.hpp"
#include "convert/convert_command.hpp"
#include "device/device_command.hpp"
#include "edits/edits.hpp"
#include "evaluation/evaluate_command.hpp"
#include "inspect/inspect.hpp"
#include "inspect/results/result_recording.hpp"
#include "join/join_command.hpp"
#include "join/release_command.hpp"
#include "map/map_command.hpp"
#include "simulate/simulate_command.hpp"
#include "topics/graph/graph.hpp"
#include "topics/labels/labels.hpp"
#include "topics/lo/lo.hpp"
#include "topics/loops/loops.hpp"
#include "topics/places/places.hpp"
#include "topics/stereo/stereo.hpp"
#include "topics/vo/vo.hpp"
#include "view/view.hpp"

namespace urban_nav {

namespace {

/// Odometry by stereo, or by a LiDAR without images.
urban_nav_core::Trajectory runAnyOdometry(urban_nav_input::Source& source, const ParameterSet& parameters,
                                          Console& console) {
  return source.info().has_images ? runOdometry(source, parameters, console)
                                  : runLaserOdometry(source, parameters, console);
}

Command labelsWithTeaching() {
  Command labels = labelsCommand(runAnyOdometry);
  labels.actions.push_back(labelsTeachAction());
  return labels;
}

}  // namespace

std::vector<Command> allCommands() {
  return {mapCommand(makeStages, recordAllResults),
          convertCommand(),
          evaluateCommand(),
          infoCommand(),
          exportCommand(),
          mergeCommand(),
          joinCommand(makeStages),
          releaseCommand(),
          relaxCommand(),
          icpCommand(),
          disparityCommand(),
          doctorCommand(),
          placesCommand(),
          labelsWithTeaching(),
          simulateCommand(),
          deviceCommand(),
          whyCommand(),
          edgeCommand(),
          verifyCommand(makeStages),
          viewCommand(addStageTables)};
}

}  // namespace urban_nav
