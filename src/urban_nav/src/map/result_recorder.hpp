// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Figures of the run of a stage, for diagnostics.
struct StageFigures {
  std::string stage;                                        ///< its key in summary.json: "swf_vo"
  std::vector<std::string> warnings;                        ///< about the data
  std::vector<std::pair<std::string, std::string>> values;  ///< names and texts of its object in summary.json
};

/// Throws UserError unless a path ends in ".mcap".
void checkResultPath(const std::string& path);

/// Writes the results of the sessions of a store as a recording at `path`. `memory_mb`: of the command. Returns the
/// files that it has written.
using ResultRecorder =
    std::function<std::vector<std::string>(urban_nav_store::Store& store, const std::string& path, double memory_mb,
                                           const std::vector<StageFigures>& figures)>;

}  // namespace urban_nav
