// SPDX-License-Identifier: BSD-3-Clause
#include "commands/commands.hpp"

int main(int argc, char** argv) {
  return urban_nav::runCommandLine(
      {urban_nav::mapCommand(), urban_nav::convertCommand(), urban_nav::evaluateCommand(), urban_nav::infoCommand(),
       urban_nav::exportCommand(), urban_nav::mergeCommand(), urban_nav::relaxCommand(), urban_nav::icpCommand(),
       urban_nav::disparityCommand(), urban_nav::doctorCommand(), urban_nav::placesCommand(),
       urban_nav::labelsCommand(), urban_nav::simulateCommand(), urban_nav::deviceCommand(), urban_nav::whyCommand()},
      argc, argv);
}
