// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line/console.hpp"
#include "input/open.hpp"
#include "pipeline/parameters.hpp"

namespace urban_nav {

struct MapRequest {
  std::vector<std::string> inputs;  ///< folders and bags
  std::string out;                  ///< folder
  std::vector<std::string> stages;  ///< asked for; empty: all whose inputs exist
  std::string truth;                ///< file; empty: what is found in the inputs
  std::string closures;             ///< file; empty: none
  std::string json;                 ///< a copy of summary.json; empty: none
  SourceOptions source;
  AllParameters parameters;
  int threads = 0;  ///< 0: one per core
  /// The share, 0...1, of a recording that the inputs are so far. Below 1 the report stays marked as unfinished, and with any value it is written once, at the
  /// end: what it shows from the run before is better than a run that has just begun.
  std::optional<double> so_far = std::nullopt;
  std::string store = {};     ///< session store to go on from; empty: none
  std::string localise = {};  ///< session store whose map stays as it is; empty: none
};

/// The stages that docs/files.md names, in their order, and those of them that this suite has.
const std::vector<std::string>& knownStages();
const std::vector<std::string>& existingStages();

/// Are views of the sessions kept, for the stage loops of this run or another one, and to be localised in? Unless stages were asked for and it is not among them.
bool keepsViews(const MapRequest& request);

/// Runs the stages over the inputs and writes the files of docs/files.md. UserError for mistakes of the request,
/// DataError where the inputs do not allow it.
void runMap(const MapRequest& request, Console& console);

}  // namespace urban_nav
