// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_command.hpp"

#include <utility>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "inspect/store_info.hpp"
#include "inspect/stores_command.hpp"
#include "join/join_pieces.hpp"
#include "join/release_addition.hpp"
#include "join/release_command.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

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

JoinOptions readOptions(const Arguments& arguments, const std::string& out, Console& console) {
  JoinOptions options{arguments.all("STORE"), out, loadParameters(arguments),
                      static_cast<int>(arguments.integer("threads", 0, 1, 1024))};
  for (const std::string& warning : parameterWarnings(options.parameters)) console.warn(warning);
  return options;
}

/// Reports a joined store.
int reportJoin(const JoinRun& run, const Arguments& arguments, Console& console) {
  console.info(closuresSentence(run));
  for (const JoinRun::Apart& each : run.apart)
    console.info("session " + each.session + " is a separate map: " + each.reason);
  const StoreInfo info = readStoreInfo(arguments.get("output"));
  console.print(toText(info));
  Json json = toJson(info);
  addToJson(run, json);
  writeSummary(arguments, json);
  return 0;
}

int runPlan(const Arguments& arguments, const StageFactory& make_stages, Console& console) {
  const std::string folder = arguments.get("plan");
  const JoinPlan plan = planJoin(readOptions(arguments, folder, console), make_stages(), console);
  for (const std::string& warning : plan.warnings) console.warn(warning);
  console.info(std::to_string(plan.candidates.size()) + " candidates for closures in " +
               std::to_string(plan.pieces.size()) + " pieces: urban_nav join --piece FILE for each, then urban_nav " +
               "join --finish " + folder + " -o STORE");
  for (const std::string& piece : plan.pieces) console.print(folder + "/" + piece + "\n");
  writeSummary(arguments, toJson(plan));
  return 0;
}

int runPiece(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::string path = arguments.get("piece");
  const PieceResult result = measurePiece(path, loadParameters(arguments), console);
  console.info(std::to_string(result.candidates) + " candidates measured");
  console.print(path + ".done\n");
  writeSummary(arguments, Json::object({{"candidates", result.candidates},
                                        {"accepted_stereo", result.accepted_stereo},
                                        {"accepted_icp", result.accepted_icp},
                                        {"rejected", result.rejected},
                                        {"ms_median", result.ms_median}}));
  return 0;
}

int runOnto(const Arguments& arguments, const StageFactory& make_stages, Console& console) {
  const ReleaseAddition addition = addToRelease(
      arguments.get("onto"), readOptions(arguments, arguments.get("output"), console), make_stages(), console);
  Json json = toJson(addition.release);
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : addition.release.warnings) {
    console.warn(warning);
    warnings.append(warning);
  }
  Json& rows = json["added"] = Json::array();
  for (const AddedSession& added : addition.added) {
    console.print("session " + added.session + ": " +
                  (added.kept ? std::to_string(added.keyframes) + " keyframes and " + std::to_string(added.places) +
                                    " places added"
                              : added.reason) +
                  "\n");
    rows.append(Json::object({{"session", added.session},
                              {"joined", added.joined},
                              {"kept", added.kept},
                              {"places", added.places},
                              {"keyframes", added.keyframes},
                              {"reason", added.reason}}));
  }
  writeSummary(arguments, json);
  return 0;
}

/// Throws UserError for options of different kinds of join.
void checkOptions(const Arguments& arguments) {
  const bool is_plan = arguments.has("plan"), is_piece = arguments.has("piece"), is_finish = arguments.has("finish");
  const auto require = [](bool good, const std::string& found, const std::string& allowed) {
    if (!good) throw UserError("urban_nav join", found, allowed);
  };
  require(is_plan + is_piece + is_finish + arguments.has("onto") <= 1,
          "more than one of --plan, --piece, --finish and --onto", "only one");
  const bool needs_output = !is_plan && !is_piece, needs_stores = !is_piece && !is_finish;
  require(arguments.has("output") == needs_output, needs_output ? "no -o" : "-o with --plan or --piece",
          needs_output ? "-o STORE" : "no -o with --plan or --piece");
  require(arguments.all("STORE").empty() != needs_stores, needs_stores ? "no STORE" : "STORE with --piece or --finish",
          needs_stores ? "at least one session store" : "no STORE: the plan names the stores");
}

int runJoin(const Arguments& arguments, const StageFactory& make_stages, Console& console) {
  checkOptions(arguments);
  if (arguments.has("plan")) return runPlan(arguments, make_stages, console);
  if (arguments.has("piece")) return runPiece(arguments, console);
  if (arguments.has("onto")) return runOnto(arguments, make_stages, console);
  JoinOptions options = readOptions(arguments, arguments.get("output"), console);
  const JoinRun run = arguments.has("finish")
                          ? finishJoin(arguments.get("finish"), std::move(options), make_stages(), console)
                          : joinStores(std::move(options), make_stages(), console);
  return reportJoin(run, arguments, console);
}

}  // namespace

Command joinCommand(StageFactory make_stages) {
  Command command = storesCommand(false);
  command.name = "join";
  command.summary = "Joins sessions that were mapped separately into one map.";
  const std::vector<Option> modes = {
      {"--plan", "DIR", "splits the work: writes plan.json and independent pieces into this folder", false, false, {}},
      {"--piece",
       "FILE",
       "measures one piece of a plan and writes FILE.done, on any host, at any time",
       false,
       false,
       {}},
      {"--finish",
       "DIR",
       "relaxes the graph with the results of all pieces of a plan, and writes the store",
       false,
       false,
       {}},
      {"--onto",
       "RELEASE",
       "adds the sessions to a release, without the stores it was made from; sessions without new places are not kept",
       false,
       false,
       {}}};
  command.options.insert(command.options.begin() + 2, modes.begin(), modes.end());
  command.examples = {"urban_nav join monday/session.db tuesday/session.db -o both.db",
                      "urban_nav join */session.db --plan pieces",
                      "for piece in pieces/piece_*.json; do urban_nav join --piece $piece; done",
                      "urban_nav join --finish pieces -o site.db"};
  command.more_help = parametersHelp;
  command.run = [make_stages = std::move(make_stages)](const Arguments& arguments, Console& console) {
    return runJoin(arguments, make_stages, console);
  };
  return command;
}

}  // namespace urban_nav
