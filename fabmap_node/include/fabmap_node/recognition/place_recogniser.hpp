// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/recognition/location_filter.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"

namespace fabmap_node {
/// Options of PlaceRecogniser.
struct RecogniserOptions {
  MatcherOptions matcher;
  bool sequence = true;  ///< for places of other sessions, use previous observations, if the model is calibrated for it
  bool detects_stationary = true;  ///< an observation of a stationary camera replaces the previous one in the sequence
  urban_nav_core::StampNs mask = 20'000'000'000;  ///< more recent places of the same session are not candidates, ns
};
/// Likeliest place of one session.
struct RecognisedPlace {
  PlaceMatch match;
  double probability = 0.0;  ///< that the observation shows this place
};
/// Result of place recognition for one observation. Places of several sessions may be one place: their probabilities
/// do not exclude each other.
struct PlaceRecognition {
  ObservationStatus status = ObservationStatus::Used;
  std::size_t words = 0;            ///< distinct words of the observation
  std::optional<PlaceMatch> match;  ///< nullopt if there is no earlier place
  double probability = 0.0;         ///< that `match` shows the same place
  /// Likeliest place of each other session, at most PlaceRecogniser::kMostSessions, in descending order of probability.
  /// Sessions do not compete: places of a session with the same light do not hide those of other sessions.
  std::vector<RecognisedPlace> others;
};

/// Recognises places in the observations of consecutive sessions: each is compared with the previous places, then
/// becomes a place itself. Calls must be in order of time. Not thread-safe.
class PlaceRecogniser {
 public:
  static constexpr std::size_t kMostSessions = 6;  ///< with a place in the result: those with the likeliest words

  /// The model must outlive this object. `read_look`: see PlaceMatcher.
  PlaceRecogniser(const PlaceModel& model, const RecogniserOptions& options, LookReader read_look = {});
  PlaceRecogniser(const PlaceRecogniser&) = delete;
  PlaceRecogniser& operator=(const PlaceRecogniser&) = delete;

  /// Starts a session; its places are not candidates for each other within the mask.
  void beginSession();
  /// Adds an observation as a place without recognition. Returns whether it is usable.
  bool add(urban_nav_core::StampNs stamp, const PlaceDescription& description);
  PlaceRecognition process(urban_nav_core::StampNs stamp, const PlaceDescription& description);

  /// Adds two places as appearances of one, or removes the pair: PlaceMatcher.
  void confirm(const ConfirmedPair& pair) { matcher_.confirm(pair); }
  void withdraw(std::size_t a, std::size_t b) { matcher_.withdraw(a, b); }
  const PlaceGroups& groups() const { return matcher_.groups(); }

  /// Returns session index and stamp of a place.
  const DescribedPlace& place(std::size_t i) const { return matcher_.place(i); }
  std::size_t places() const { return matcher_.size(); }

 private:
  RecognisedPlace recognise(const PlaceMatch& match, int cameras) const;
  RecognisedPlace recogniseBySequence(const std::vector<PlaceMatch>& matches, int cameras);
  std::vector<std::size_t> furtherSessions(const WordLikelihoods& likelihoods, urban_nav_core::StampNs newest,
                                           const std::vector<RecognisedPlace>& found) const;
  std::vector<RecognisedPlace> recogniseSessions(const DescribedPlace& query, int cameras);
  void followLook(const std::string& look);

  const PlaceModel& model_;
  const RecogniserOptions options_;
  LikelihoodTable table_;
  PlaceMatcher matcher_;
  LocationFilter filter_, filter_before_;      // after and before the last observation of this session
  std::optional<ComparedFeatures> last_look_;  // in this session, for the detection of stationary observations
  std::size_t session_ = 0;
  bool has_session_ = false;
};

}  // namespace fabmap_node
