// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "base/json.hpp"
#include "base/page.hpp"
#include "base/time_query.hpp"
#include "fabmap_node/parameters.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {

/// Comparison of two observations by place recognition, from the words and descriptors in a store.
struct PlacePair {
  struct End {
    urban_nav_store::StoredPlace row;
    std::string name;    ///< of the session
    double since = 0.0;  ///< s from the first place of the session
    std::size_t words = 0;
  };
  End earlier, query;  ///< the query is the later one in the order of the sessions
  std::size_t shared_words = 0;
  bool is_masked = false;                                  ///< of one session, and too close in time
  std::optional<fabmap_node::PlaceComparison> comparison;  ///< nullopt if one of them cannot be used
  double probability = 0.0;                                ///< of the observation alone, without the sequence
  double closure_probability = 0.0;                        ///< limit above which a closure is proposed
  std::string reason;                                      ///< reason why it was not proposed
};

/// Explains the two places nearest to these times. Throws DataError if the store holds no places, no place within 1 s
/// of one of the times, or not the model of their words.
PlacePair explainPlaces(urban_nav_store::Store& store, const TimeQuery& one, const TimeQuery& other,
                        const fabmap_node::Parameters& parameters);

std::string explain(const PlacePair& pair);
Page explainOnPage(const PlacePair& pair, const std::string& store_path);
Json explainAsJson(const PlacePair& pair);

}  // namespace urban_nav
