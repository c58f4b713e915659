// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"
#include "base/parameters.hpp"
#include "view/page_routes.hpp"
#include "view/page_serving.hpp"
#include "view/stored_source.hpp"
#include "view/view.hpp"

namespace urban_nav {

namespace {

StoredSource::Values commonOptions(const Arguments& arguments) {
  StoredSource::Values values;
  for (const char* name : {"config", "set", "threads"})
    if (arguments.has(name)) values[name] = arguments.all(name);
  return values;
}

int runView(const Arguments& arguments, const ParameterTables& tables, Console& console) {
  checkCommonOptions(arguments);
  PageServing serving(arguments);
  PageEvents events;
  StoredSource source(arguments.get("STORE"), arguments.get("STORE2", ""), arguments.has("read-only"),
                      commonOptions(arguments), tables, events);
  const PageRoutes routes(source, events);
  serving.run([&](const HttpRequest& request) { return routes.answer(request); }, [&] { source.poll(); },
              arguments.get("STORE"), console);
  return 0;
}

}  // namespace

Command viewCommand(ParameterTables tables) {
  Command command;
  command.name = "view";
  command.summary = "Shows a map and its closures in the browser; corrections are edits as by `edge`.";
  command.options = {{"STORE", "", "session.db of a map", true, false, {}},
                     {"STORE2",
                      "",
                      "another store to compare: its poses of the sessions of STORE, and their distances",
                      false,
                      false,
                      {}}};
  for (const Option& option : pageServingOptions("do not allow edits")) command.options.push_back(option);
  for (const Option& option : {configOption(), setOption(), threadsOption()}) command.options.push_back(option);
  command.examples = {"urban_nav view out/session.db", "urban_nav view out/session.db before/session.db",
                      "urban_nav view out/session.db --read-only --port 8080"};
  command.more_help = commonHelp;
  command.run = [tables = std::move(tables)](const Arguments& arguments, Console& console) {
    return runView(arguments, tables, console);
  };
  return command;
}

}  // namespace urban_nav
