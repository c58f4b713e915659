// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav/run_command.hpp"

#include "base/console.hpp"
#include "commands/commands.hpp"
#include "commands/stages.hpp"

namespace urban_nav {

int runCommand(const std::string& name, const NamedArguments& arguments, RunListener& listener) {
  Console console(listener);
  return runCommandByName(allCommands(), addStageTables, name, arguments, console);
}

}  // namespace urban_nav
