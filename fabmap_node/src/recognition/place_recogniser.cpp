// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_recogniser.hpp"

#include <utility>

#include "fabmap_node/recognition/compact_look.hpp"

namespace fabmap_node {

PlaceRecogniser::PlaceRecogniser(const PlaceModel& model, const RecogniserOptions& options, LookReader read_look)
    : model_(model),
      options_(options),
      table_(model.tree, model.detector, Dependence::ChowLiu),
      matcher_(table_, model.sampled_places, options.matcher, std::move(read_look)) {}

void PlaceRecogniser::beginSession() {
  if (has_session_) ++session_;
  has_session_ = true;
  filter_ = filter_before_ = LocationFilter();
  last_look_.reset();
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
  const std::vector<PlaceMatch> matches = matcher_.matches(query, [&](std::size_t i) {
    const DescribedPlace& place = matcher_.place(i);
    return place.session != session_ || place.stamp <= stamp - options_.mask;
  });
  if (options_.sequence && options_.detects_stationary) followLook(description.look);
  if (!matches.empty()) judge(matches, description.cameras, result);
  if (result.match && result.match->session == session_) {
    result.earlier = matcher_.match(query, [&](std::size_t i) { return matcher_.place(i).session != session_; });
    if (result.earlier)
      result.earlier_probability = model_.calibration(description.cameras).probability(result.earlier->evidence);
  }
  matcher_.add(std::move(query));
  return result;
}

/// Removes the previous observation from the filter if the camera has not moved since.
void PlaceRecogniser::followLook(const std::string& look) {
  ComparedFeatures now = unpackLook(look, "observation");
  if (last_look_ && isStationary(*last_look_, now)) filter_ = filter_before_;
  last_look_ = std::move(now);
}

/// The sequence is used for places of other sessions only. Within a session, a repetitive facade is matched at a
/// constant distance from the robot, which is as consistent as a revisit.
void PlaceRecogniser::judge(const std::vector<PlaceMatch>& matches, int cameras, PlaceRecognition& result) {
  const PlaceCalibration& alone = model_.calibration(cameras);
  const std::optional<PlaceCalibration>& sequence = model_.sequenceCalibration(cameras);
  result.match = matches.front();
  result.probability = alone.probability(result.match->evidence);
  if (!options_.sequence || !sequence) return;
  std::vector<LocationHypothesis> hypotheses;
  for (const PlaceMatch& match : matches)
    hypotheses.push_back({match.session, match.place, alone.logit(match.evidence), match.evidence.look_margin});
  const PlaceMatch& likeliest = matches[likeliestLocation(filter_, hypotheses)];
  if (matches.front().session != session_ && likeliest.session != session_) {
    result.match = likeliest;
    result.match->evidence.sequence = filter_.pathMargin(likeliest.session, likeliest.place);
    result.probability = sequence->probability(result.match->evidence);
  }
  filter_before_ = filter_;
  filter_.update(hypotheses);
}

}  // namespace fabmap_node
