// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/place_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "fabmap_node/recognition/compact_look.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {

using urban_nav_core::StampNs;

namespace {

/// A candidate elsewhere shows the same place, in another session or on another lap, if its agreement with both the
/// query and the best place is at least this share of the agreement of query and best place.
constexpr double kSamePlaceShare = 0.5;
constexpr std::size_t kThinning = 4;       // of the descriptors of single images in the first comparison
constexpr int kSmallestSelection = 10;     // candidates without descriptor matching
constexpr std::size_t kMostSorted = 1000;  // candidates, unless more are required

double logMeanOfExponentials(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double value : logs) sum += std::exp(value - top);
  return top + std::log(sum / static_cast<double>(logs.size()));
}

ComparedFeatures unpackPlaceLook(const std::string& packed, const DescribedPlace& place) {
  return unpackLook(packed, "place at " + urban_nav_core::printStamp(place.stamp) + " s");
}

}  // namespace

PlaceMatcher::PlaceMatcher(const LikelihoodTable& table, const std::vector<WordSet>& sampled,
                           const MatcherOptions& options, LookReader read_look)
    : options_(options), read_look_(std::move(read_look)), index_(table), sampled_(table) {
  for (const WordSet& words : sampled) sampled_.add(words);
}

void PlaceMatcher::add(DescribedPlace place) {
  index_.add(place.words);
  if (read_look_) places_.push_back({place.session, place.stamp, {}, {}});
  else places_.push_back(std::move(place));
}

std::string PlaceMatcher::packedLook(std::size_t place) const {
  const DescribedPlace& one = places_[place];
  return read_look_ ? read_look_(one.session, one.stamp) : one.look;
}

ComparedFeatures PlaceMatcher::look(std::size_t place) const {
  return unpackPlaceLook(packedLook(place), places_[place]);
}

bool PlaceMatcher::isNear(std::size_t a, std::size_t b) const {
  return places_[a].session == places_[b].session &&
         std::abs(places_[a].stamp - places_[b].stamp) <= options_.elsewhere;
}

/// Appearances of a place are also near places of the other sessions in which it was confirmed.
bool PlaceMatcher::isElsewhere(std::size_t a, std::size_t b) const {
  const auto hasNear = [&](std::size_t one, std::size_t other) {
    const std::vector<std::size_t>& shown = groups_.appearances(one);
    return std::any_of(shown.begin(), shown.end(), [&](std::size_t each) { return isNear(each, other); });
  };
  return !isNear(a, b) && !hasNear(a, b) && !hasNear(b, a);
}

double PlaceMatcher::agreement(std::size_t a, std::size_t b) const {
  std::vector<Candidate> other{{b, 0.0, {}, b}};
  compareAll(places_[a], look(a), 1, other);
  return other.front().share();
}

void PlaceMatcher::confirm(const ConfirmedPair& pair) {
  groups_.confirm(pair, [this](std::size_t a, std::size_t b) { return agreement(a, b); });
}

void PlaceMatcher::withdraw(std::size_t a, std::size_t b) {
  groups_.withdraw(a, b, [this](std::size_t one, std::size_t other) { return agreement(one, other); });
}

/// Returns the appearances of a place that may be compared with a query: at least the place.
std::vector<std::size_t> PlaceMatcher::asked(std::size_t place, const DescribedPlace& query, StampNs newest) const {
  std::vector<std::size_t> shown{place};
  for (const std::size_t each : groups_.appearances(place))
    if (each != place && (places_[each].session != query.session || places_[each].stamp <= newest))
      shown.push_back(each);
  return shown;
}

/// Returns a candidate for each place: of the appearances of one, the first that is admitted.
std::vector<PlaceMatcher::Candidate> PlaceMatcher::candidatesByWords(
    const DescribedPlace& query, const WordLikelihoods& likelihoods,
    const std::function<bool(std::size_t)>& isCandidate) const {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < likelihoods.at_places.size(); ++i) {
    if (!isCandidate(i) || groups_.isForgotten(i)) continue;
    all.push_back({i, likelihoods.at_places[i], {}, i});
    const std::vector<std::size_t>& shown = groups_.appearances(i);
    if (shown.empty()) continue;
    if (std::any_of(shown.begin(), shown.end(), [&](std::size_t each) { return each < i && isCandidate(each); })) {
      all.pop_back();
      continue;
    }
    for (const std::size_t each : asked(i, query, likelihoods.newest)) {
      if (likelihoods.at_places[each] <= all.back().log_likelihood) continue;
      all.back().log_likelihood = likelihoods.at_places[each];
      all.back().shown = each;
    }
  }
  return all;
}

/// Selects the first candidates, a third of them elsewhere than the very first.
std::vector<PlaceMatcher::Candidate> PlaceMatcher::selectVaried(const std::vector<Candidate>& ranked,
                                                                int most_wanted) const {
  const auto most = static_cast<std::size_t>(std::max(2, most_wanted));
  const std::size_t reserved = (most + 2) / 3;
  std::vector<Candidate> chosen;
  std::size_t elsewhere = 0;
  for (const Candidate& candidate : ranked) {
    const bool is_elsewhere = !chosen.empty() && isElsewhere(chosen.front().place, candidate.place);
    if (!is_elsewhere && chosen.size() - elsewhere >= most - reserved) continue;
    if (chosen.size() >= most) break;
    elsewhere += is_elsewhere ? 1u : 0u;
    chosen.push_back(candidate);
  }
  return chosen;
}

std::vector<PlaceMatcher::Candidate> PlaceMatcher::likeliest(
    const DescribedPlace& query, const WordLikelihoods& likelihoods, std::optional<int> compared,
    const std::function<bool(std::size_t)>& isCandidate) const {
  std::vector<Candidate> all = candidatesByWords(query, likelihoods, isCandidate);
  const auto isLikelier = [](const Candidate& a, const Candidate& b) {
    return a.log_likelihood != b.log_likelihood ? a.log_likelihood > b.log_likelihood : a.place < b.place;
  };
  const int wanted = options_.second_looks > 0
                         ? std::max(compared.value_or(options_.first_looks), options_.second_looks)
                         : kSmallestSelection;
  // In a large map, the first ones nearly always suffice.
  if (all.size() > kMostSorted) {
    const auto sorted = all.begin() + static_cast<std::ptrdiff_t>(kMostSorted);
    std::partial_sort(all.begin(), sorted, all.end(), isLikelier);
    std::vector<Candidate> chosen = selectVaried({all.begin(), sorted}, wanted);
    if (chosen.size() >= static_cast<std::size_t>(wanted)) return chosen;
  }
  std::sort(all.begin(), all.end(), isLikelier);
  return selectVaried(all, wanted);
}

/// Compares every `step`-th descriptor of the places with those of the query.
void PlaceMatcher::compareAll(const DescribedPlace& query, const ComparedFeatures& own, std::size_t step,
                              std::vector<Candidate>& candidates) const {
  AgreementCache* const cache = options_.known_agreements;
  const AgreementCache::Observation asked{query.session, query.stamp};
  const auto shown = [&](const Candidate& candidate) {
    return AgreementCache::Observation{places_[candidate.shown].session, places_[candidate.shown].stamp};
  };
  std::vector<std::size_t> unknown;
  std::vector<std::string> packed;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto known = cache != nullptr ? cache->find(asked, shown(candidates[i]), step) : std::nullopt;
    if (known) {
      candidates[i].agreement = *known;
      continue;
    }
    unknown.push_back(i);
    packed.push_back(packedLook(candidates[i].shown));
  }
  urban_nav_core::forEach(unknown.size(), 1, [&](std::size_t k) {
    Candidate& candidate = candidates[unknown[k]];
    const ComparedFeatures all = unpackPlaceLook(packed[k], places_[candidate.shown]);
    candidate.agreement = secondLook(own, step > 1 ? thinnedOut(all, step) : all);
  });
  if (cache == nullptr) return;
  for (const std::size_t i : unknown) cache->keep(asked, shown(candidates[i]), step, candidates[i].agreement);
}

/// Compares the other appearances of the candidates, and keeps the best agreement of each.
void PlaceMatcher::compareAppearances(const DescribedPlace& query, const ComparedFeatures& own, StampNs newest,
                                      std::vector<Candidate>& candidates) const {
  std::vector<Candidate> others;
  std::vector<std::size_t> of_candidate;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    for (const std::size_t each : asked(candidates[i].place, query, newest)) {
      if (each == candidates[i].shown) continue;
      others.push_back({candidates[i].place, candidates[i].log_likelihood, {}, each});
      of_candidate.push_back(i);
    }
  compareAll(query, own, 1, others);
  for (std::size_t k = 0; k < others.size(); ++k)
    if (others[k].share() > candidates[of_candidate[k]].share()) candidates[of_candidate[k]] = others[k];
}

bool PlaceMatcher::showSamePlace(const Candidate& best, const Candidate& other) const {
  return other.share() > kSamePlaceShare * best.share() &&
         agreement(best.shown, other.shown) > best.share() * kSamePlaceShare;
}

PlaceMatch PlaceMatcher::judge(const DescribedPlace& query, const std::vector<Candidate>& candidates, std::size_t which,
                               double log_likelihood_new) const {
  const Candidate& one = candidates[which];
  PlaceMatch match;
  match.place = one.place;
  match.session = places_[one.place].session;
  match.log_likelihood = one.log_likelihood;
  match.agreeing = one.agreement.agreeing;
  double other_likelihood = -std::numeric_limits<double>::infinity(), other_share = 0.0;
  for (const Candidate& candidate : candidates) {
    if (!isElsewhere(one.place, candidate.place)) continue;
    match.has_elsewhere = true;
    if (which == 0 && showSamePlace(one, candidate)) continue;
    other_likelihood = std::max(other_likelihood, candidate.log_likelihood);
    other_share = std::max(other_share, candidate.share());
  }
  const double words = static_cast<double>(std::max<std::size_t>(1, query.words.size()));
  match.evidence.look = std::sqrt(one.share());
  const bool has_others = std::isfinite(other_likelihood);
  if (!has_others) other_share = kSamePlaceShare * one.share();
  if (match.has_elsewhere) match.evidence.look_margin = match.evidence.look - std::sqrt(other_share);
  if (has_others) match.evidence.word_margin = (one.log_likelihood - other_likelihood) / words;
  match.log_likelihood_new = std::isfinite(log_likelihood_new) ? log_likelihood_new : one.log_likelihood;
  match.evidence.word_ratio = (match.log_likelihood - match.log_likelihood_new) / words;
  return match;
}

/// Returns infinity without sampled places.
double PlaceMatcher::logLikelihoodNew(const WordSet& query) const {
  std::vector<double> at_samples;
  sampled_.logLikelihoods(query, at_samples);
  return at_samples.empty() ? std::numeric_limits<double>::infinity() : logMeanOfExponentials(at_samples);
}

std::vector<PlaceMatcher::Candidate> PlaceMatcher::comparedCandidates(
    const DescribedPlace& query, const WordLikelihoods& likelihoods, std::optional<int> compared,
    const std::function<bool(std::size_t)>& isCandidate) const {
  std::vector<Candidate> candidates = likeliest(query, likelihoods, compared, isCandidate);
  if (options_.second_looks > 0 && !candidates.empty()) {
    const ComparedFeatures own = unpackPlaceLook(query.look, query);
    const bool is_reduced = candidates.size() > static_cast<std::size_t>(options_.second_looks);
    const bool is_thinned = is_reduced && own.cameras == 1;
    compareAll(query, own, is_thinned ? kThinning : 1, candidates);
    if (is_reduced) {
      std::stable_sort(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.share() > b.share(); });
      candidates = selectVaried(candidates, options_.second_looks);
    }
    if (is_thinned) compareAll(query, own, 1, candidates);
    if (!groups_.empty()) compareAppearances(query, own, likelihoods.newest, candidates);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.share() != b.share() ? a.share() > b.share() : a.log_likelihood > b.log_likelihood;
  });
  return candidates;
}

WordLikelihoods PlaceMatcher::likelihoods(const DescribedPlace& query, StampNs newest) const {
  WordLikelihoods likelihoods;
  likelihoods.newest = newest;
  index_.logLikelihoods(query.words, likelihoods.at_places);
  likelihoods.at_new = logLikelihoodNew(query.words);
  return likelihoods;
}

std::vector<PlaceMatch> PlaceMatcher::matches(const DescribedPlace& query, const WordLikelihoods& likelihoods,
                                              std::optional<int> compared,
                                              const std::function<bool(std::size_t)>& isCandidate) const {
  const std::vector<Candidate> candidates = comparedCandidates(query, likelihoods, compared, isCandidate);
  std::vector<PlaceMatch> found;
  for (std::size_t i = 0; i < candidates.size(); ++i) found.push_back(judge(query, candidates, i, likelihoods.at_new));
  return found;
}

std::vector<PlaceMatch> PlaceMatcher::matches(const DescribedPlace& query,
                                              const std::function<bool(std::size_t)>& isCandidate) const {
  return matches(query, likelihoods(query), std::nullopt, isCandidate);
}

PlaceComparison PlaceMatcher::compare(const DescribedPlace& query, std::size_t place,
                                      const std::function<bool(std::size_t)>& isCandidate) const {
  PlaceComparison comparison;
  const WordLikelihoods by_words = likelihoods(query);
  std::vector<Candidate> candidates = comparedCandidates(query, by_words, std::nullopt, isCandidate);
  const std::vector<std::size_t>& shown = groups_.appearances(place);
  auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    return candidate.place == place || std::find(shown.begin(), shown.end(), candidate.place) != shown.end();
  });
  comparison.is_compared = found != candidates.end();
  comparison.is_first = comparison.is_compared && found == candidates.begin();
  if (!comparison.is_compared) {
    candidates.push_back({place, by_words.at_places[place], {}, place});
    if (options_.second_looks > 0)
      candidates.back().agreement = secondLook(unpackPlaceLook(query.look, query), look(place));
    found = candidates.end() - 1;
  }
  comparison.look = found->agreement;
  comparison.match = judge(query, candidates, static_cast<std::size_t>(found - candidates.begin()), by_words.at_new);
  comparison.rank_by_words = 1;
  for (std::size_t i = 0; i < by_words.at_places.size(); ++i) {
    if (!isCandidate(i)) continue;
    ++comparison.candidates;
    comparison.rank_by_words += by_words.at_places[i] > by_words.at_places[place] ? 1u : 0u;
  }
  return comparison;
}

std::optional<PlaceMatch> PlaceMatcher::match(const DescribedPlace& query,
                                              const std::function<bool(std::size_t)>& isCandidate) const {
  const std::vector<PlaceMatch> found = matches(query, isCandidate);
  return found.empty() ? std::nullopt : std::optional<PlaceMatch>(found.front());
}

}  // namespace fabmap_node
