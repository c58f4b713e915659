// SPDX-License-Identifier: BSD-3-Clause
#include "commands/commands.hpp"
#include "commands/stages.hpp"

int main(int argc, char** argv) {
  return urban_nav::runCommandLine(urban_nav::allCommands(), urban_nav::addStageTables, argc, argv);
}
