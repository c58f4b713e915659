// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"

namespace urban_nav {

/// A file of the output folder. Its content is computed when it is written.
struct OutputFile {
  std::string name;
  std::function<std::string()> content;  ///< empty: the file is removed
};

/// Returns the suffix of the names of the files of a session, before the extension: "" for session 0, "_2" for 1.
std::string fileSuffix(std::size_t session);

/// Order of sections in the report, lowest first. Sections of equal place keep the order of their stages.
namespace report_place {
constexpr int kTrust = 50, kMap = 100, kClosures = 200, kTruth = 300, kLocalization = 400, kOdometry = 500,
              kMethod = 900;
}

struct PlacedSection {
  int place = report_place::kOdometry;
  Section section;
};

/// Results of a stage, as plain data.
struct StageResult {
  std::string method;  ///< word of the report's subtitle: "visual odometry"
  std::vector<Tile> tiles;
  std::optional<Verdict> answer;  ///< assessment of the map, the first verdict
  std::vector<Verdict> verdicts;
  std::vector<PlacedSection> sections;
  std::vector<std::string> data_faults;    ///< defects of the data, for the table of warnings in the report
  std::vector<OutputFile> files;           ///< except the trajectories, which the pipeline writes
  std::vector<std::string> written_files;  ///< written into the output folder by run(), since too large for memory
  std::vector<std::string> failed_tests;   ///< names of consistency tests
  std::optional<Json> summary;             ///< object of summary.json under Stage::Description::key
};

}  // namespace urban_nav
