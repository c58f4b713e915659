// SPDX-License-Identifier: BSD-3-Clause
#include "base/command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/console.hpp"
#include "base/json.hpp"
#include "commands/stages.hpp"
#include "convert/convert_command.hpp"
#include "evaluation/evaluate_command.hpp"
#include "inspect/inspect.hpp"
#include "map/map_command.hpp"
#include "simulate/simulate_command.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

int call(const std::vector<Command>& commands, std::vector<const char*> words) {
  words.insert(words.begin(), "urban_nav");
  return runCommandLine(commands, addStageTables, static_cast<int>(words.size()), words.data());
}

Command probe(std::function<int(const Arguments&)> run) {
  Command command;
  command.name = "probe";
  command.options = {{"INPUT", "", "", true, true, {}},
                     {"-o,--out", "DIR", "", true, false, {}},
                     {"--stages", "LIST", "", false, true, {}},
                     {"--fast", "", "", false, false, {}},
                     {"--kind", "K", "", false, false, {"a", "b"}},
                     threadsOption()};
  command.run = [run = std::move(run)](const Arguments& arguments, Console&) { return run(arguments); };
  return command;
}

TEST(CommandLine, GivesWhatWasGiven) {
  bool ran = false;
  const Command command = probe([&](const Arguments& arguments) {
    ran = true;
    EXPECT_EQ(arguments.all("INPUT"), (std::vector<std::string>{"x", "y"}));
    EXPECT_EQ(arguments.get("out"), "there");
    EXPECT_EQ(arguments.list("stages"), (std::vector<std::string>{"vo", "places", "loops"}));
    EXPECT_TRUE(arguments.has("fast"));
    EXPECT_FALSE(arguments.has("kind"));
    EXPECT_EQ(arguments.integer("threads", 7, 1, 64), 2);
    return 0;
  });
  EXPECT_EQ(call({command}, {"probe", "x", "--stages", "vo,places", "y", "-o", "there", "--fast", "--threads", "2",
                             "--stages", "loops"}),
            0);
  EXPECT_TRUE(ran);
}

int callByName(const Command& command, const std::map<std::string, std::vector<std::string>>& values) {
  Console console;
  return runCommandByName({command}, addStageTables, "probe", values, console);
}

TEST(CommandByName, GivesWhatWasGiven) {
  bool ran = false;
  const Command command = probe([&](const Arguments& arguments) {
    ran = true;
    EXPECT_EQ(arguments.all("INPUT"), (std::vector<std::string>{"-x", "y"}));
    EXPECT_EQ(arguments.list("stages"), (std::vector<std::string>{"vo", "places"}));
    EXPECT_TRUE(arguments.has("fast"));
    EXPECT_EQ(arguments.integer("threads", 7, 1, 64), 2);
    return 1;
  });
  EXPECT_EQ(callByName(command, {{"INPUT", {"-x", "y"}},
                                 {"out", {"there"}},
                                 {"stages", {"vo", "places"}},
                                 {"fast", {"true"}},
                                 {"threads", {"2"}}}),
            1);
  EXPECT_TRUE(ran);
}

TEST(CommandByName, RefusesWhatTheLineRefuses) {
  const Command command = probe([](const Arguments&) { return 0; });
  using Values = std::map<std::string, std::vector<std::string>>;
  const Values good = {{"INPUT", {"x"}}, {"out", {"there"}}};
  const auto with = [&](const std::string& key, const std::vector<std::string>& values) {
    Values changed = good;
    changed[key] = values;
    return changed;
  };
  EXPECT_EQ(callByName(command, good), 0);
  for (const Values& bad : {with("colour", {"red"}), with("fast", {"yes"}), with("out", {}), with("out", {"a", "b"}),
                            with("kind", {"c"}), with("threads", {}), Values{{"INPUT", {"x"}}}})
    EXPECT_THROW(callByName(command, bad), urban_nav_core::UserError);
  Console console;
  EXPECT_THROW(runCommandByName({command}, addStageTables, "prob", good, console), urban_nav_core::UserError);
}

/// Keeps what a console would print.
class Kept final : public RunListener {
 public:
  void takeLine(Kind kind, const std::string& line) override { lines.emplace_back(kind, line); }
  void takeProgress(const std::string& label, std::int64_t done, std::int64_t total) override {
    steps.push_back(label + " " + std::to_string(done) + "/" + std::to_string(total));
  }

  std::vector<std::pair<Kind, std::string>> lines;
  std::vector<std::string> steps;
};

TEST(RunListener, ReceivesLinesAndEveryStepInPlaceOfTheTerminal) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Kept kept;
  {
    Console console(kept);
    console.print("result\n");
    console.warn("odd");
    console.transient("moving");
    Progress progress(console, "vo", "frames", 2);
    progress.update(1);
    progress.update(2);
    progress.finish(2);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(), "");
  ASSERT_EQ(kept.lines.size(), 3U);
  EXPECT_EQ(kept.lines[0], std::make_pair(RunListener::Kind::Result, std::string("result\n")));
  EXPECT_EQ(kept.lines[1], std::make_pair(RunListener::Kind::Warning, std::string("odd")));
  EXPECT_EQ(kept.lines[2].second.rfind("vo: 2 frames", 0), 0U) << kept.lines[2].second;
  EXPECT_EQ(kept.steps, (std::vector<std::string>{"vo 1/2", "vo 2/2", "vo 2/2"}));
}

TEST(CommandLine, PrintsItsVersion) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(call({}, {"--version"}), 0);
  const std::string text = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(text.rfind("urban_nav ", 0), 0u) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '.'), 2) << text;
  EXPECT_EQ(text.back(), '\n');
}

TEST(CommandLine, RunsTheActionOfACommandThatHasActions) {
  std::string ran;
  Command group;
  group.name = "group";
  for (const char* const name : {"first", "second"}) {
    Command action = probe([&ran, name](const Arguments& arguments) {
      ran = name + (" " + arguments.get("INPUT"));
      return 0;
    });
    action.name = name;
    group.actions.push_back(action);
  }
  EXPECT_EQ(call({group}, {"group", "second", "x", "-o", "there"}), 0);
  EXPECT_EQ(ran, "second x");
  EXPECT_EQ(call({group}, {"group", "--help"}), 0);
  EXPECT_EQ(call({group}, {"group", "first", "--help"}), 0);
  EXPECT_EQ(call({group}, {"group"}), 2) << "the action is missing";
  EXPECT_EQ(call({group}, {"group", "third"}), 2);
  EXPECT_EQ(call({group}, {"group", "first", "x"}), 2) << "--out is missing";
}

TEST(CommandLine, DistinguishesErrorsOfTheUserFromFaultsOfTheData) {
  const Command fine = probe([](const Arguments&) { return 0; });
  EXPECT_EQ(call({fine}, {}), 2);
  EXPECT_EQ(call({fine}, {"--help"}), 0);
  EXPECT_EQ(call({fine}, {"dance"}), 2);
  EXPECT_EQ(call({fine}, {"probe", "--help"}), 0) << "although --out is missing";
  EXPECT_EQ(call({fine}, {"probe", "x"}), 2) << "--out is missing";
  EXPECT_EQ(call({fine}, {"probe", "x", "-o", "d", "--unknown"}), 2);
  EXPECT_EQ(call({fine}, {"probe", "x", "-o", "d", "--kind", "c"}), 2);
  EXPECT_EQ(call({probe([](const Arguments& a) { return static_cast<int>(a.integer("threads", 1, 1, 64)); })},
                 {"probe", "x", "-o", "d", "--threads", "0"}),
            2);
  EXPECT_EQ(call({probe([](const Arguments&) -> int { throw urban_nav_core::DataError("x", "is empty", ""); })},
                 {"probe", "x", "-o", "d"}),
            1);
  EXPECT_EQ(call({probe([](const Arguments&) -> int { throw std::runtime_error("the disk is full"); })},
                 {"probe", "x", "-o", "d"}),
            1);
}

TEST(CommandLine, AcceptsTheParametersOfItsStages) {
  EXPECT_EQ(call({mapCommand(makeStages)}, {"map", "--help", "--set", "swf_vo.window=25"}), 0);
  EXPECT_EQ(call({mapCommand(makeStages)}, {"map", "--help", "--set", "swf_vo.window=0"}), 2);
  EXPECT_EQ(call({mapCommand(makeStages)}, {"map", "--help", "--set", "swf_vo.widow=3"}), 2);
  EXPECT_EQ(call({mapCommand(makeStages)}, {"map", "--help", "--set", "swf_vi.window=3"}), 2);
  EXPECT_EQ(call({mapCommand(makeStages)}, {"map", "/nowhere", "--out", "/tmp/x", "--stages", "vo"}), 2);
}

TEST(CommandLine, EveryCommandTakesTheCommonOptions) {
  const std::vector<Command> commands = {mapCommand(makeStages), convertCommand(), evaluateCommand(), infoCommand(),
                                         simulateCommand()};
  for (const Command& command : commands) {
    const char* name = command.name.c_str();
    EXPECT_EQ(call(commands, {name, "--help", "--json", "x", "--threads", "1", "--set", "swf_vo.window=25"}), 0)
        << name;
    EXPECT_EQ(call(commands, {name, "--help", "--set", "swf_vo.window=0"}), 2) << name;
    EXPECT_EQ(call(commands, {name, "--help", "--config", "/nowhere.yaml"}), 2) << name;
  }
  EXPECT_EQ(call(commands, {"info", "/tmp", "--set", "swf_vo.window=0"}), 2);
}

TEST(CommandLine, KeepsPositionalsApart) {
  Command command;
  command.name = "turn";
  command.options = {{"FORMAT", "", "", true, false, {"a", "b"}}, {"SRC", "", "", true, false, {}}};
  command.run = [](const Arguments& arguments, Console&) {
    EXPECT_EQ(arguments.get("FORMAT"), "a");
    EXPECT_EQ(arguments.get("SRC"), "folder");
    return 0;
  };
  EXPECT_EQ(call({command}, {"turn", "a", "folder"}), 0);
  EXPECT_EQ(call({command}, {"turn", "a"}), 2);
  EXPECT_EQ(call({command}, {"turn", "a", "folder", "more"}), 2);
}

TEST(Json, KeepsOrderAndHidesWhatIsNotFinite) {
  Json json = Json::object();
  json["z"] = 1;
  json["a"] = std::numeric_limits<double>::quiet_NaN();
  json["list"] = Json::array();
  json["list"].append("x\"y");
  json["z"] = 0.1;
  EXPECT_EQ(json.print(), "{\n  \"z\": 0.1,\n  \"a\": null,\n  \"list\": [\n    \"x\\\"y\"\n  ]\n}\n");
}

TEST(PrintDuration, ReadsLikeAClock) {
  EXPECT_EQ(printDuration(7.4), "0:07");
  EXPECT_EQ(printDuration(754), "12:34");
  EXPECT_EQ(printDuration(3723), "1:02:03");
}

}  // namespace
}  // namespace urban_nav
