// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/plot.hpp"
#include "topics/places/place_pair_picture.hpp"
#include "topics/places/places_run.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {

using fabmap_node::PlaceBelief;
using urban_nav_store::StoredPlace;

namespace {

constexpr std::size_t kSurePictures = 4, kUnsurePictures = 4;

using BeliefRefs = std::vector<const PlaceBelief*>;

/// Returns the recognitions of highest probability and the proposed ones of lowest, each spread over the run.
BeliefRefs spreadBeliefs(BeliefRefs beliefs, std::size_t most) {
  if (beliefs.size() <= most) return beliefs;
  BeliefRefs some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(beliefs[i * (beliefs.size() - 1) / (most - 1)]);
  return some;
}

std::string readThumbnail(urban_nav_store::Store& store, const MapContext& context, const urban_nav_core::PoseRef& at) {
  const auto name = std::find(context.names.begin(), context.names.end(), at.session);
  if (name == context.names.end()) return {};
  StoredPlace key;
  key.session = context.ids()[static_cast<std::size_t>(name - context.names.begin())];
  key.stamp = at.stamp;
  const auto row = urban_nav_store::TableStore<StoredPlace>(store).get(key);
  return row ? row->thumbnail : std::string();
}

std::string printCaption(const PlaceBelief& belief, const fabmap_node::LikelyPlace& place) {
  return std::string(toString(belief.knowledge)) + ", probability " +
         urban_nav_core::formatNumber(place.probability, 4) + ", " + std::to_string(belief.agreeing) +
         " descriptors agree" + (place.verdict ? std::string(", ") + toString(*place.verdict) + " by geometry" : "") +
         ". Above: " + place.at.session + ", " + urban_nav_core::printStamp(place.at.stamp) +
         " s; below: " + belief.at.session + ", " + urban_nav_core::printStamp(belief.at.stamp) + " s.";
}

}  // namespace

std::vector<PagePicture> placePictures(const PlacesRun& run, const MapContext& context) {
  BeliefRefs known, unsure;
  for (const auto& session : run.beliefs)
    for (const PlaceBelief& belief : session) {
      if (belief.is_stationary || belief.likeliest.empty()) continue;
      if (belief.knowledge == fabmap_node::PlaceKnowledge::Known) known.push_back(&belief);
      if (belief.knowledge == fabmap_node::PlaceKnowledge::Unsure) unsure.push_back(&belief);
    }
  std::vector<PagePicture> pictures;
  for (const BeliefRefs& some : {spreadBeliefs(known, kSurePictures), spreadBeliefs(unsure, kUnsurePictures)})
    for (const PlaceBelief* belief : some) {
      const fabmap_node::LikelyPlace& place = belief->likeliest.front();
      if (auto picture =
              placePairPicture(readThumbnail(*context.store, context, place.at),
                               readThumbnail(*context.store, context, belief->at), printCaption(*belief, place)))
        pictures.push_back(std::move(*picture));
    }
  return pictures;
}

}  // namespace urban_nav
