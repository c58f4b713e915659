// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/trust_report.hpp"

#include <algorithm>

#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::formatNumber;
using urban_nav_trust::ConsistencyTest;
using urban_nav_trust::TrustState;

namespace {

constexpr const char* kByCovariance = "From the covariance of each pose and the results of the tests,";
constexpr double kMostStated = 0.999;  // higher probabilities depend on unobserved tails

/// Returns a reason as a sentence.
std::string asSentence(std::string reason) {
  if (!reason.empty() && reason.front() >= 'a' && reason.front() <= 'z')
    reason.front() = static_cast<char>(reason.front() - 'a' + 'A');
  return reason + ".";
}

/// Returns the sentence on the whole map, which begins with `by`.
std::string probabilitySentence(const TrustRun& run, const std::string& by) {
  std::string text = by + " the probability that a position of the map is right is ";
  for (std::size_t k = 0; k < urban_nav_trust::kRadii.size(); ++k) {
    if (k > 0) text += k + 1 == urban_nav_trust::kRadii.size() ? " and " : ", ";
    const double probability = run.map.probabilities[k];
    text += (probability > kMostStated ? "above " : "") + formatNumber(std::min(probability, kMostStated), 3) +
            " within " + formatNumber(urban_nav_trust::kRadii[k]) + " m";
  }
  return text + ".";
}

/// Returns the sentences of the failed tests whose causes were corrected.
std::string correctedSentences(const TrustRun& run, const urban_nav_trust::Parameters& parameters) {
  std::string text;
  for (const ConsistencyTest& test : run.results.tests)
    if (hasFailed(test, parameters) && test.is_corrected) text += (text.empty() ? "" : " ") + test.sentence;
  return text;
}

Figure probabilityFigure(const TrustRun& run) {
  static constexpr const char* kColours[] = {"a", "b", "c"};
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = "probability";
  plot.y_from_zero = true;
  for (std::size_t k = 0; k < urban_nav_trust::kRadii.size(); ++k) {
    Series series;
    series.name = "within " + formatNumber(urban_nav_trust::kRadii[k]) + " m";
    series.colour = kColours[k];
    for (const urban_nav_trust::FrameTrust& frame : run.frames)
      series.points.push_back(
          {urban_nav_core::secondsBetween(run.frames.front().stamp, frame.stamp), frame.probabilities[k]});
    plot.series.push_back(std::move(series));
  }
  return {"Probability that the position is right", renderSvg(plot),
          "From the covariance of each pose, scaled by the results of the tests and enlarged where a test fails.",
          true};
}

}  // namespace

Verdict trustVerdict(const TrustRun& run, const urban_nav_trust::Parameters& parameters) {
  const auto failed =
      static_cast<std::size_t>(std::count_if(run.results.tests.begin(), run.results.tests.end(),
                                             [&](const ConsistencyTest& test) { return hasFailed(test, parameters); }));
  const std::string tests = std::to_string(run.results.tests.size());
  switch (run.map.state) {
    case TrustState::Known:
      if (failed > 0)
        return {
            Grade::Fair, "The map can be trusted, but the rig changed: odometry measured the change and corrected it.",
            correctedSentences(run, parameters) + " The other " + std::to_string(run.results.tests.size() - failed) +
                " consistency tests passed. " + probabilitySentence(run, kByCovariance)};
      return {Grade::Good, "The map can be trusted.",
              tests + " consistency tests passed. " + probabilitySentence(run, kByCovariance)};
    case TrustState::New:
      return {Grade::Fair, "The sessions are separate maps.",
              run.map.reason + ". " + probabilitySentence(run, kByCovariance)};
    case TrustState::Lost: return {Grade::Bad, "The path is lost.", run.map.reason + "."};
    case TrustState::Unsure: break;
  }
  if (failed > 0)
    return {Grade::Bad, "Measurements contradict each other: do not trust the map.",
            std::to_string(failed) + " of " + tests + " consistency tests failed. " + run.map.reason};
  return {Grade::Fair, "The map is not confirmed by independent measurements.",
          asSentence(run.map.reason) + " " +
              probabilitySentence(run, "From its covariance, whose scale no test confirms,")};
}

Section trustSection(const TrustRun& run, const urban_nav_trust::Parameters& parameters) {
  Section section{
      "trust",
      "Trust",
      "Each test compares two independent measurements of one quantity. A test fails if its p-value is below " +
          formatNumber(parameters.false_alarm) + ".",
      {},
      {},
      {}};
  if (!run.frames.empty()) section.figures.push_back(probabilityFigure(run));
  PageTable tests{"Consistency tests",
                  {"test", "verdict", "statistic", "degrees of freedom", "p-value", "finding", "remedy"},
                  {},
                  ""};
  for (const ConsistencyTest& test : run.results.tests) {
    const bool has_failed = hasFailed(test, parameters);
    tests.rows.push_back({test.name,
                          !has_failed         ? "passed"
                          : test.is_corrected ? "failed, corrected"
                                              : "failed",
                          formatNumber(test.statistic), formatNumber(test.degrees_of_freedom),
                          formatNumber(test.p_value), test.sentence, has_failed ? test.remedy : ""});
  }
  if (!tests.rows.empty()) section.tables.push_back(std::move(tests));
  PageTable absent{"Not compared", {"test", "reason"}, {}, ""};
  for (const urban_nav_trust::AbsentMeasurement& missing : run.results.absent)
    absent.rows.push_back({missing.name, missing.reason});
  if (!absent.rows.empty()) section.tables.push_back(std::move(absent));
  return section;
}

}  // namespace urban_nav
