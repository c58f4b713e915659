// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/fab_map.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "fabmap_node/recognition/compact_look.hpp"

namespace fabmap_node {

using urban_nav_core::StampNs;

namespace {

constexpr int kSecondLookCandidates = 10;

RecogniserOptions recogniserOptions(const Parameters& parameters) {
  RecogniserOptions options;
  options.matcher.second_looks = parameters.descriptor_matching ? kSecondLookCandidates : 0;
  options.sequence = parameters.sequence;
  options.detects_stationary = false;  // process() passes on only observations of a moving camera
  options.mask = static_cast<StampNs>(std::llround(1e9 * parameters.mask));
  return options;
}

}  // namespace

const char* toString(PlaceKnowledge knowledge) {
  constexpr std::array<const char*, 3> kNames = {"KNOWN", "UNSURE", "NEW"};
  return kNames[static_cast<std::size_t>(knowledge)];
}

FabMap::FabMap(const PlaceModel& model, const Parameters& parameters, LookReader read_look)
    : known_probability_(parameters.known_probability),
      closure_probability_(parameters.closure_probability),
      recogniser_(model, recogniserOptions(parameters), std::move(read_look)),
      selector_(parameters) {}

void FabMap::beginSession(const std::string& name) {
  sessions_.push_back(name);
  recogniser_.beginSession();
  selector_.beginSession();
  last_look_.reset();
}

void FabMap::addPlace(StampNs stamp, const PlaceDescription& description, double travelled) {
  if (recogniser_.add(stamp, description)) travelled_.push_back(travelled);
}

PlaceBelief FabMap::decide(const PlaceRecognition& recognition) const {
  PlaceBelief belief;
  belief.observation = recognition.status;
  belief.words = recognition.words;
  if (!recognition.match) return belief;
  const DescribedPlace& place = recogniser_.place(recognition.match->place);
  belief.likeliest.push_back({{sessions_[place.session], place.stamp}, recognition.probability});
  belief.p_new = 1.0 - recognition.probability;
  belief.agreeing = recognition.match->agreeing;
  if (recognition.probability > known_probability_) belief.knowledge = PlaceKnowledge::Known;
  else if (recognition.probability > closure_probability_) belief.knowledge = PlaceKnowledge::Unsure;
  return belief;
}

PlaceOutput FabMap::process(StampNs stamp, const PlaceDescription& description, double travelled) {
  PlaceOutput output;
  if (description.status == ObservationStatus::Used) {
    ComparedFeatures look = unpackLook(description.look, "observation");
    if (last_look_ && isStationary(*last_look_, look)) {
      output.belief = last_belief_;
      output.belief.at.stamp = stamp;
      output.belief.is_stationary = true;
      return output;
    }
    last_look_ = std::move(look);
  }
  const PlaceRecognition recognition = recogniser_.process(stamp, description);
  output.belief = decide(recognition);
  output.belief.at = {sessions_.back(), stamp};
  if (description.status == ObservationStatus::Used) travelled_.push_back(travelled);
  const auto propose = [&](const PlaceMatch& match, double probability) {
    const DescribedPlace& place = recogniser_.place(match.place);
    if (selector_.select({place.session, travelled_[match.place]}, {sessions_.size() - 1, travelled}, probability))
      output.closures.push_back({{sessions_[place.session], place.stamp}, output.belief.at, probability});
  };
  if (recognition.match) propose(*recognition.match, recognition.probability);
  if (recognition.earlier) propose(*recognition.earlier, recognition.earlier_probability);
  last_belief_ = output.belief;
  return output;
}

}  // namespace fabmap_node
