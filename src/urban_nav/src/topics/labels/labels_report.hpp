// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/labels/labels_run.hpp"

namespace urban_nav {

/// Returns the section of the report: a picture of the classes and a table of their extents.
Section labelsSection(const LabelsRun& run);
/// Returns defects of the data, for the console and the report.
std::vector<std::string> labelsWarnings(const LabelsRun& run);
/// Returns labels.csv: `class,points,area_m2,length_m,probability_mean`, over all maps.
std::string printLabelsCsv(const LabelsRun& run);
/// Returns the object of summary.json.
Json toJson(const LabelsRun& run);

}  // namespace urban_nav
