// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/word_ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "fabmap_node/places/place_index.hpp"
#include "fabmap_node/places/tf_idf_index.hpp"

namespace urban_nav {

using fabmap_node::ObservationStatus;
using fabmap_node::PlaceIndex;
using urban_nav_core::StampNs;

namespace {

constexpr double kNewPlacePrior = 0.9;

double logMeanExponential(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double value : logs) sum += std::exp(value - top);
  return top + std::log(sum / static_cast<double>(logs.size()));
}

/// Observations in order, each compared with the previous ones.
using ScorePlacesOfMap = std::function<void(const fabmap_node::WordSet& query, std::vector<double>& scores)>;
using AddToMap = std::function<void(const fabmap_node::WordSet& place)>;
using TakeScores =
    std::function<void(std::size_t row, const std::vector<std::size_t>& rows, const std::vector<double>& scores)>;

/// Calls `take` with the candidates of each usable observation: their rows and scores.
void compareInOrder(const PlaceRecording& recording, StampNs mask, const ScorePlacesOfMap& score, const AddToMap& add,
                    const TakeScores& take) {
  std::vector<std::size_t> row_of_place, rows;
  std::vector<double> scores, candidates;
  for (std::size_t row = 0; row < recording.places.size(); ++row) {
    const PlaceRecording::Place& query = recording.places[row];
    if (query.description.status != ObservationStatus::Used) continue;
    score(query.description.words, scores);
    rows.clear();
    candidates.clear();
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const PlaceRecording::Place& place = recording.places[row_of_place[i]];
      if (place.session == query.session && place.stamp > query.stamp - mask) continue;
      rows.push_back(row_of_place[i]);
      candidates.push_back(scores[i]);
    }
    take(row, rows, candidates);
    add(query.description.words);
    row_of_place.push_back(row);
  }
}

/// Log likelihood of a new place: the mean over the model's sampled places.
class NewPlace {
 public:
  NewPlace(const fabmap_node::LikelihoodTable& table, const fabmap_node::PlaceModel& model) : samples_(table) {
    for (const fabmap_node::WordSet& words : model.sampled_places) samples_.add(words);
  }
  double logLikelihood(const fabmap_node::WordSet& query) {
    samples_.logLikelihoods(query, logs_);
    return logs_.empty() ? 0.0 : logMeanExponential(logs_);
  }

 private:
  PlaceIndex samples_;
  std::vector<double> logs_;
};

}  // namespace

const char* toString(WordScoring scoring) {
  constexpr std::array<const char*, 3> kNames = {"Chow-Liu tree", "naive Bayes", "tf-idf"};
  return kNames[static_cast<std::size_t>(scoring)];
}

std::vector<RankedMatch> rankByWords(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                                     WordScoring scoring, StampNs mask) {
  std::vector<RankedMatch> matches;
  const TakeScores takeBest = [&](std::size_t row, const auto& rows, const auto& scores) {
    if (rows.empty()) return;
    const auto best = std::max_element(scores.begin(), scores.end());
    matches.push_back({row, rows[static_cast<std::size_t>(best - scores.begin())], *best});
  };
  if (scoring == WordScoring::TfIdf) {
    fabmap_node::TfIdfIndex index(model.tree);
    compareInOrder(
        recording, mask, [&](const auto& query, auto& scores) { index.similarities(query, scores); },
        [&](const auto& words) { index.add(words); }, takeBest);
    return matches;
  }
  const fabmap_node::LikelihoodTable table(
      model.tree, model.detector,
      scoring == WordScoring::ChowLiu ? fabmap_node::Dependence::ChowLiu : fabmap_node::Dependence::Naive);
  PlaceIndex index(table);
  NewPlace new_place(table, model);
  compareInOrder(
      recording, mask,
      [&](const auto& query, auto& scores) {
        index.logLikelihoods(query, scores);
        const double at_new = new_place.logLikelihood(query);
        const double words = static_cast<double>(std::max<std::size_t>(1, query.size()));
        for (double& value : scores) value = (value - at_new) / words;
      },
      [&](const auto& words) { index.add(words); }, takeBest);
  return matches;
}

std::vector<WordProbability> wordProbabilities(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                                               StampNs mask, double least) {
  std::vector<WordProbability> entries;
  const fabmap_node::LikelihoodTable table(model.tree, model.detector, fabmap_node::Dependence::ChowLiu);
  PlaceIndex index(table);
  NewPlace new_place(table, model);
  compareInOrder(
      recording, mask, [&](const auto& query, auto& scores) { index.logLikelihoods(query, scores); },
      [&](const auto& words) { index.add(words); },
      [&](std::size_t row, const std::vector<std::size_t>& rows, const std::vector<double>& scores) {
        const double at_new = new_place.logLikelihood(recording.places[row].description.words) +
                              (rows.empty() ? 0.0 : std::log(kNewPlacePrior));
        const double prior = rows.empty() ? 0.0 : std::log((1.0 - kNewPlacePrior) / static_cast<double>(rows.size()));
        double top = at_new, sum = 0.0;
        for (const double value : scores) top = std::max(top, value + prior);
        for (const double value : scores) sum += std::exp(value + prior - top);
        sum += std::exp(at_new - top);
        if (const double p = std::exp(at_new - top) / sum; p > least) entries.push_back({row, -1, p});
        for (std::size_t i = 0; i < rows.size(); ++i)
          if (const double p = std::exp(scores[i] + prior - top) / sum; p > least)
            entries.push_back({row, static_cast<std::ptrdiff_t>(rows[i]), p});
      });
  return entries;
}

}  // namespace urban_nav
