// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_evaluation.hpp"

#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

std::string shareText(std::size_t part, std::size_t whole) {
  if (whole == 0) return "-";
  return urban_nav_core::formatNumber(100.0 * static_cast<double>(part) / static_cast<double>(whole), 3) + " %";
}

struct EvidenceOptions {
  std::string name;
  fabmap_node::RecogniserOptions options;
};

/// Returns words only, then each further kind of evidence of the options; the last one equals the options.
std::vector<EvidenceOptions> evidenceSteps(const fabmap_node::RecogniserOptions& options) {
  std::vector<EvidenceOptions> steps;
  fabmap_node::RecogniserOptions words = options;
  words.matcher.second_looks = 0;
  words.sequence = false;
  steps.push_back({"words alone", words});
  if (options.sequence) {
    words.sequence = true;
    steps.push_back({"+ sequence", words});
  }
  if (options.matcher.second_looks > 0) steps.push_back({"+ second look", options});
  return steps;
}

}  // namespace

PlaceEvaluation evaluatePlaces(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                               const fabmap_node::RecogniserOptions& options,
                               const std::function<PlaceTruth(const PlaceQuery&)>& truth,
                               const std::function<void(double)>& progress) {
  PlaceEvaluation evaluation;
  evaluation.mask = options.mask;
  const std::vector<EvidenceOptions> steps = evidenceSteps(options);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    PlaceQuery query = recognisePlaces(model, recording, steps[k].options, [&](std::size_t done) {
      const double share = static_cast<double>(done) / static_cast<double>(recording.places.size());
      if (progress) progress((static_cast<double>(k) + share) / static_cast<double>(steps.size()));
    });
    if (k == 0) evaluation.truth = truth(query);
    evaluation.rows.push_back({steps[k].name, scorePlaces(query, evaluation.truth, options.mask)});
    evaluation.query = std::move(query);
  }
  evaluation.score = evaluation.rows.back().score;
  const std::vector<bool> revisits = findRevisits(evaluation.query, evaluation.truth, options.mask);
  for (const WordScoring scoring : {WordScoring::ChowLiu, WordScoring::NaiveBayes, WordScoring::TfIdf})
    evaluation.words.push_back({toString(scoring), scoreRanking(rankByWords(model, recording, scoring, options.mask),
                                                                evaluation.truth, revisits)});
  evaluation.confusion = wordProbabilities(model, recording, options.mask);
  return evaluation;
}

std::string printEvaluation(const PlaceEvaluation& evaluation) {
  const PlaceTruth& truth = evaluation.truth;
  std::string text = std::to_string(evaluation.score.ranking.revisits) + " revisits within " +
                     urban_nav_core::formatNumber(truth.radius) + " " + truth.unit + " (mask " +
                     urban_nav_core::formatNumber(static_cast<double>(evaluation.mask) * 1e-9, 6) + " s)\n";
  for (const PlaceEvaluation::Row& row : evaluation.rows) {
    const PlaceScore& score = row.score;
    text +=
        row.name + "\n  the right place is the likeliest: " + shareText(score.ranking.first, score.ranking.revisits) +
        "\n  recall at 100 % precision: " + shareText(score.ranking.found, score.ranking.revisits) +
        "\n  announced above 0.99: " + std::to_string(score.sure) +
        ", right: " + shareText(score.sure_right, score.sure) +
        "\n  announced above 0.9 up to 0.99: " + std::to_string(score.nearly) +
        ", right: " + shareText(score.nearly_right, score.nearly) +
        "\n  revisits announced, or next to an announced one: " + shareText(score.near_sure, score.ranking.revisits) +
        "\n  calibration error of claims above 0.5: " + urban_nav_core::formatNumber(score.calibration_error, 2) + "\n";
  }
  for (const PlaceEvaluation::Curve& curve : evaluation.words)
    text += "words alone, " + curve.name + ": right place first " + shareText(curve.score.first, curve.score.revisits) +
            ", recall at 100 % precision " + shareText(curve.score.found, curve.score.revisits) + "\n";
  return text;
}

}  // namespace urban_nav
