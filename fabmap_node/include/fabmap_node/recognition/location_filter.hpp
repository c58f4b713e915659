// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace fabmap_node {

/// Candidate place of an observation, with the evidence of that observation only.
struct LocationHypothesis {
  std::size_t session = 0, place = 0;  ///< places of a session are numbered along the path
  double log_ratio = 0.0;              ///< log likelihood ratio to a new place, nats
  double margin = 0.0;                 ///< of its agreement to that of places elsewhere
};

/// Location prior from the topology (Newman et al. 2009, section 3.2): after an observation at a place, the next one is
/// at one of the neighbouring places along the path, at a new place, or at a place elsewhere. Forward filter over the
/// compared places and the hypothesis NEW.
class LocationFilter {
 public:
  /// Returns the log odds of a place relative to NEW before its observation, minus those without a prior; nats, within
  /// -3 ... 5.3. Zero for every place until the first update.
  double priorLogOdds(std::size_t session, std::size_t place) const;
  /// Returns the mean margin of the last twenty observations at the places of one path at constant speed that ends
  /// at `place`, the path for which it is largest: half to twice the speed of the first visit, in either direction. An
  /// observation counts zero if no place within one of the path was compared, if its margin is negative, or if it is
  /// missing. On a path that is driven again, places advance with the observations, each clearer than all places
  /// elsewhere; places with a similar appearance stay constant, jump, or resemble others as much.
  double pathMargin(std::size_t session, std::size_t place) const;
  /// Applies the evidence of one observation. Of hypotheses around one place, only the likeliest is used.
  void update(const std::vector<LocationHypothesis>& hypotheses);

  /// Returns the probability after the last update that the place is new; 0.5 before.
  double probabilityNew() const { return p_new_; }

 private:
  struct Location {
    std::size_t session = 0, place = 0;
    double probability = 0.0;
  };
  std::deque<std::vector<LocationHypothesis>> recent_;  // by observation, most recent first
  std::vector<Location> locations_;                     // at most one around each place; with p_new_ they sum to 1
  double p_new_ = 0.5;
};

/// Returns the index of the most probable hypothesis under the prior of `filter`. Requires at least one.
std::size_t likeliestLocation(const LocationFilter& filter, const std::vector<LocationHypothesis>& hypotheses);

}  // namespace fabmap_node
