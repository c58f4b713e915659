// SPDX-License-Identifier: BSD-3-Clause
#include "places/place_query.hpp"

#include <cmath>

#include "places/place_sessions.hpp"

namespace urban_nav {

PlaceQuery queryPlaces(const fabmap_node::PlaceModel& model, const std::vector<std::string>& inputs,
                       const std::vector<std::string>& topics, const fabmap_node::RecogniserOptions& options,
                       Console& console) {
  PlaceQuery query;
  fabmap_node::PlaceRecogniser recogniser(model, options);
  const fabmap_node::PlaceDescriber describer(model.vocabulary, {}, options.matcher.look_features);
  std::vector<std::size_t> row_of_place;
  readPlaceSessions(
      inputs, topics, console, &describer,
      [&](std::size_t, const std::string& name) {
        query.sessions.push_back(name);
        recogniser.beginSession();
      },
      [&](StampedObservation observation) {
        PlaceQueryRow row;
        row.session = query.sessions.size() - 1;
        row.stamp = observation.stamp;
        row.recognition = recogniser.process(observation.stamp, observation.description);
        if (row.recognition.match) row.matched_row = row_of_place[row.recognition.match->place];
        if (row.recognition.status == fabmap_node::ObservationStatus::Used) row_of_place.push_back(query.rows.size());
        else ++query.unused;
        query.rows.push_back(std::move(row));
      });
  if (query.unused > 0)
    console.warn(std::to_string(query.unused) + " of " + std::to_string(query.rows.size()) +
                 " images are dark, blurred or blank and were not used");
  return query;
}

fabmap_node::PlaceModel readPlaceModel(const std::string& path) {
  return path == "default" ? fabmap_node::defaultModel() : fabmap_node::readModel(path);
}

std::vector<Option> placeQueryOptions() {
  return {
      {"--mask",
       "S",
       "places of the same session that are younger are no candidates, s (default 20)",
       false,
       false,
       {}},
      {"--second-look",
       "on,off",
       "compare the likeliest places descriptor by descriptor (default on)",
       false,
       false,
       {"on", "off"}},
      {"--sequence",
       "on,off",
       "the images before an image count as evidence for places of other sessions (default on)",
       false,
       false,
       {"on", "off"}},
      {"--topic", "ROLE:=NAME", "topics of bags: panorama0 ... panorama4, left (default: guessed)", false, true, {}}};
}

fabmap_node::RecogniserOptions placeRecogniserOptions(const Arguments& arguments) {
  fabmap_node::RecogniserOptions options;
  options.mask = static_cast<urban_nav_core::StampNs>(std::llround(1e9 * arguments.number("mask", 20.0, 0.0, 1e6)));
  if (arguments.get("second-look", "on") == "off") options.matcher.second_looks = 0;
  options.sequence = arguments.get("sequence", "on") == "on";
  return options;
}

}  // namespace urban_nav
