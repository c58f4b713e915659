// SPDX-License-Identifier: BSD-3-Clause
#include "map/output_files.hpp"

#include <algorithm>
#include <set>

#include "map/trajectory_files.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

namespace {

constexpr const char* kClosuresFile = "closures.csv";

/// Returns the session, from 0, for a file name of this pattern ("landmarks#.ply"); nullopt if it does not match.
std::optional<std::size_t> matchSession(const std::string& name, const std::string& pattern) {
  const std::size_t at = pattern.find('#');
  if (at == std::string::npos) return name == pattern ? std::optional<std::size_t>(0) : std::nullopt;
  const std::string head = pattern.substr(0, at), tail = pattern.substr(at + 1);
  if (name.size() < head.size() + tail.size() || name.compare(0, head.size(), head) != 0 ||
      name.compare(name.size() - tail.size(), tail.size(), tail) != 0)
    return std::nullopt;
  const std::string suffix = name.substr(head.size(), name.size() - head.size() - tail.size());
  if (suffix.empty()) return 0;
  const auto number = suffix.front() == '_' ? urban_nav_core::parseInteger(suffix.substr(1)) : std::nullopt;
  return number && *number >= 2 ? std::optional(static_cast<std::size_t>(*number - 1)) : std::nullopt;
}

bool matches(const std::string& name, const std::vector<std::string>& patterns, std::size_t first_session) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
    const std::optional<std::size_t> session = matchSession(name, pattern);
    return session && (*session >= first_session || pattern.find('#') == std::string::npos);
  });
}

bool usesClosures(const StageList& stages) {
  return std::any_of(stages.begin(), stages.end(), [](const Stage* stage) { return stage->describe().uses_closures; });
}

/// Names of files that this run may keep in the folder.
struct OwnedNames {
  std::vector<std::string> by_run;       ///< of its stages, and those common to all runs
  std::vector<std::string> by_left_out;  ///< of the stages that do not run
};

OwnedNames ownedNames(const std::vector<std::unique_ptr<Stage>>& all, const StageList& selected) {
  OwnedNames names{trajectoryFileNames(), {}};
  names.by_run.emplace_back(kClosuresFile);
  for (const std::unique_ptr<Stage>& stage : all) {
    const bool is_selected = std::find(selected.begin(), selected.end(), stage.get()) != selected.end();
    std::vector<std::string>& to = is_selected ? names.by_run : names.by_left_out;
    const std::vector<std::string> files = stage->describe().files;
    to.insert(to.end(), files.begin(), files.end());
  }
  return names;
}

}  // namespace

void writeOutputFiles(const OutputFolder& folder, const MapContext& context,
                      const std::vector<std::unique_ptr<Stage>>& all, const StageList& selected,
                      const std::vector<StageResult>& results) {
  const std::vector<const SessionOdometry*> runs = context.runs();
  std::vector<OutputFile> files = trajectoryFiles(runs, context.trajectories);
  if (usesClosures(selected))
    files.push_back({kClosuresFile, [&] {
                       std::vector<urban_nav_core::MetricClosure> closures = context.closures;
                       std::vector<ClosureAssessment> assessments = context.assessments;
                       sortClosures(context.names, closures, assessments);
                       return printClosureRows(closures, assessments);
                     }});
  for (const StageResult& result : results) files.insert(files.end(), result.files.begin(), result.files.end());
  std::set<std::string> written;
  for (const StageResult& result : results) written.insert(result.written_files.begin(), result.written_files.end());
  for (const OutputFile& file : files) {
    if (file.content) {
      folder.write(file.name, file.content());
      written.insert(file.name);
    } else {
      folder.remove(file.name);
    }
  }
  const OwnedNames names = ownedNames(all, selected);
  for (const std::string& name : folder.list()) {
    if (written.count(name) != 0) continue;
    const bool by_run = matches(name, names.by_run, 0);
    if (by_run ? matches(name, names.by_run, context.sessionsKept()) : matches(name, names.by_left_out, 0))
      folder.remove(name);
  }
}

}  // namespace urban_nav
