// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_recogniser.hpp"

namespace fabmap_node {

PlaceRecogniser::PlaceRecogniser(const PlaceModel& model, const RecogniserOptions& options)
    : model_(model),
      options_(options),
      table_(model.tree, model.detector, Dependence::ChowLiu),
      matcher_(table_, model.sampled_places, options.matcher) {}

void PlaceRecogniser::beginSession() {
  if (has_session_) ++session_;
  has_session_ = true;
}

bool PlaceRecogniser::add(urban_nav_core::StampNs stamp, const PlaceDescription& description) {
  has_session_ = true;
  if (description.status != ObservationStatus::Used) return false;
  matcher_.add({session_, stamp, description.words, description.look});
  return true;
}

PlaceRecognition PlaceRecogniser::process(urban_nav_core::StampNs stamp, const PlaceDescription& description) {
  has_session_ = true;
  PlaceRecognition result;
  result.status = description.status;
  result.words = description.words.size();
  if (result.status != ObservationStatus::Used) return result;
  DescribedPlace query{session_, stamp, description.words, description.look};
  result.match = matcher_.match(query, [&](std::size_t i) {
    const DescribedPlace& place = matcher_.place(i);
    return place.session != session_ || place.stamp <= stamp - options_.mask;
  });
  if (result.match) result.probability = model_.calibration(description.cameras).probability(result.match->evidence);
  matcher_.add(std::move(query));
  return result;
}

}  // namespace fabmap_node
