// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_report.hpp"

#include <algorithm>
#include <filesystem>

#include "base/plot.hpp"
#include "evaluation/evaluation_report.hpp"
#include "map/input_streams.hpp"
#include "map/odometry_summary.hpp"
#include "map/run_totals.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/parameters/print.hpp"

namespace urban_nav {

namespace {

std::string listText(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Returns the last part of each path.
std::string inputNames(const std::vector<std::string>& inputs) {
  std::vector<std::string> names;
  for (const std::string& input : inputs) {
    const std::filesystem::path path = std::filesystem::absolute(input).lexically_normal();
    names.push_back((path.has_filename() ? path : path.parent_path()).filename().string());
  }
  return listText(names);
}

/// Returns the noun for the frames of the sessions.
std::string countedThings(const MapContext& context) {
  bool is_stereo = false, is_laser = false;
  for (const MapSession& session : context.sessions)
    (session.odometry->source == OdometrySource::Laser ? is_laser : is_stereo) = true;
  if (is_stereo && is_laser) return "stereo frames and sweeps";
  return is_laser ? "sweeps" : "stereo frames";
}

std::vector<Tile> runTiles(const MapState& state) {
  const RunTotals extent = ownTotals(state.context);
  return {{urban_nav_core::formatNumber(extent.distance_m, 4), "m", "driven", Grade::Plain},
          {std::to_string(extent.frames), "", countedThings(state.context), Grade::Plain},
          {urban_nav_core::formatNumber(extent.seconds, 4), "s", "of data", Grade::Plain},
          {urban_nav_core::formatNumber(realtimeFactor(state), 3), "x", "real time, reading included", Grade::Plain}};
}

PageTable parametersTable(const ParameterSet& parameters) {
  PageTable table{"Parameters", {"parameter", "value", "from"}, {}, ""};
  for (const urban_nav_core::Setting& setting : parameters.settings())
    table.rows.push_back({urban_nav_core::fullName(setting.stage, setting.name),
                          urban_nav_core::printValue(setting.value), setting.origin});
  return table;
}

PageTable inputsTable(const MapContext& context) {
  PageTable table{"Inputs", {"input", "kind", "frames", "size", "f (px)", "baseline (m)", "notes"}, {}, ""};
  for (const MapSession& session : context.sessions) {
    const urban_nav_input::SourceInfo& info = session.info;
    if (info.name.empty()) continue;  // not open yet
    if (!info.has_images) {
      table.rows.push_back({info.name, info.kind, std::to_string(info.frames), "", "", "", listText(info.notes)});
      continue;
    }
    const urban_nav_core::Pinhole& left = info.camera.left;
    table.rows.push_back({info.name, info.kind, std::to_string(session.odometry->frames.size()),
                          std::to_string(left.width) + "x" + std::to_string(left.height),
                          urban_nav_core::formatNumber(left.fx, 6),
                          urban_nav_core::formatNumber(info.camera.baseline, 5), listText(info.notes)});
  }
  return table;
}

/// Returns the result of a comparison. `session`: its number from 1 if there are several, else 0.
StageResult evaluationResult(const Evaluation& evaluation, std::size_t session) {
  const std::string of = session > 0 ? " (session " + std::to_string(session) + ")" : "";
  StageResult made;
  for (Verdict& verdict : evaluationVerdicts(evaluation)) {
    if (session > 0) verdict.headline = "Session " + std::to_string(session) + ": " + verdict.headline;
    made.verdicts.push_back(verdict);
  }
  for (Tile& tile : evaluationTiles(evaluation)) {
    tile.label += of;
    made.tiles.push_back(tile);
  }
  Section section = evaluationSection(evaluation);
  if (session > 0) section.id += std::to_string(session);
  section.title += of;
  made.sections.push_back({report_place::kTruth, std::move(section)});
  return made;
}

/// Returns one result per comparison with ground truth.
std::vector<StageResult> evaluationResults(const MapContext& context) {
  std::vector<StageResult> results;
  if (context.evaluations.empty()) return results;
  for (std::size_t i = 0; i < context.sessions.size(); ++i)
    if (const std::optional<Evaluation>& of_map = context.evaluations[context.number(i)].map)
      results.push_back(evaluationResult(*of_map, context.sessions.size() > 1 ? i + 1 : 0));
  return results;
}

Section methodSection(const MapState& state, const std::vector<StageResult>& results) {
  Section how{"how", "Inputs and parameters",
              "",    {},
              {},    {inputsTable(state.context), parametersTable(state.context.options.parameters)}};
  PageTable warnings{"Warnings", {"defects of the data"}, {}, ""};
  for (const StageResult& result : results)
    for (const std::string& fault : result.data_faults) warnings.rows.push_back({fault});
  if (!warnings.rows.empty()) how.tables.insert(how.tables.begin(), warnings);
  return how;
}

std::string subtitle(const std::vector<StageResult>& results) {
  std::vector<std::string> methods;
  for (const StageResult& result : results)
    if (!result.method.empty()) methods.push_back(result.method);
  return listText(methods) + ": the path of the robot and its accuracy.";
}

}  // namespace

double realtimeFactor(const MapState& state) {
  return ownTotals(state.context).seconds / std::max(1e-9, state.usage.wallSeconds());
}

std::vector<StageResult> stageResults(const MapState& state) {
  std::vector<StageResult> results;
  for (const Stage* stage : state.stages) results.push_back(stage->result(state.context));
  return results;
}

Page mapPage(const MapState& state, const std::vector<StageResult>& results) {
  Page page;
  page.title = "Map of " + inputNames(state.context.options.inputs);
  page.subtitle = subtitle(results);
  page.running = state.running;
  page.progress = state.progress;
  page.tiles = runTiles(state);
  std::vector<PlacedSection> sections;
  const auto add = [&](const StageResult& result) {
    page.tiles.insert(page.tiles.end(), result.tiles.begin(), result.tiles.end());
    if (result.answer) page.verdicts.insert(page.verdicts.begin(), *result.answer);
    page.verdicts.insert(page.verdicts.end(), result.verdicts.begin(), result.verdicts.end());
    sections.insert(sections.end(), result.sections.begin(), result.sections.end());
  };
  for (const StageResult& result : results) add(result);
  for (const StageResult& result : evaluationResults(state.context)) add(result);
  sections.push_back({report_place::kMethod, methodSection(state, results)});
  std::stable_sort(sections.begin(), sections.end(),
                   [](const PlacedSection& a, const PlacedSection& b) { return a.place < b.place; });
  for (PlacedSection& placed : sections) page.sections.push_back(std::move(placed.section));
  page.footer =
      "urban_nav map, " + urban_nav_core::formatNumber(state.usage.wallSeconds(), 3) + " s wall time, " +
      urban_nav_core::formatNumber(state.usage.cpuSeconds(), 3) +
      " s processor time. Poses and tables: trajectory.tum, covariance.csv and the tables of the stages in the "
      "folder of this file.";
  return page;
}

Json mapSummary(const MapState& state, const std::vector<StageResult>& results) {
  const RunTotals extent = ownTotals(state.context);
  Json json = Json::object();
  json["wall_s"] = state.usage.wallSeconds();
  json["cpu_s"] = state.usage.cpuSeconds();
  json["peak_rss_bytes"] = Usage::peakRssBytes();
  json["realtime_factor"] = realtimeFactor(state);
  json["distance_m"] = extent.distance_m;
  json["frames"] = extent.frames;
  json["duration_s"] = extent.seconds;
  json["sessions"] = state.context.sessions.size();
  Json& inputs = json["inputs"] = Json::array();
  for (const MapSession& session : state.context.sessions) appendInputs(session.info.inputs, inputs);
  json["odometry"] = odometryJson(state.context);
  for (const SessionEvaluations& evaluation : state.context.evaluations)
    if (evaluation.map) {
      addToJson(*evaluation.map, json);
      break;
    }
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].summary) json[state.stages[i]->describe().key] = *results[i].summary;
  json["parameters"] = state.context.options.parameters.toJson();
  return json;
}

std::vector<StageFigures> stageFigures(const MapState& state, const std::vector<StageResult>& results) {
  std::vector<StageFigures> figures;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].summary) continue;
    figures.push_back({state.stages[i]->describe().key, results[i].data_faults, results[i].summary->flat()});
  }
  return figures;
}

}  // namespace urban_nav
