// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <map>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "base/scratch_folder.hpp"
#include "edits/edits.hpp"
#include "edits/verification.hpp"
#include "map/map_command.hpp"
#include "map/map_pipeline.hpp"
#include "map/store_keys.hpp"
#include "map/stored_run.hpp"
#include "urban_nav/stored_results.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

/// Returns the lines of a text.
std::vector<std::string> splitLines(const std::string& text) {
  std::vector<std::string> lines;
  for (const std::string_view line : urban_nav_core::splitAt(text, '\n'))
    if (!line.empty()) lines.emplace_back(line);
  return lines;
}

/// Returns the arguments of the run of `map` that made the sessions of a store, for some of its recordings.
Arguments storedArguments(Store& store, const Arguments& given, const std::string& out) {
  std::map<std::string, std::vector<std::string>> values = {{"INPUT", given.all("BAG")}, {"out", {out}}};
  const urban_nav_store::SessionId id = store.sessions().all().back().id;
  const std::string prefix = kOptionProperty;
  for (const urban_nav_store::Property& property : store.sessions().properties(id))
    if (property.name.rfind(prefix, 0) == 0) values[property.name.substr(prefix.size())] = splitLines(property.value);
  for (const urban_nav_store::StoredParameter& row : store.sessions().parameters(id))
    if (row.origin != "default") values["set"].push_back(row.name + "=" + row.value);
  if (given.has("threads")) values["threads"] = {given.get("threads")};
  return Arguments(std::move(values), [&given](ParameterSet& set) { given.addTables(set); });
}

/// Returns the sessions of a store for recordings. Throws UserError for a recording without a session.
std::vector<urban_nav_store::SessionId> sessionsOfRecordings(Store& store, const MapOptions& options) {
  std::vector<urban_nav_store::SessionId> found;
  for (const std::string& input : options.inputs) {
    std::vector<MapSession> sessions;
    for (urban_nav_input::InputSession& session :
         urban_nav_input::findSessions({input}, options.source.topics, options.source.sessions)) {
      sessions.emplace_back();
      sessions.back().input = std::move(session);
    }
    for (const urban_nav_store::SessionId& id : sessionIds(options, sessions)) {
      if (!store.sessions().find(id))
        throw UserError(input, "is not a recording of " + store.path(), "recordings that map made this store of");
      found.push_back(id);
    }
  }
  return found;
}

/// Runs all stages of `map` again on recordings of a store, and compares.
std::vector<Difference> verifyStages(Store& store, const Arguments& arguments, const StageFactory& make_stages,
                                     Console& console) {
  const ScratchFolder folder;
  AllStages stages = make_stages();
  MapOptions options = readMapOptions(storedArguments(store, arguments, folder.file("map")), stages);
  const std::vector<urban_nav_store::SessionId> sessions = sessionsOfRecordings(store, options);
  const bool finds_places = options.stages.empty() ||
                            std::find(options.stages.begin(), options.stages.end(), "places") != options.stages.end();
  if (!finds_places) {
    options.closures = folder.file("closures.csv");
    urban_nav_core::writeAtomically(options.closures, readStoredCandidates(store, sessions));
  }
  runMap(options, std::move(stages), console, {});
  Store again(folder.file("map/session.db"), Access::Snapshot);
  std::vector<Difference> differences = compareMeasurements(store, again);
  if (again.sessions().all().size() == store.sessions().all().size()) {
    const std::vector<Difference> relaxed = compareRelaxation(store, again);
    differences.insert(differences.end(), relaxed.begin(), relaxed.end());
  }
  return differences;
}

Json toJson(const std::vector<Difference>& differences) {
  Json json = Json::object({{"same", differences.empty()}});
  Json& rows = json["differences"] = Json::array();
  for (const Difference& each : differences)
    rows.append(
        Json::object({{"stage", each.stage}, {"session", each.session}, {"minute", each.minute}, {"text", each.text}}));
  return json;
}

int runVerify(const Arguments& arguments, const StageFactory& make_stages, Console& console) {
  checkCommonOptions(arguments);
  Store store = urban_nav_store::openForReading(arguments.get("STORE"), Access::Snapshot);
  std::vector<Difference> differences = compareRelaxation(store, store);
  const bool has_recordings = !arguments.all("BAG").empty();
  if (has_recordings) {
    const std::vector<Difference> more = verifyStages(store, arguments, make_stages, console);
    differences.insert(differences.end(), more.begin(), more.end());
  }
  for (const Difference& each : differences)
    console.print(each.stage + ", " + each.session + ", minute " + std::to_string(each.minute) + ": " + each.text +
                  "\n");
  if (differences.empty())
    console.print(std::string("the same: ") + (has_recordings ? "all stages and the relaxation" : "the relaxation") +
                  " of " + store.path() + "\n");
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(differences).print());
  return differences.empty() ? 0 : 1;
}

}  // namespace

Command verifyCommand(StageFactory make_stages) {
  Command command;
  command.name = "verify";
  command.summary = "Recomputes the map of a session store with this program and lists the differences.";
  command.options = {
      {"STORE", "", "session.db of a map; it is only read", true, false, {}},
      {"BAG", "", "recordings of the store: runs all stages on them again, not only the relaxation", false, true, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav verify out/session.db", "urban_nav verify out/session.db monday.bag tuesday.bag"};
  command.more_help = commonHelp;
  command.run = [make_stages = std::move(make_stages)](const Arguments& arguments, Console& console) {
    return runVerify(arguments, make_stages, console);
  };
  return command;
}

}  // namespace urban_nav
