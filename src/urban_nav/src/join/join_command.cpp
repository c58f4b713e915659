// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_command.hpp"

#include <utility>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "inspect/store_info.hpp"
#include "join/join_run.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav {

namespace {

std::string closuresSentence(const JoinRun& run) {
  return std::to_string(run.candidates) + " candidates for closures: " + std::to_string(run.accepted_stereo) +
         " accepted by stereo, " + std::to_string(run.accepted_icp) + " by ICP, " + std::to_string(run.rejected) +
         " rejected";
}

void addToJson(const JoinRun& run, Json& json) {
  Json& apart = json["apart"] = Json::array();
  for (const JoinRun::Apart& each : run.apart) {
    Json row = Json::object();
    row["session"] = each.session;
    row["reason"] = each.reason;
    apart.append(row);
  }
  json["candidates"] = run.candidates;
  json["accepted_stereo"] = run.accepted_stereo;
  json["accepted_icp"] = run.accepted_icp;
  json["rejected"] = run.rejected;
  Json& between = json["closures_between"] = Json::array();
  for (const JoinRun::Between& each : run.between) {
    Json row = Json::object();
    row["session_a"] = each.a;
    row["session_b"] = each.b;
    row["candidates"] = each.candidates;
    row["accepted"] = each.accepted;
    between.append(row);
  }
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : run.warnings) warnings.append(warning);
}

int runJoin(const Arguments& arguments, const StageFactory& make_stages, Console& console) {
  JoinOptions options{arguments.all("STORE"), arguments.get("output"), loadParameters(arguments),
                      static_cast<int>(arguments.integer("threads", 0, 1, 1024))};
  for (const std::string& warning : parameterWarnings(options.parameters)) console.warn(warning);
  const JoinRun run = joinStores(std::move(options), make_stages(), console);
  console.info(closuresSentence(run));
  for (const JoinRun::Apart& each : run.apart)
    console.info("session " + each.session + " is a map of its own: " + each.reason);
  const StoreInfo info = readStoreInfo(arguments.get("output"));
  console.print(toText(info));
  if (!arguments.has("json")) return 0;
  Json json = toJson(info);
  addToJson(run, json);
  urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  return 0;
}

}  // namespace

Command joinCommand(StageFactory make_stages) {
  Command command;
  command.name = "join";
  command.summary = "Makes one map of sessions that were mapped apart.";
  command.options = {{"STORE", "", "session stores; they are only read", true, true, {}},
                     {"-o,--output", "STORE", "store to write; it appears when it is complete", true, false, {}},
                     jsonOption(),
                     configOption(),
                     setOption(),
                     threadsOption()};
  command.examples = {"urban_nav join monday/session.db tuesday/session.db -o both.db"};
  command.more_help = parametersHelp;
  command.run = [make_stages = std::move(make_stages)](const Arguments& arguments, Console& console) {
    return runJoin(arguments, make_stages, console);
  };
  return command;
}

}  // namespace urban_nav
