// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "topics/lo/lo_run.hpp"

namespace urban_nav {

/// Returns sweeps.csv of a session: one row per sweep. A free direction is six numbers separated by blanks; several
/// follow each other.
std::string sweepsCsv(const LoRun& run);

}  // namespace urban_nav
