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
constexpr double kCarried = 2.0;  // m along both paths from a confirmed closure: places that drift apart at once are at
                                  // most this much farther from each other

RecogniserOptions recogniserOptions(const Parameters& parameters, AgreementCache* known_agreements) {
  RecogniserOptions options;
  options.matcher.second_looks = parameters.descriptor_matching ? kSecondLookCandidates : 0;
  options.matcher.known_agreements = known_agreements;
  options.sequence = parameters.sequence;
  options.detects_stationary = false;  // process() passes on only observations of a moving camera
  options.mask = static_cast<StampNs>(std::llround(1e9 * parameters.mask));
  return options;
}

}  // namespace

FabMap::FabMap(const PlaceModel& model, const Parameters& parameters, LookReader read_look,
               AgreementCache* known_agreements)
    : parameters_(parameters),
      recogniser_(model, recogniserOptions(parameters, known_agreements), std::move(read_look)),
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

std::optional<std::size_t> FabMap::findSession(const std::string& name) const {
  const auto found = std::find(sessions_.rbegin(), sessions_.rend(), name);
  if (found == sessions_.rend()) return std::nullopt;
  return static_cast<std::size_t>(sessions_.rend() - found) - 1;
}

void FabMap::confirm(const ConfirmedClosure& closure) {
  withdraw(closure.a, closure.b);
  const auto a = findSession(closure.a.session), b = findSession(closure.b.session);
  if (!a || !b) return;
  learnt_.push_back({closure, *a, *b, {}});
  for (std::size_t i = 0; i < places(); ++i)
    if (place(i).session == *b) learn(learnt_.back(), i);
}

/// Pairs an observation near `b` with the place as far from `a`.
void FabMap::learn(Learnt& learnt, std::size_t observation) {
  const ConfirmedClosure& closure = learnt.closure;
  const double beyond = travelled_[observation] - closure.travelled_b;
  if (std::abs(beyond) > kCarried) return;
  const double travelled = closure.travelled_a + (closure.is_same_direction ? beyond : -beyond);
  std::optional<std::size_t> nearest;
  double off = kCarried;
  for (std::size_t i = 0; i < observation; ++i) {
    if (place(i).session != learnt.session_a || isForgotten(i) || std::abs(travelled_[i] - travelled) >= off) continue;
    off = std::abs(travelled_[i] - travelled);
    nearest = i;
  }
  if (!nearest) return;
  learnt.pairs.push_back({*nearest, observation, closure.metres + off});
  recogniser_.confirm(learnt.pairs.back());
}

void FabMap::withdraw(const urban_nav_core::PoseRef& a, const urban_nav_core::PoseRef& b) {
  const auto sa = findSession(a.session), sb = findSession(b.session);
  const auto found = std::find_if(learnt_.begin(), learnt_.end(), [&](const Learnt& one) {
    return sa == one.session_a && sb == one.session_b && one.closure.a.stamp == a.stamp &&
           one.closure.b.stamp == b.stamp;
  });
  if (found == learnt_.end()) return;
  const Learnt gone = std::move(*found);
  learnt_.erase(found);
  const auto follows = [&](const ConfirmedPair& pair) {
    return std::any_of(learnt_.begin(), learnt_.end(), [&](const Learnt& one) {
      return std::any_of(one.pairs.begin(), one.pairs.end(),
                         [&](const ConfirmedPair& other) { return other.a == pair.a && other.b == pair.b; });
    });
  };
  for (const ConfirmedPair& pair : gone.pairs)
    if (!follows(pair)) recogniser_.withdraw(pair.a, pair.b);
}

std::size_t FabMap::forgotten() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < places(); ++i) count += isForgotten(i) ? 1u : 0u;
  return count;
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
  if (description.status == ObservationStatus::Used) {
    travelled_.push_back(travelled);
    for (Learnt& learnt : learnt_)
      if (learnt.session_b == sessions_.size() - 1) learn(learnt, places() - 1);
  }
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
