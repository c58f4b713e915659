// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/places_run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "fabmap_node/store/place_rows.hpp"
#include "map/learnt_links.hpp"
#include "map/map_division.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {

using fabmap_node::FabMap;
using fabmap_node::ObservationStatus;
using fabmap_node::TravelledDistance;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

/// Recognition among the sessions of one group. Adds to a common result.
class GroupRecognition {
 public:
  GroupRecognition(const fabmap_node::Parameters& parameters, const LoadedPlaceModel& model, const MapContext& context,
                   const std::vector<std::size_t>& group, fabmap_node::AgreementCache* known_agreements,
                   PlacesRun& result)
      : model_(model),
        context_(context),
        ids_(context.ids()),
        order_(recognitionOrder(context, group)),
        map_(
            model.model, parameters,
            [this](std::size_t session, urban_nav_core::StampNs stamp) {
              StoredPlace key;
              key.session = ids_[order_[session]];
              key.stamp = stamp;
              const auto row = TableStore<StoredPlace>(*context_.store).get(key);
              return row ? row->descriptors : std::string();
            },
            known_agreements),
        learnt_(knownLinks(context)),
        result_(result) {
    if (known_agreements != nullptr) known_agreements->beginMap(order_);
  }

  /// Returns the number of places with words of another model.
  std::size_t run() {
    const std::vector<const SessionOdometry*> runs = context_.runs();
    for (const std::size_t s : order_) {
      map_.beginSession(context_.names[s]);
      travelled_[ids_[s]] = travelledDistance(*runs[s]);
      addSession(s, ids_[s], travelled_[ids_[s]], hasKnownPlaces(context_, s));
      learn(s);
    }
    result_.places += map_.places();
    return other_model_;
  }

 private:
  void addSession(std::size_t s, const urban_nav_store::SessionId& id, const TravelledDistance& travelled,
                  bool is_known) {
    TableStore<StoredPlace>(*context_.store).forEach(id, [&](const StoredPlace& row) {
      if (row.model != model_.hash) {
        ++other_model_;
        return;
      }
      const auto description = fabmap_node::toPlaceDescription(row, model_.model.vocabulary.size());
      if (is_known) return map_.addPlace(row.stamp, description, travelled.at(row.stamp));
      const auto begin = std::chrono::steady_clock::now();
      fabmap_node::PlaceOutput output = map_.process(row.stamp, description, travelled.at(row.stamp));
      result_.ms_inference.push_back(
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
      count(description);
      result_.closures.insert(result_.closures.end(), output.closures.begin(), output.closures.end());
      result_.beliefs[s].push_back(std::move(output.belief));
    });
  }

  /// Confirms the links from a session, which was recognised last, to places of this and of earlier sessions.
  void learn(std::size_t s) {
    for (const urban_nav_store::PlaceLink& link : learnt_) {
      const auto earlier = travelled_.find(link.earlier);
      if (link.session != ids_[s] || earlier == travelled_.end()) continue;
      const auto a = static_cast<std::size_t>(std::find(ids_.begin(), ids_.end(), link.earlier) - ids_.begin());
      map_.confirm({{context_.names[a], link.earlier_stamp},
                    {context_.names[s], link.stamp},
                    earlier->second.at(link.earlier_stamp),
                    travelled_.at(link.session).at(link.stamp),
                    link.metres,
                    link.same_direction != 0});
    }
  }

  void count(const fabmap_node::PlaceDescription& description) {
    ++result_.observations;
    result_.has_panoramas = result_.has_panoramas || description.cameras > 1;
    result_.incomplete += description.missing > 0 ? 1u : 0u;
    if (description.status != ObservationStatus::Used) ++result_.unused[toString(description.status)];
  }

  const LoadedPlaceModel& model_;
  const MapContext& context_;
  const std::vector<urban_nav_store::SessionId> ids_;
  const std::vector<std::size_t> order_;  // indices of sessions, as they are recognised
  FabMap map_;                            // with descriptors from the store
  const std::vector<urban_nav_store::PlaceLink> learnt_;
  std::map<urban_nav_store::SessionId, TravelledDistance> travelled_;  // of recognised sessions
  PlacesRun& result_;
  std::size_t other_model_ = 0;
};

}  // namespace

TravelledDistance travelledDistance(const SessionOdometry& run) {
  TravelledDistance travelled;
  for (const SmoothedFrame& frame : run.settled) travelled.add(frame.stamp, frame.T_odom_base.pose.t());
  return travelled;
}

PlacesRun runPlaces(const fabmap_node::Parameters& parameters, const LoadedPlaceModel& model, const MapContext& context,
                    fabmap_node::AgreementCache* known_agreements) {
  PlacesRun result;
  result.beliefs.resize(context.names.size());
  std::size_t other_model = 0;
  for (const std::vector<std::size_t>& group : sessionsOfGroups(context))
    other_model += GroupRecognition(parameters, model, context, group, known_agreements, result).run();
  if (other_model > 0)
    result.warnings.push_back(std::to_string(other_model) +
                              " places of previous sessions have words of a different model and are not used");
  return result;
}

}  // namespace urban_nav
