// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/place_belief.hpp"

#include <algorithm>
#include <array>

namespace fabmap_node {

const char* toString(PlaceKnowledge knowledge) {
  constexpr std::array<const char*, 3> kNames = {"KNOWN", "UNSURE", "NEW"};
  return kNames[static_cast<std::size_t>(knowledge)];
}

void decide(const Parameters& parameters, PlaceBelief& belief) {
  std::stable_sort(belief.likeliest.begin(), belief.likeliest.end(),
                   [](const LikelyPlace& a, const LikelyPlace& b) { return a.probability > b.probability; });
  const double known = belief.likeliest.empty() ? 0.0 : belief.likeliest.front().probability;
  belief.p_new = 1.0 - known;
  belief.knowledge = known > parameters.known_probability     ? PlaceKnowledge::Known
                     : known > parameters.closure_probability ? PlaceKnowledge::Unsure
                                                              : PlaceKnowledge::New;
}

}  // namespace fabmap_node
