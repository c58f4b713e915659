// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "base/raster_plot.hpp"
#include "base/standalone_svg.hpp"
#include "evaluation/evaluate_command.hpp"
#include "evaluation/evaluation.hpp"
#include "evaluation/evaluation_report.hpp"
#include "evaluation/run_covariances.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

namespace {

/// "M,DEG"
TruthSigma parseTruthSigma(const std::vector<std::string>& words) {
  TruthSigma sigma;
  const auto number = [&](std::size_t i) {
    const auto value = i < words.size() ? urban_nav_core::parseNumber(words[i]) : std::nullopt;
    if (words.size() != 2 || !value || *value < 0.0)
      throw UserError("--truth-sigma", words.empty() ? "" : words[std::min(i, words.size() - 1)],
                      "M,DEG: two numbers of at least 0, such as 0.1,0.1");
    return *value;
  };
  sigma.m = number(0);
  sigma.deg = number(1);
  return sigma;
}

/// Warnings about the two files and how they belong together.
void warnAboutFiles(const urban_nav_input::TrajectoryFile& truth, const urban_nav_input::TrajectoryFile& estimate,
                    const Evaluation& evaluation, Console& console) {
  for (const urban_nav_input::TrajectoryFile* file : {&truth, &estimate})
    for (const std::string& note : file->notes) console.warn(note);
  if (evaluation.axes.axes != Axes::Same) console.warn(describe(evaluation.axes));
  const std::size_t matched = evaluation.matched.truth.size();
  if (matched < std::min(truth.poses.size(), estimate.poses.size()))
    console.warn(std::to_string(estimate.poses.size() - matched) + " of " + std::to_string(estimate.poses.size()) +
                 " poses of the estimate are left out: no pose of the truth within 0.02 s");
}

void writePlot(const std::string& path, const Evaluation& evaluation, const std::string& title) {
  const std::string extension = fs::path(path).extension().string();
  if (extension == ".html") {
    Page page;
    page.title = title;
    page.subtitle = "Trajectory against truth.";
    page.tiles = evaluationTiles(evaluation);
    page.verdicts = evaluationVerdicts(evaluation);
    page.sections = {evaluationSection(evaluation)};
    page.footer = "urban_nav evaluate";
    urban_nav_core::writeAtomically(path, renderPage(page));
  } else {
    const std::vector<std::pair<std::string, Plot>> plots = {{"From above", pathPlot(evaluation, 0, 1)},
                                                             {"From the side", pathPlot(evaluation, 0, 2)},
                                                             {"Error over distance", errorPlot(evaluation)}};
    const std::vector<unsigned char> png = extension == ".png" ? rasterPng(plots) : std::vector<unsigned char>();
    urban_nav_core::writeAtomically(path,
                                    extension == ".png" ? std::string(png.begin(), png.end()) : standaloneSvg(plots));
  }
}

int runEvaluate(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const std::string plot = arguments.get("output");
  const std::string extension = fs::path(plot).extension().string();
  if (!plot.empty() && extension != ".html" && extension != ".svg" && extension != ".png")
    throw UserError("--output", plot, "a file that ends in .html, .svg or .png");
  EvaluationOptions options;
  options.spans =
      parseSpans(arguments.has("spans") ? arguments.list("spans") : std::vector<std::string>{"10m", "100m"});
  options.find_offset = arguments.has("find-offset");
  const urban_nav_input::TrajectoryFile truth = urban_nav_input::readTrajectory(arguments.get("truth")),
                                        estimate = urban_nav_input::readTrajectory(arguments.get("estimate"));
  if (arguments.has("truth-sigma")) options.truth_sigma = parseTruthSigma(arguments.list("truth-sigma"));
  const std::optional<std::string> given = arguments.find("covariance");
  const RunCovariances run =
      given ? RunCovariances{urban_nav_core::readCovariances(*given), ""} : readRunCovariances(estimate);
  const std::vector<urban_nav_core::CovarianceRow>& covariances = run.rows;
  const Evaluation evaluation = evaluate(truth, estimate, covariances, options);
  if (!run.warning.empty()) console.warn(run.warning);
  warnAboutFiles(truth, estimate, evaluation, console);
  if (!covariances.empty() && evaluation.covariances.empty())
    console.warn("no NEES: " + std::to_string(covariances.size()) + " covariances for " +
                 std::to_string(evaluation.matched.truth.size()) + " matched poses; one per pose is needed");
  if (evaluation.offset && !evaluation.offset_applied) {
    console.warn("only " + std::to_string(evaluation.matched.truth.size()) +
                 " poses have a stamp within 0.02 s of a pose of the truth; --find-offset would add " +
                 urban_nav_core::formatNumber(1e-9 * static_cast<double>(evaluation.offset->offset), 9) +
                 " s to the stamps of the estimate and match " + std::to_string(evaluation.offset->matched));
  }
  console.print(evaluationText(evaluation));
  if (arguments.has("json")) {
    Json json = Json::object();
    json["estimate"] = estimate.path;
    addToJson(evaluation, json);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  if (!plot.empty()) writePlot(plot, evaluation, estimate.path);
  return 0;
}

}  // namespace

Command evaluateCommand() {
  Command command;
  command.name = "evaluate";
  command.summary = "Compares a trajectory with the truth: absolute and relative errors, NEES, a plot.";
  command.options = {{"--truth",
                      "FILE",
                      "TUM (.tum, .txt with 8 columns), KITTI (.kitti, .txt with 12 columns) or EuRoC (.csv)",
                      true,
                      false,
                      {}},
                     {"--estimate", "FILE", "trajectory to evaluate, in one of the same formats", true, false, {}},
                     {"--covariance",
                      "FILE",
                      "covariances of the estimate's poses, for NEES (default: covariance.csv in its folder)",
                      false,
                      false,
                      {}},
                     {"--spans",
                      "LIST",
                      "spans of relative errors, in frames or metres (default 10m,100m; 10 frames always)",
                      false,
                      true,
                      {}},
                     {"--truth-sigma",
                      "M,DEG",
                      "standard deviation of each pose of the truth, added to the covariance in NEES (default 0,0)",
                      false,
                      true,
                      {}},
                     {"--find-offset", "", "find the offset between the clocks and apply it", false, false, {}},
                     {"-o,--output", "FILE", "plot: a page (.html) or a drawing (.svg, .png)", false, false, {}},
                     jsonOption(),
                     configOption(),
                     setOption(),
                     threadsOption()};
  command.examples = {
      "urban_nav evaluate --truth poses.txt --estimate out/trajectory.kitti",
      "urban_nav evaluate --truth truth.tum --estimate out/trajectory.tum --spans 10f,100m -o errors.html"};
  command.more_help = commonHelp;
  command.run = runEvaluate;
  return command;
}

}  // namespace urban_nav
