// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/fab_map.hpp"

#include <algorithm>
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

FabMap::FabMap(const PlaceModel& model, const Parameters& parameters, LookReader read_look)
    : parameters_(parameters),
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

PlaceBelief FabMap::toBelief(const PlaceRecognition& recognition) const {
  PlaceBelief belief;
  belief.observation = recognition.status;
  belief.words = recognition.words;
  const auto add = [&](const PlaceMatch& match, double probability) {
    const DescribedPlace& place = recogniser_.place(match.place);
    belief.likeliest.push_back({{sessions_[place.session], place.stamp}, probability, travelled_[match.place], {}});
  };
  if (recognition.match) {
    belief.agreeing = recognition.match->agreeing;
    add(*recognition.match, recognition.probability);
  }
  for (const RecognisedPlace& other : recognition.others) add(other.match, other.probability);
  decide(parameters_, belief);
  return belief;
}

std::optional<double> FabMap::travelled(const urban_nav_core::PoseRef& at) const {
  std::optional<std::size_t> before, after;  // nearest places
  for (std::size_t i = 0; i < recogniser_.places(); ++i) {
    const DescribedPlace& place = recogniser_.place(i);
    if (sessions_[place.session] != at.session) continue;
    if (place.stamp <= at.stamp) before = i;
    if (place.stamp >= at.stamp && !after) after = i;
  }
  if (!before || !after) return std::nullopt;
  const StampNs from = recogniser_.place(*before).stamp, to = recogniser_.place(*after).stamp;
  if (from == to) return travelled_[*before];
  const double share = static_cast<double>(at.stamp - from) / static_cast<double>(to - from);
  return travelled_[*before] + share * (travelled_[*after] - travelled_[*before]);
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
  output.belief = toBelief(recognition);
  output.belief.at = {sessions_.back(), stamp};
  output.belief.travelled = travelled;
  if (description.status == ObservationStatus::Used) travelled_.push_back(travelled);
  const auto propose = [&](const PlaceMatch& match, double probability) {
    const DescribedPlace& place = recogniser_.place(match.place);
    if (selector_.select({place.session, travelled_[match.place]}, {sessions_.size() - 1, travelled}, probability))
      output.closures.push_back({{sessions_[place.session], place.stamp}, output.belief.at, probability});
  };
  if (recognition.match) propose(*recognition.match, recognition.probability);
  for (const RecognisedPlace& other : recognition.others) propose(other.match, other.probability);
  last_belief_ = output.belief;
  return output;
}

}  // namespace fabmap_node
