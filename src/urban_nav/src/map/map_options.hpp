// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/parameter_set.hpp"
#include "map/odometry_source.hpp"
#include "urban_nav_input/session/open.hpp"

namespace urban_nav {

/// Options of one run of `map`.
struct MapOptions {
  std::vector<std::string> inputs;  ///< folders and bags
  std::string out;                  ///< folder
  std::vector<std::string> stages;  ///< requested ones; empty: all whose inputs exist
  std::string truth;                ///< file; empty: the ground truth found in the inputs
  std::string closures;             ///< file; empty: none
  std::string json;                 ///< copy of summary.json; empty: none
  urban_nav_input::SourceOptions source;
  ParameterSet parameters;
  int threads = 0;  ///< 0: one per core
  /// Share of an unfinished recording that the inputs cover, 0...1. Below 1 the report is marked as unfinished. With
  /// any value it is written once, at the end: the report of the previous run is more useful than one that starts
  /// empty.
  std::optional<double> so_far = std::nullopt;
  std::string store = {};     ///< session store to continue from; empty: none
  bool overwrite = false;     ///< replaces the results of other inputs in `out`
  std::string localise = {};  ///< session store whose map is only read; empty: none
  OdometryOption odometry = OdometryOption::Auto;
  bool calibrate = false;  ///< estimates delay and mounting of the lasers before the map is rendered
  std::string mcap = {};   ///< file for the results as MCAP; empty: none
  bool strict = false;     ///< exit status 1 if a consistency test fails
};

/// Returns whether --stages allows a stage: it is listed, or the list is empty.
bool isRequested(const MapOptions& options, const std::string& stage);

}  // namespace urban_nav
