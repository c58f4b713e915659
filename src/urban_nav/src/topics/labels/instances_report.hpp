// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/labels/labels_run.hpp"

namespace urban_nav {

/// Returns the table of the report: numbers and sizes of the vehicles, people and poles of all maps.
PageTable instancesTable(const LabelsRun& run);
/// Returns instances.csv: `map,kind,x,y,z,heading_deg,length_m,width_m,height_m,points,probability,first_ns,last_ns`,
/// one row per object, in the frame `map`; z is that of the ground.
std::string printInstancesCsv(const LabelsRun& run);
/// Returns the number of objects by kind, for summary.json.
Json instancesJson(const LabelsRun& run);

}  // namespace urban_nav
