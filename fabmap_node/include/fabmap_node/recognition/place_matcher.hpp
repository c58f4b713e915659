// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/places/place_groups.hpp"
#include "fabmap_node/places/place_index.hpp"
#include "fabmap_node/recognition/agreement_cache.hpp"
#include "fabmap_node/recognition/second_look.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {
/// Options of the search for the earlier place that an observation shows.
struct MatcherOptions {
  int first_looks = 30;             ///< likeliest candidates by words, of which descriptors are compared: of single
                                    ///< images a quarter, of panoramas all
  int second_looks = 10;            ///< candidates of these with the best agreement, of which all are; 0: none
  std::size_t look_features = 540;  ///< features per single image for descriptor matching; selectFeatures(): 20 kB
  urban_nav_core::StampNs elsewhere = 10'000'000'000;  ///< smallest time between places of one session that are
                                                       ///< elsewhere, ns
  AgreementCache* known_agreements =
      nullptr;  ///< agreements of other maps of the same observations; must outlive the matcher
};

/// Reads packLook() of a place of the map, by the index of its session and its stamp.
using LookReader = std::function<std::string(std::size_t session, urban_nav_core::StampNs stamp)>;

/// Observation prepared for matching.
struct DescribedPlace {
  std::size_t session = 0;  ///< index of the session
  urban_nav_core::StampNs stamp = 0;
  WordSet words;
  std::string look;  ///< packLook()
};

/// Candidate place of an observation.
struct PlaceMatch {
  std::size_t place = 0, session = 0;
  double log_likelihood = 0.0;      ///< at this place, nats
  double log_likelihood_new = 0.0;  ///< at a new place, nats
  int agreeing = 0;                 ///< matched descriptors that are geometrically consistent
  bool has_elsewhere = false;       ///< a place elsewhere was compared; without one, both margins are zero
  PlaceEvidence evidence;
};

/// Log likelihoods of the words of a query, nats.
struct WordLikelihoods {
  std::vector<double> at_places;  ///< one for each place
  double at_new = 0.0;            ///< at a new place; infinite without sampled places
  urban_nav_core::StampNs newest = std::numeric_limits<urban_nav_core::StampNs>::max();  ///< see likelihoods()
};

/// Comparison of a place with a query, whether or not a search would compare it.
struct PlaceComparison {
  PlaceMatch match;
  LookAgreement look;             ///< zero without descriptor matching
  std::size_t candidates = 0;     ///< places admitted as candidates
  std::size_t rank_by_words = 0;  ///< rank of the place among them; 1: the likeliest
  bool is_compared = false;       ///< a search would match its descriptors
  bool is_first = false;          ///< a search would return it as the likeliest
};

/// Places with their words and descriptors, and the search for the place of an observation (Newman et al. 2009, section
/// 3): likelihoods of words first, then descriptor matching for the likeliest candidates. The likelihood of a new place
/// is the mean over the model's sampled places (Cummins and Newman 2008, section 4.4.2).
///
/// Observations that geometry confirmed as one place (PlaceGroups) are its appearances: one of them is the candidate,
/// the first one admitted, and of all the best is compared.
///
/// matches() is deterministic for any number of threads. Const functions are thread-safe if the reader of descriptors
/// is, and without MatcherOptions::known_agreements.
class PlaceMatcher {
 public:
  /// The model must outlive the matcher. `sampled`: observations of places outside the map. With `read_look` the
  /// matcher does not keep the words and descriptors of places beside the index: descriptors are read for each
  /// comparison, by the calling thread.
  PlaceMatcher(const LikelihoodTable& table, const std::vector<WordSet>& sampled, const MatcherOptions& options,
               LookReader read_look = {});

  /// Appends a place, whose number is the previous size().
  void add(DescribedPlace place);
  std::size_t size() const { return places_.size(); }
  const DescribedPlace& place(std::size_t i) const { return places_[i]; }

  /// Adds two places as appearances of one, or removes the pair. Requires a < b < size().
  void confirm(const ConfirmedPair& pair);
  void withdraw(std::size_t a, std::size_t b);
  const PlaceGroups& groups() const { return groups_; }

  /// Returns the likelihoods of a query for matches(); valid until a place is added. `newest`: later places of its
  /// session are no appearances of other candidates.
  WordLikelihoods likelihoods(
      const DescribedPlace& query,
      urban_nav_core::StampNs newest = std::numeric_limits<urban_nav_core::StampNs>::max()) const;
  /// Returns the compared places among those admitted by `isCandidate`, most probable first; empty if there are none.
  /// Margins of the first one exclude places elsewhere that show the same place; if all do, the margin is that to the
  /// best agreement that would not. Those of the others do not exclude them. `compared`:
  /// largest number of places of which descriptors are compared; nullopt: that of the options.
  std::vector<PlaceMatch> matches(const DescribedPlace& query, const WordLikelihoods& likelihoods,
                                  std::optional<int> compared,
                                  const std::function<bool(std::size_t)>& isCandidate) const;
  /// Returns the matches with the options.
  std::vector<PlaceMatch> matches(const DescribedPlace& query,
                                  const std::function<bool(std::size_t)>& isCandidate) const;
  /// Returns the first of matches().
  std::optional<PlaceMatch> match(const DescribedPlace& query,
                                  const std::function<bool(std::size_t)>& isCandidate) const;
  /// Returns the evidence that a query shows `place`, which need not be a candidate. Requires place < size().
  PlaceComparison compare(const DescribedPlace& query, std::size_t place,
                          const std::function<bool(std::size_t)>& isCandidate) const;

 private:
  struct Candidate {
    std::size_t place = 0;
    double log_likelihood = 0.0;
    LookAgreement agreement;
    std::size_t shown = 0;  // appearance of `place` with this agreement
    double share() const { return agreement.share; }
  };
  bool isElsewhere(std::size_t a, std::size_t b) const;
  bool isNear(std::size_t a, std::size_t b) const;
  double agreement(std::size_t a, std::size_t b) const;
  std::vector<std::size_t> asked(std::size_t place, const DescribedPlace& query, urban_nav_core::StampNs newest) const;
  std::vector<Candidate> candidatesByWords(const DescribedPlace& query, const WordLikelihoods& likelihoods,
                                           const std::function<bool(std::size_t)>& isCandidate) const;
  std::vector<Candidate> likeliest(const DescribedPlace& query, const WordLikelihoods& likelihoods,
                                   std::optional<int> compared,
                                   const std::function<bool(std::size_t)>& isCandidate) const;
  std::vector<Candidate> selectVaried(const std::vector<Candidate>& ranked, int most) const;
  void compareAppearances(const DescribedPlace& query, const ComparedFeatures& own, urban_nav_core::StampNs newest,
                          std::vector<Candidate>& candidates) const;
  std::vector<Candidate> comparedCandidates(const DescribedPlace& query, const WordLikelihoods& likelihoods,
                                            std::optional<int> compared,
                                            const std::function<bool(std::size_t)>& isCandidate) const;
  double logLikelihoodNew(const WordSet& query) const;
  void compareAll(const DescribedPlace& query, const ComparedFeatures& own, std::size_t step,
                  std::vector<Candidate>& candidates) const;
  PlaceMatch judge(const DescribedPlace& query, const std::vector<Candidate>& candidates, std::size_t which,
                   double log_likelihood_new) const;
  bool showSamePlace(const Candidate& best, const Candidate& other) const;
  std::string packedLook(std::size_t place) const;
  ComparedFeatures look(std::size_t place) const;

  const MatcherOptions options_;
  const LookReader read_look_;  // empty: places_ contain the descriptors
  PlaceIndex index_, sampled_;
  std::vector<DescribedPlace> places_;
  PlaceGroups groups_;
};

}  // namespace fabmap_node
