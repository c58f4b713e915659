// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_recogniser.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "fabmap_node/recognition/compact_look.hpp"

namespace fabmap_node {

using urban_nav_core::StampNs;

namespace {

constexpr int kComparedOfSession = 10;  // for a session without a place among the likeliest of all: as many as all of
                                        // which are compared

}  // namespace

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

bool PlaceRecogniser::add(StampNs stamp, const PlaceDescription& description) {
  has_session_ = true;
  if (description.status != ObservationStatus::Used) return false;
  matcher_.add({session_, stamp, description.words, description.look});
  return true;
}

PlaceRecognition PlaceRecogniser::process(StampNs stamp, const PlaceDescription& description) {
  has_session_ = true;
  PlaceRecognition result;
  result.status = description.status;
  result.words = description.words.size();
  if (result.status != ObservationStatus::Used) return result;
  DescribedPlace query{session_, stamp, description.words, description.look};
  if (options_.sequence && options_.detects_stationary) followLook(description.look);
  std::vector<RecognisedPlace> places = recogniseSessions(query, description.cameras);
  std::stable_sort(places.begin(), places.end(),
                   [](const RecognisedPlace& a, const RecognisedPlace& b) { return a.probability > b.probability; });
  if (!places.empty()) {
    result.match = places.front().match;
    result.probability = places.front().probability;
    result.others.assign(places.begin() + 1, places.end());
  }
  matcher_.add(std::move(query));
  return result;
}

/// Places of this session, which show places in the same light, would be the first of most searches: if one is, other
/// sessions are searched on their own.
std::vector<RecognisedPlace> PlaceRecogniser::recogniseSessions(const DescribedPlace& query, int cameras) {
  const StampNs newest = query.stamp - options_.mask;
  const WordLikelihoods likelihoods = matcher_.likelihoods(query, newest);
  std::vector<PlaceMatch> matches = matcher_.matches(query, likelihoods, std::nullopt, [&](std::size_t i) {
    const DescribedPlace& place = matcher_.place(i);
    return place.session != session_ || place.stamp <= newest;
  });
  std::vector<RecognisedPlace> found;
  if (!matches.empty() && matches.front().session == session_) {
    found.push_back(recognise(matches.front(), cameras));
    matches = matcher_.matches(query, likelihoods, std::nullopt,
                               [&](std::size_t i) { return matcher_.place(i).session != session_; });
  }
  if (!matches.empty()) found.push_back(recogniseBySequence(matches, cameras));
  for (const std::size_t session : furtherSessions(likelihoods, newest, found)) {
    const std::vector<PlaceMatch> own = matcher_.matches(query, likelihoods, kComparedOfSession, [&](std::size_t i) {
      const DescribedPlace& place = matcher_.place(i);
      return place.session == session && (session != session_ || place.stamp <= newest);
    });
    if (!own.empty()) found.push_back(recognise(own.front(), cameras));
  }
  return found;
}

/// Returns the sessions without a found place, those with the likeliest words first.
std::vector<std::size_t> PlaceRecogniser::furtherSessions(const WordLikelihoods& likelihoods, StampNs newest,
                                                          const std::vector<RecognisedPlace>& found) const {
  std::map<std::size_t, double> best;
  for (std::size_t i = 0; i < matcher_.size(); ++i) {
    const DescribedPlace& place = matcher_.place(i);
    if (place.session == session_ && place.stamp > newest) continue;
    const auto [session, is_first] = best.try_emplace(place.session, likelihoods.at_places[i]);
    if (!is_first) session->second = std::max(session->second, likelihoods.at_places[i]);
  }
  for (const RecognisedPlace& place : found) best.erase(place.match.session);
  std::vector<std::size_t> sessions;
  for (const auto& [session, likelihood] : best) sessions.push_back(session);
  std::stable_sort(sessions.begin(), sessions.end(),
                   [&best](std::size_t a, std::size_t b) { return best.at(a) > best.at(b); });
  sessions.resize(std::min(sessions.size(), kMostSessions - std::min(kMostSessions, found.size())));
  return sessions;
}

/// Removes the previous observation from the filter if the camera has not moved since.
void PlaceRecogniser::followLook(const std::string& look) {
  ComparedFeatures now = unpackLook(look, "observation");
  if (last_look_ && isStationary(*last_look_, now)) filter_ = filter_before_;
  last_look_ = std::move(now);
}

RecognisedPlace PlaceRecogniser::recognise(const PlaceMatch& match, int cameras) const {
  return {match, model_.calibration(cameras).probability(match.evidence)};
}

/// Returns the likeliest place under the prior of the sequence, which is used for places of other sessions only. Within
/// a session, a repetitive facade is matched at a constant distance from the robot, which is as consistent as a
/// revisit.
RecognisedPlace PlaceRecogniser::recogniseBySequence(const std::vector<PlaceMatch>& matches, int cameras) {
  const std::optional<PlaceCalibration>& sequence = model_.sequenceCalibration(cameras);
  RecognisedPlace recognised = recognise(matches.front(), cameras);
  if (!options_.sequence || !sequence) return recognised;
  const PlaceCalibration& alone = model_.calibration(cameras);
  std::vector<LocationHypothesis> hypotheses;
  for (const PlaceMatch& match : matches)
    hypotheses.push_back({match.session, match.place, alone.logit(match.evidence), match.evidence.look_margin});
  const PlaceMatch& likeliest = matches[likeliestLocation(filter_, hypotheses)];
  if (likeliest.session != session_) {
    recognised.match = likeliest;
    recognised.match.evidence.sequence = filter_.pathMargin(likeliest.session, likeliest.place);
    recognised.probability = sequence->probability(recognised.match.evidence);
  }
  filter_before_ = filter_;
  filter_.update(hypotheses);
  return recognised;
}

}  // namespace fabmap_node
