// SPDX-License-Identifier: BSD-3-Clause
#include "base/manual.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "commands/commands.hpp"

namespace urban_nav {
namespace {

Command named(const std::string& name) {
  Command command;
  command.name = name;
  command.summary = "Does " + name + ".";
  return command;
}

std::vector<Command> someCommands() {
  Command one = named("one"), group = named("group"), action = named("act");
  one.options = {{"INPUT", "", "'quoted' and .dotted", true, true, {}},
                 {"-o,--out", "DIR", "a back\\slash", true, false, {}},
                 {"--kind", "K", "which", false, false, {"red", "green"}}};
  one.examples = {"urban_nav one x -o y"};
  action.options = {{"--fast", "", "at once", false, false, {}}};
  group.actions = {action};
  return {one, group};
}

TEST(Manual, HasEveryOptionWithItsSentence) {
  const std::string page = printManual(someCommands());
  for (const char* part : {".TH URBAN_NAV 1", ".SS urban_nav one\nDoes one.\n",
                           "\\fB\\-o\\fR, \\fB\\-\\-out\\fR \\fIDIR\\fR", "\na back\\eslash\n", "which: red, green",
                           "\\&'quoted' and .dotted (repeatable)", ".SS urban_nav group act", "\\fB\\-\\-fast\\fR"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

/// Returns what bash offers for a line whose last word is being typed.
std::string complete(const std::vector<Command>& commands, const std::string& words, int count) {
  const std::string script = ::testing::TempDir() + "completion.bash", out = ::testing::TempDir() + "completed";
  std::ofstream(script) << printCompletion(commands) << "COMP_WORDS=(" << words << ")\nCOMP_CWORD=" << count
                        << "\n_urban_nav\necho \"${COMPREPLY[*]}\"\n";
  const int status = std::system(("bash -eu " + script + " >" + out).c_str());
  EXPECT_EQ(status, 0);
  std::ifstream file(out);
  std::string line;
  std::getline(file, line);
  return line;
}

TEST(Completion, OffersCommandsActionsOptionsAndWords) {
  EXPECT_EQ(complete(someCommands(), "urban_nav o", 1), "one");
  EXPECT_EQ(complete(someCommands(), "urban_nav one --", 2), "--help --out --kind");
  EXPECT_EQ(complete(someCommands(), "urban_nav one --kind g", 3), "green");
  EXPECT_EQ(complete(someCommands(), "urban_nav group a", 2), "act");
  EXPECT_EQ(complete(someCommands(), "urban_nav group act --f", 3), "--fast");
}

TEST(Completion, DocumentsTheCommandsOfTheProgram) {
  EXPECT_EQ(complete(allCommands(), "urban_nav ma", 1), "map");
  EXPECT_EQ(complete(allCommands(), "urban_nav places que", 2), "query");
  EXPECT_EQ(complete(allCommands(), "urban_nav relax --robust o", 3), "on off");
}

}  // namespace
}  // namespace urban_nav
