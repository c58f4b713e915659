// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace fabmap_node {

/// Place that an observation may show, with the evidence of that observation alone.
struct LocationHypothesis {
  std::size_t session = 0, place = 0;  ///< places of a session have ascending numbers along the path
  double log_ratio = 0.0;              ///< log likelihood ratio of this place to a new one, nats
};

/// Location prior from the topology (Newman et al. 2009, section 3.2): after an observation at a place, the next one
/// shows one of the places around it, before or after it along the path, or a new place, or a place elsewhere. A
/// forward filter over the places that were compared and the hypothesis NEW.
class LocationFilter {
 public:
  /// Returns the log odds of a place to NEW before its observation, relative to those without any prior; nats, within
  /// -3 ... 5.3. Zero for every place until the first update.
  double priorLogOdds(std::size_t session, std::size_t place) const;
  /// Returns the share, 0 ... 1, of the last ten observations whose likeliest places lie on one path at constant speed
  /// that ends at `place`: half to twice the speed of the first visit, in either direction. Along a path that is driven
  /// again, places succeed each other as the observations do; places that merely look alike stay, or jump.
  double motionConsistency(std::size_t session, std::size_t place) const;
  /// Applies the evidence of one observation. Of hypotheses around one place, the likeliest counts.
  void update(const std::vector<LocationHypothesis>& hypotheses);

  /// Probability after the last update that the place is new; 0.5 before.
  double probabilityNew() const { return p_new_; }

 private:
  struct Location {
    std::size_t session = 0, place = 0;
    double probability = 0.0;
  };
  std::vector<Location> recent_;     // likeliest places, the last one first
  std::vector<Location> locations_;  // no two around one place; with p_new_ they sum to 1
  double p_new_ = 0.5;
};

/// Returns the index of the hypothesis that is likeliest with the prior of `filter`. Requires at least one.
std::size_t likeliestLocation(const LocationFilter& filter, const std::vector<LocationHypothesis>& hypotheses);

}  // namespace fabmap_node
