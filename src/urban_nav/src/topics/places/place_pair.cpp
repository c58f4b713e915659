// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_pair.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/plot.hpp"
#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/store/model_rows.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace urban_nav {

using fabmap_node::ObservationStatus;
using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

constexpr double kFarthestPlace = 1.0;  // s from the requested time

struct SessionPlaces {
  urban_nav_store::Session session;
  urban_nav_store::SessionId map;  // that its poses are in; empty: not relaxed
  std::vector<StoredPlace> rows;
};

std::vector<SessionPlaces> readPlaces(urban_nav_store::Store& store) {
  std::vector<SessionPlaces> sessions;
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    const auto anchor = store.sessions().anchor(session.id);
    sessions.push_back({session, anchor ? anchor->map : "", {}});
    TableStore<StoredPlace>(store).forEach(session.id,
                                           [&](const StoredPlace& row) { sessions.back().rows.push_back(row); });
    if (sessions.back().rows.empty()) sessions.pop_back();
  }
  std::stable_sort(sessions.begin(), sessions.end(), [](const SessionPlaces& a, const SessionPlaces& b) {
    return a.rows.front().stamp < b.rows.front().stamp;
  });
  return sessions;
}

/// Index of a place among all.
struct PlaceNumber {
  std::size_t session = 0, row = 0;
  bool operator<(const PlaceNumber& other) const {
    return session != other.session ? session < other.session : row < other.row;
  }
  bool operator==(const PlaceNumber& other) const { return session == other.session && row == other.row; }
};

double timeBetween(const SessionPlaces& places, const StoredPlace& row, const TimeQuery& time) {
  const std::string& name = places.session.name;
  if (!time.session.empty() && name.rfind(time.session, 0) != 0 && places.session.id.rfind(time.session, 0) != 0)
    return std::numeric_limits<double>::infinity();
  if (!time.since_begin) return std::abs(urban_nav_core::secondsBetween(time.stamp, row.stamp));
  return std::abs(urban_nav_core::secondsBetween(places.rows.front().stamp, row.stamp) - time.seconds);
}

PlaceNumber nearestPlace(const std::vector<SessionPlaces>& sessions, const TimeQuery& time, const std::string& path,
                         const char* what) {
  PlaceNumber nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < sessions.size(); ++s)
    for (std::size_t i = 0; i < sessions[s].rows.size(); ++i) {
      const double off = timeBetween(sessions[s], sessions[s].rows[i], time);
      if (off >= least) continue;
      least = off;
      nearest = {s, i};
    }
  if (!(least <= kFarthestPlace))
    throw DataError(path,
                    std::string("no place within 1 s of ") + what +
                        (std::isfinite(least) ? "; the nearest is " + urban_nav_core::formatNumber(least, 3) + " s off"
                                              : std::string()),
                    "");
  return nearest;
}

PlacePair::End describeEnd(const SessionPlaces& places, std::size_t row) {
  PlacePair::End end;
  end.row = places.rows[row];
  end.name = places.session.name.empty() ? places.session.id : places.session.name;
  end.since = urban_nav_core::secondsBetween(places.rows.front().stamp, end.row.stamp);
  return end;
}

fabmap_node::PlaceModel readStoredModel(urban_nav_store::Store& store, const StoredPlace& row) {
  const auto stored = TableStore<StoredModel>(store).get({row.session, row.model, {}, {}});
  if (!stored) throw DataError(store.path(), "does not hold the model of places " + row.model, "");
  return fabmap_node::parseModel(fabmap_node::modelBytes(*stored, store.path()), store.path());
}

std::string findReason(const PlacePair& pair) {
  for (const PlacePair::End* end : {&pair.earlier, &pair.query})
    if (end->row.status != toString(ObservationStatus::Used))
      return "the observation of " + end->name + " +" + urban_nav_core::formatNumber(end->since, 6) +
             " s is not used: " + end->row.status;
  if (pair.is_masked) return "both are of one session and too close in time for a revisit (fabmap_node.mask)";
  const fabmap_node::PlaceComparison& comparison = *pair.comparison;
  if (!comparison.is_compared)
    return "the place is not among the most similar ones by words, which are compared by descriptors";
  if (!comparison.is_first)
    return "another place is more similar: only the likeliest place of each session is proposed";
  if (pair.probability <= pair.closure_probability)
    return "the probability is not above " + urban_nav_core::formatNumber(pair.closure_probability) +
           " (fabmap_node.closure_probability)";
  return "its probability is sufficient; the number of closures per metre and between two stretches is limited "
         "(fabmap_node.closures_per_metre, enough_closures), or the previous observations contradict it";
}

/// Compares the query with all previous places of its map, as a run over the sessions last does; with those of all maps
/// if the two places are in different ones.
void compareInMap(const std::vector<SessionPlaces>& sessions, const PlaceNumber& earlier, const PlaceNumber& query,
                  const fabmap_node::PlaceModel& model, const fabmap_node::Parameters& parameters, PlacePair& pair) {
  const fabmap_node::LikelihoodTable table(model.tree, model.detector, fabmap_node::Dependence::ChowLiu);
  fabmap_node::MatcherOptions options;
  if (!parameters.descriptor_matching) options.second_looks = 0;
  fabmap_node::PlaceMatcher matcher(table, model.sampled_places, options);
  const auto mask = static_cast<StampNs>(std::llround(1e9 * parameters.mask));
  const auto describe = [&](std::size_t s, const StoredPlace& row) {
    const auto description = fabmap_node::toPlaceDescription(row, model.vocabulary.size());
    return fabmap_node::DescribedPlace{s, row.stamp, description.words, description.look};
  };
  const urban_nav_store::SessionId& map = sessions[query.session].map;
  const bool in_one_map = !map.empty() && sessions[earlier.session].map == map;
  std::size_t number = 0;
  for (std::size_t s = 0; s <= query.session; ++s) {
    if (in_one_map && sessions[s].map != map) continue;
    for (std::size_t i = 0; i < sessions[s].rows.size() && PlaceNumber{s, i} < query; ++i) {
      const StoredPlace& row = sessions[s].rows[i];
      if (row.status != toString(ObservationStatus::Used) || row.model != pair.query.row.model) continue;
      if (PlaceNumber{s, i} == earlier) number = matcher.size();
      matcher.add(describe(s, row));
    }
  }
  const fabmap_node::DescribedPlace place = describe(query.session, pair.query.row);
  pair.comparison = matcher.compare(place, number, [&](std::size_t i) {
    return matcher.place(i).session != place.session || matcher.place(i).stamp <= place.stamp - mask;
  });
  pair.probability =
      model.calibration(static_cast<int>(pair.query.row.cameras)).probability(pair.comparison->match.evidence);
}

}  // namespace

PlacePair explainPlaces(urban_nav_store::Store& store, const TimeQuery& one, const TimeQuery& other,
                        const fabmap_node::Parameters& parameters) {
  const std::vector<SessionPlaces> sessions = readPlaces(store);
  if (sessions.empty()) throw DataError(store.path(), "holds no places", "a store of map with the stage places");
  PlaceNumber earlier = nearestPlace(sessions, one, store.path(), "T1"),
              query = nearestPlace(sessions, other, store.path(), "T2");
  if (earlier == query)
    throw DataError(store.path(), "has one place for both times",
                    "two times with a larger "
                    "distance");
  if (query < earlier) std::swap(earlier, query);
  PlacePair pair;
  pair.earlier = describeEnd(sessions[earlier.session], earlier.row);
  pair.query = describeEnd(sessions[query.session], query.row);
  pair.closure_probability = parameters.closure_probability;
  if (pair.earlier.row.model != pair.query.row.model)
    throw DataError(store.path(), "has words of two models for these times", "sessions mapped with the same model");
  const fabmap_node::PlaceModel model = readStoredModel(store, pair.query.row);
  const auto words_a = fabmap_node::toPlaceDescription(pair.earlier.row, model.vocabulary.size()).words,
             words_b = fabmap_node::toPlaceDescription(pair.query.row, model.vocabulary.size()).words;
  pair.earlier.words = words_a.size();
  pair.query.words = words_b.size();
  fabmap_node::WordSet shared;
  std::set_intersection(words_a.begin(), words_a.end(), words_b.begin(), words_b.end(), std::back_inserter(shared));
  pair.shared_words = shared.size();
  pair.is_masked = earlier.session == query.session &&
                   urban_nav_core::secondsBetween(pair.earlier.row.stamp, pair.query.row.stamp) < parameters.mask;
  const std::string used = toString(ObservationStatus::Used);
  if (pair.earlier.row.status == used && pair.query.row.status == used)
    compareInMap(sessions, earlier, query, model, parameters, pair);
  pair.reason = findReason(pair);
  return pair;
}

}  // namespace urban_nav
