// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/map_result.hpp"

#include <algorithm>
#include <filesystem>

#include "evaluation/evaluation_report.hpp"
#include "evaluation/truth.hpp"
#include "report/plot.hpp"
#include "stages/graph/graph_report.hpp"
#include "stages/loops/loops_report.hpp"
#include "stages/vo/vo_files.hpp"
#include "stages/vo/vo_report.hpp"
#include "stages/vo/vo_summary.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

std::vector<const VoRun*> runsOf(const MapOutcome& outcome) {
  std::vector<const VoRun*> runs;
  for (const std::unique_ptr<VoStage>& stage : outcome.stages) runs.push_back(&stage->run());
  return runs;
}

/// Nothing is known of the truth of earlier sessions.
std::vector<std::optional<Evaluation>> behindEarlier(const MapOutcome& outcome,
                                                     std::vector<std::optional<Evaluation>> evaluations) {
  evaluations.insert(evaluations.begin(), outcome.earlier.runs.size(), std::nullopt);
  return evaluations;
}

std::vector<urban_nav_core::StampNs> stampsOf(const VoRun& run) {
  std::vector<urban_nav_core::StampNs> stamps;
  for (const VoRow& row : run.rows) stamps.push_back(row.stamp);
  return stamps;
}

std::vector<urban_nav_core::CovarianceRow> covariancesOf(const VoRun& run) {
  std::vector<urban_nav_core::CovarianceRow> rows;
  for (const swf_vo::Settled& settled : run.settled)
    rows.push_back({settled.stamp, settled.status.health, settled.T_odom_base.covariance});
  return rows;
}

std::vector<urban_nav_core::CovarianceRow> covariancesOf(const VoRun& run,
                                                         const std::vector<urban_nav_core::Matrix6d>& relaxed) {
  std::vector<urban_nav_core::CovarianceRow> rows = covariancesOf(run);
  for (std::size_t i = 0; i < std::min(rows.size(), relaxed.size()); ++i) rows[i].covariance = relaxed[i];
  return rows;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// The last part of each path.
std::string titleOf(const std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  for (const std::string& input : inputs) {
    const std::filesystem::path path = std::filesystem::absolute(input).lexically_normal();
    names.push_back((path.has_filename() ? path : path.parent_path()).filename().string());
  }
  return joined(names);
}

double realtimeFactor(const MapOutcome& outcome, const VoSummary& summary) {
  return summary.seconds / std::max(1e-9, outcome.usage.wallSeconds());
}

std::vector<Tile> tilesOf(const MapOutcome& outcome, const VoSummary& summary) {
  return {{forPerson(summary.distance_m, 4), "m", "driven", Grade::Plain},
          {std::to_string(summary.frames), "", "stereo frames", Grade::Plain},
          {forPerson(summary.seconds, 4), "s", "of data", Grade::Plain},
          {forPerson(realtimeFactor(outcome, summary), 3), "x", "real time, reading included", Grade::Plain},
          {forPerson(summary.ms_median, 3), "ms", "median time in the filter", Grade::Plain}};
}

PageTable parametersTable(const AllParameters& parameters) {
  PageTable table{"Parameters", {"parameter", "value", "from"}, {}, ""};
  for (const std::vector<urban_nav_core::Setting>* settings : parameters.settings()) {
    for (const urban_nav_core::Setting& setting : *settings) {
      table.rows.push_back({urban_nav_core::fullName(setting.stage, setting.name),
                            urban_nav_core::printValue(setting.value), setting.origin});
    }
  }
  return table;
}

PageTable inputsTable(const MapOutcome& outcome) {
  PageTable table{"Inputs", {"input", "kind", "frames", "size", "f (px)", "baseline (m)", "notes"}, {}, ""};
  for (std::size_t i = 0; i < outcome.infos.size(); ++i) {
    const SourceInfo& info = outcome.infos[i];
    const urban_nav_core::Pinhole& left = info.camera.left;
    table.rows.push_back({info.name, info.kind, std::to_string(outcome.stages[i]->run().rows.size()),
                          std::to_string(left.width) + "x" + std::to_string(left.height), forPerson(left.fx, 6),
                          forPerson(info.camera.baseline, 5), joined(info.notes)});
  }
  return table;
}

/// The truth of each session, now that nothing can reach the estimates any more. One that cannot be read costs the
/// comparison, not the map.
std::vector<std::optional<Evaluation>> compare(const MapOutcome& outcome, const std::vector<Session>& sessions,
                                               bool relaxed, Console* console) {
  std::vector<std::optional<Evaluation>> evaluations;
  EvaluationOptions options;
  options.spans = {{urban_nav_core::Span::Unit::Metres, 10.0}, {urban_nav_core::Span::Unit::Metres, 100.0}};
  const std::size_t earlier = outcome.earlier.runs.size();
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const VoRun& run = outcome.stages[i]->run();
    // The graph has no pose of a session without a single step.
    const bool by_graph = relaxed && !outcome.graph->trajectory(earlier + i).empty();
    evaluations.emplace_back();
    try {
      const std::optional<TrajectoryFile> truth =
          outcome.request.truth.empty()
              ? findTruth(sessions[i], outcome.infos[i], outcome.request.source)
              : truthOfBase(readTrajectory(outcome.request.truth), outcome.infos[i], stampsOf(run));
      if (!truth) continue;
      TrajectoryFile estimate{outcome.folder.file("trajectory.tum"),
                              true,
                              by_graph ? outcome.graph->trajectory(earlier + i) : trajectoryOf(run),
                              {}};
      for (const urban_nav_core::StampedPose& pose : estimate.trajectory) estimate.poses.push_back(pose.pose);
      evaluations.back() = evaluate(
          *truth, estimate, by_graph ? covariancesOf(run, outcome.graph->covariances[earlier + i]) : covariancesOf(run),
          options);
      if (console != nullptr)
        console->info("truth: " + truth->path +
                      (outcome.request.truth.empty() ? " (found; it is used for the report alone)" : ""));
    } catch (const urban_nav_core::Error& error) {
      if (console != nullptr) console->warn(std::string("the truth is left out of the report: ") + error.what());
    }
  }
  return evaluations;
}

/// `session`: its number where there are several, else 0.
void addEvaluation(Page& page, const Evaluation& evaluation, std::size_t session) {
  const std::string of = session > 0 ? " (session " + std::to_string(session) + ")" : "";
  for (Verdict& verdict : evaluationVerdicts(evaluation)) {
    if (session > 0) verdict.headline = "Session " + std::to_string(session) + ": " + verdict.headline;
    page.verdicts.push_back(verdict);
  }
  for (Tile& tile : evaluationTiles(evaluation)) {
    tile.label += of;
    page.tiles.push_back(tile);
  }
  Section section = evaluationSection(evaluation);
  if (session > 0) section.id += std::to_string(session);
  section.title += of;
  page.sections.push_back(std::move(section));
}

Page pageOf(const MapOutcome& outcome, bool running) {
  const std::vector<const VoRun*> runs = runsOf(outcome);
  const VoSummary summary = summarise(runs);
  Page page;
  page.title = "Map of " + titleOf(outcome.request.inputs);
  page.subtitle = std::string(outcome.graph && outcome.graph->relaxed.accepted > 0 ? "Visual odometry, relaxed"
                                                                                   : "Visual odometry") +
                  ": where the robot went, and how far to trust it.";
  page.running = running;
  page.progress = outcome.progress;
  page.tiles = tilesOf(outcome, summary);
  page.verdicts = voVerdicts(summary);
  for (std::size_t i = 0; i < outcome.evaluations.size(); ++i)
    if (outcome.evaluations[i]) addEvaluation(page, *outcome.evaluations[i], runs.size() > 1 ? i + 1 : 0);
  if (outcome.loops && outcome.loops->candidates > 0) {
    for (const Verdict& verdict : loopsVerdicts(*outcome.loops)) page.verdicts.push_back(verdict);
    const GraphRun* without_icp = outcome.without_icp ? &*outcome.without_icp : nullptr;
    page.sections.insert(page.sections.begin(),
                         loopsSection(*outcome.loops, runsOfGraph(outcome), outcome.session_names,
                                      outcome.graph ? &*outcome.graph : nullptr, without_icp));
  }
  if (outcome.graph) {
    for (const Verdict& verdict : graphVerdicts(*outcome.graph)) page.verdicts.push_back(verdict);
    if (!outcome.graph->closures.empty() || outcome.graph->sessions.size() > 1)  // else it is odometry's own picture
      page.sections.insert(page.sections.begin(),
                           graphSection(*outcome.graph, runsOfGraph(outcome), behindEarlier(outcome, outcome.before),
                                        behindEarlier(outcome, outcome.evaluations)));
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (Section& section : voSections(*runs[i], i >= outcome.evaluations.size() || !outcome.evaluations[i])) {
      if (runs.size() > 1) {
        section.id += std::to_string(i + 1);
        section.title += " (session " + std::to_string(i + 1) + ")";
      }
      page.sections.push_back(std::move(section));
    }
  }
  Section how{
      "how", "How it was made", "", {}, {}, {inputsTable(outcome), parametersTable(outcome.request.parameters)}};
  if (!summary.warnings.empty()) {
    PageTable warnings{"Warnings", {"what was wrong with the data"}, {}, ""};
    for (const std::string& warning : summary.warnings) warnings.rows.push_back({warning});
    how.tables.insert(how.tables.begin(), warnings);
  }
  page.sections.push_back(how);
  page.footer = "urban_nav map, " + forPerson(outcome.usage.wallSeconds(), 3) + " s of time, " +
                forPerson(outcome.usage.cpuSeconds(), 3) +
                " s of processor. Poses and figures: trajectory.tum, covariance.csv, stats.csv beside this file.";
  return page;
}

Json summaryOf(const MapOutcome& outcome, const VoSummary& summary) {
  Json json = Json::object();
  json["wall_s"] = outcome.usage.wallSeconds();
  json["cpu_s"] = outcome.usage.cpuSeconds();
  json["peak_rss_bytes"] = Usage::peakRssBytes();
  json["realtime_factor"] = realtimeFactor(outcome, summary);
  json["distance_m"] = summary.distance_m;
  json["frames"] = summary.frames;
  json["duration_s"] = summary.seconds;
  json["sessions"] = outcome.stages.size();
  Json& inputs = json["inputs"] = Json::array();
  for (const std::string& input : outcome.request.inputs) inputs.append(input);
  const auto evaluated = std::find_if(outcome.evaluations.begin(), outcome.evaluations.end(),
                                      [](const auto& evaluation) { return evaluation.has_value(); });
  if (evaluated != outcome.evaluations.end()) addToJson(**evaluated, json);
  json["swf_vo"] = toJson(summary);
  if (!outcome.localised.empty()) json["localisation"] = toJson(outcome.localised.front());
  if (outcome.loops) json["loop_metric"] = toJson(*outcome.loops);
  if (outcome.graph)
    json["pose_graph"] =
        toJson(*outcome.graph, behindEarlier(outcome, outcome.before), behindEarlier(outcome, outcome.evaluations));
  json["parameters"] = parametersJson(outcome.request.parameters);
  return json;
}

/// What ailed the run, most often, in the words of the frame that first said so; empty where no frame had a reason.
std::string troubleOf(const std::vector<const VoRun*>& runs, const VoSummary& summary) {
  if (summary.reason_counts.empty()) return {};
  const auto most = std::max_element(summary.reason_counts.begin(), summary.reason_counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  std::string counts, sentence;
  for (const char* name : {"DEGRADED", "LOST", "RECOVERED"}) {
    const std::int64_t count = summary.status_counts.at(name);
    if (count > 0) counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  for (const VoRun* run : runs)
    for (const VoRow& row : run->rows)
      if (sentence.empty() && swf_vo::toString(static_cast<swf_vo::Reason>(row.status.reason)) == most->first)
        sentence = row.status.sentence;
  return counts + " of " + std::to_string(summary.frames) +
         " frames; most often: " + (sentence.empty() ? most->first : sentence);
}

}  // namespace

std::vector<const VoRun*> runsOfGraph(const MapOutcome& outcome) {
  std::vector<const VoRun*> runs;
  for (const VoRun& run : outcome.earlier.runs) runs.push_back(&run);
  for (const VoRun* run : runsOf(outcome)) runs.push_back(run);
  return runs;
}

void writeReport(const MapOutcome& outcome) { outcome.folder.write("report.html", renderPage(pageOf(outcome, true))); }

void finishMap(MapOutcome& outcome, const std::vector<Session>& sessions, Console& console) {
  if (outcome.graph) outcome.before = compare(outcome, sessions, false, nullptr);
  outcome.evaluations = compare(outcome, sessions, outcome.graph.has_value(), &console);
  const std::vector<const VoRun*> runs = runsOf(outcome);
  const VoSummary summary = summarise(runs);
  outcome.folder.write("stats.csv", statsCsv(runs));
  outcome.progress = outcome.request.so_far.value_or(1.0);
  outcome.folder.write("report.html", renderPage(pageOf(outcome, outcome.progress < 1.0)));
  const std::string text = summaryOf(outcome, summary).print();
  outcome.folder.write("summary.json", text);
  if (!outcome.request.json.empty()) urban_nav_core::writeAtomically(outcome.request.json, text);
  if (const std::string trouble = troubleOf(runs, summary); !trouble.empty()) console.warn(trouble);
  console.info(std::to_string(summary.frames) + " frames, " + forPerson(summary.distance_m, 4) + " m" +
               (sessions.size() > 1 ? ", " + std::to_string(sessions.size()) + " sessions" : "") + ", " +
               forPerson(realtimeFactor(outcome, summary), 3) + " times real time");
  console.print(outcome.folder.file("report.html") + "\n" + outcome.folder.file("trajectory.tum") + "\n");
}

}  // namespace urban_nav
