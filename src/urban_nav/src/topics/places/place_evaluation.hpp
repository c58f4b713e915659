// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "topics/places/place_truth.hpp"
#include "topics/places/word_ranking.hpp"

namespace urban_nav {

/// Evaluation of a model against the truth.
struct PlaceEvaluation {
  struct Row {
    std::string name;
    PlaceScore score;
  };
  struct Curve {
    std::string name;
    RankingScore score;
  };
  PlaceTruth truth;
  urban_nav_core::StampNs mask = 0;  ///< ns
  PlaceQuery query;                  ///< with the options of the user
  PlaceScore score;                  ///< of `query`
  std::vector<Row> rows;             ///< words only, then with each further kind of evidence of the options
  std::vector<Curve> words;          ///< Chow-Liu tree, naive Bayes, tf-idf: by words only
  std::vector<WordProbability> confusion;
};

/// Recognises a recording with the options, and with one kind of evidence less at a time. `truth`: for the rows of a
/// query. `progress`: share done. The result does not depend on the number of threads.
PlaceEvaluation evaluatePlaces(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                               const fabmap_node::RecogniserOptions& options,
                               const std::function<PlaceTruth(const PlaceQuery&)>& truth,
                               const std::function<void(double share)>& progress = {});

/// Returns the table of evidence as text.
std::string printEvaluation(const PlaceEvaluation& evaluation);

/// Writes into the folder, which is created: report.html (all of it, with the best and worst matches side by side),
/// precision_recall.svg, reliability.svg, confusion.csv, confusion.png, matches.csv. Throws UserError.
void writeEvaluation(const PlaceEvaluation& evaluation, const PlaceRecording& recording, const std::string& model,
                     const std::string& folder);

}  // namespace urban_nav
