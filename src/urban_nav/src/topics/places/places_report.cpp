// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/places_report.hpp"

#include <limits>

#include "base/plot.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

using fabmap_node::ObservationStatus;
using fabmap_node::PlaceBelief;
using fabmap_node::PlaceKnowledge;

namespace {

struct KnowledgeCounts {
  std::size_t known = 0, unsure = 0, fresh = 0, stationary = 0;
  std::size_t accepted = 0, rejected = 0;  // likeliest places with a geometric verdict
};

KnowledgeCounts countKnowledge(const PlacesRun& run) {
  KnowledgeCounts counts;
  for (const auto& session : run.beliefs)
    for (const PlaceBelief& belief : session) {
      if (belief.observation != ObservationStatus::Used) continue;
      if (belief.is_stationary) ++counts.stationary;
      else if (belief.knowledge == PlaceKnowledge::Known) ++counts.known;
      else if (belief.knowledge == PlaceKnowledge::Unsure) ++counts.unsure;
      else ++counts.fresh;
      if (belief.is_stationary || belief.likeliest.empty() || !belief.likeliest.front().verdict) continue;
      const bool is_accepted = fabmap_node::logRatio(*belief.likeliest.front().verdict) > 0.0;
      ++(is_accepted ? counts.accepted : counts.rejected);
    }
  return counts;
}

std::string observationWord(const PlacesRun& run) { return run.has_panoramas ? "panoramas" : "images"; }

/// Plots the probability of the likeliest place over time; sessions follow one another.
Plot beliefPlot(const PlacesRun& run) {
  Plot plot;
  plot.x_label = "time driven (s)";
  plot.y_label = "probability of a known place";
  plot.y_from_zero = true;
  plot.y_top = 1.0;
  Series known, unsure, fresh;
  known.kind = unsure.kind = fresh.kind = Series::Kind::Dots;
  known.name = "KNOWN";
  known.colour = "good";
  unsure.name = "UNSURE";
  unsure.colour = "fair";
  fresh.name = "NEW";
  fresh.colour = "a";
  double offset = 0.0;
  for (const auto& session : run.beliefs) {
    if (session.empty()) continue;
    for (const PlaceBelief& belief : session) {
      if (belief.observation != ObservationStatus::Used) continue;
      Series& series = belief.knowledge == PlaceKnowledge::Known    ? known
                       : belief.knowledge == PlaceKnowledge::Unsure ? unsure
                                                                    : fresh;
      series.points.push_back(
          {offset + urban_nav_core::secondsBetween(session.front().at.stamp, belief.at.stamp), 1.0 - belief.p_new});
    }
    offset += urban_nav_core::secondsBetween(session.front().at.stamp, session.back().at.stamp);
  }
  for (Series& series : std::vector<Series>{fresh, unsure, known})
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  return plot;
}

PageTable knowledgeTable(const PlacesRun& run) {
  const KnowledgeCounts counts = countKnowledge(run);
  PageTable table{"Results of the " + observationWord(run),
                  {"", observationWord(run)},
                  {{"KNOWN: a place of the map", std::to_string(counts.known)},
                   {"UNSURE", std::to_string(counts.unsure)},
                   {"NEW", std::to_string(counts.fresh)},
                   {"robot at rest", std::to_string(counts.stationary)},
                   {"likeliest place accepted by geometry", std::to_string(counts.accepted)},
                   {"likeliest place rejected by geometry", std::to_string(counts.rejected)}},
                  "Closures are proposed for KNOWN and UNSURE places and verified by geometry. Verdicts change the "
                  "probabilities, also of neighbouring observations on the same path."};
  for (const auto& [reason, number] : run.unused) table.rows.push_back({"not used: " + reason, std::to_string(number)});
  if (run.incomplete > 0) table.rows.push_back({"with a camera missing", std::to_string(run.incomplete)});
  return table;
}

}  // namespace

Section placesSection(const PlacesRun& run, const std::vector<PagePicture>& pictures) {
  Section section;
  section.id = "places";
  section.title = "Places";
  section.introduction =
      "Places are recognised by appearance only (FAB-MAP). The probability that an observation shows a place of "
      "the map is calibrated on drives not used for training; verdicts on closures change it.";
  section.figures.push_back({"Probability over time", renderSvg(beliefPlot(run)),
                             "One dot per observation; sessions follow one another.", true});
  section.pictures = pictures;
  section.tables.push_back(knowledgeTable(run));
  return section;
}

std::vector<Verdict> placesVerdicts(const PlacesRun& run) {
  const KnowledgeCounts counts = countKnowledge(run);
  const std::size_t used = counts.known + counts.unsure + counts.fresh;
  std::vector<Verdict> verdicts;
  if (run.observations > 0 && used == 0) {
    verdicts.push_back({Grade::Bad, "No place could be recognised",
                        "All " + std::to_string(run.observations) + " " + observationWord(run) +
                            " are dark, blank, blurred or missing."});
    return verdicts;
  }
  if (counts.known + counts.unsure == 0) return verdicts;
  verdicts.push_back({counts.known > 0 ? Grade::Good : Grade::Fair,
                      std::to_string(counts.known) + " of " + std::to_string(used) + " " + observationWord(run) +
                          " show a known place",
                      std::to_string(counts.unsure) + " more may do so; " + std::to_string(run.closures.size()) +
                          " closures were proposed."});
  return verdicts;
}

Json toJson(const PlacesRun& run, const std::vector<double>& ms_features) {
  const KnowledgeCounts counts = countKnowledge(run);
  Json json = Json::object();
  json["panoramas"] = static_cast<std::int64_t>(run.observations);
  json["places"] = static_cast<std::int64_t>(run.places);
  json["known"] = static_cast<std::int64_t>(counts.known);
  json["unsure"] = static_cast<std::int64_t>(counts.unsure);
  json["new"] = static_cast<std::int64_t>(counts.fresh);
  json["accepted"] = static_cast<std::int64_t>(counts.accepted);
  json["rejected"] = static_cast<std::int64_t>(counts.rejected);
  json["stationary"] = static_cast<std::int64_t>(counts.stationary);
  Json unused = Json::object();
  for (const auto& [reason, number] : run.unused) unused[reason] = static_cast<std::int64_t>(number);
  json["unused"] = unused;
  json["ms_features_median"] = ms_features.empty() ? 0.0 : urban_nav_core::quantile(ms_features, 0.5);
  json["ms_inference_median"] = run.ms_inference.empty() ? 0.0 : urban_nav_core::quantile(run.ms_inference, 0.5);
  json["closures"] = static_cast<std::int64_t>(run.closures.size());
  Json warnings = Json::array();
  for (const std::string& warning : run.warnings) warnings.append(warning);
  json["warnings"] = warnings;
  return json;
}

}  // namespace urban_nav
