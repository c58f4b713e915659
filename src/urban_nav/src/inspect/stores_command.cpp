// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/stores_command.hpp"

#include "map/stored_run.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_store::Store;

Command storesCommand(bool is_output_required) {
  Command command;
  command.options = {
      {"STORE", "", "session stores; they are only read", is_output_required, true, {}},
      {"-o,--output", "STORE", "store to write; it appears when it is complete", is_output_required, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  return command;
}

void requireFinished(const std::string& store) {
  Store opened = urban_nav_store::openForReading(store, urban_nav_store::Access::Snapshot);
  for (const urban_nav_store::Session& session : opened.sessions().all())
    if (isUnfinished(opened, session))
      throw urban_nav_core::DataError(store,
                                      "session " + session.id + " (" + session.name +
                                          ") is not complete: the run of map that writes it has not finished, or was "
                                          "interrupted",
                                      "the same call of map once more, which continues from there");
}

void writeSummary(const Arguments& arguments, const Json& json) {
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), json.print());
}

}  // namespace urban_nav
