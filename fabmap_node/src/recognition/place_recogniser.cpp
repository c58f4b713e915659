// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_recogniser.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t least_words =
    30;  // of an observation: fewer are seen in fog, in the dark, or with a covered lens

}  // namespace

PlaceRecogniser::PlaceRecogniser(const PlaceModel& model, const RecogniserOptions& options)
    : model_(model),
      options_(options),
      table_(model.tree, model.detector, Dependence::ChowLiu),
      matcher_(table_, model.sampled_places, options.matcher) {}

void PlaceRecogniser::beginSession() {
  if (has_session_) ++session_;
  has_session_ = true;
}

PlaceRecognition PlaceRecogniser::process(urban_nav_core::StampNs stamp, const PlaceObservation& observation) {
  has_session_ = true;
  PlaceRecognition result;
  DescribedPlace query{session_, stamp, model_.vocabulary.words(observation),
                       lookFeatures(observation, options_.matcher.look_features)};
  result.words = query.words.size();
  if (result.words < least_words) {
    result.status = ObservationStatus::TooFewFeatures;
    return result;
  }
  result.match = matcher_.match(query, [&](std::size_t i) {
    const DescribedPlace& place = matcher_.place(i);
    return place.session != session_ || place.stamp <= stamp - options_.mask;
  });
  if (result.match) result.probability = model_.calibration(observation.cameras).probability(result.match->evidence);
  matcher_.add(std::move(query));
  return result;
}

}  // namespace fabmap_node
