// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_query.hpp"

#include <cmath>

#include "topics/places/place_sessions.hpp"

namespace urban_nav {

namespace {

/// Recognises observations and appends their rows.
class QueryRun {
 public:
  QueryRun(const fabmap_node::PlaceModel& model, const fabmap_node::RecogniserOptions& options)
      : recogniser_(model, options) {}

  void beginSession(const std::string& name) {
    query_.sessions.push_back(name);
    recogniser_.beginSession();
  }
  void add(urban_nav_core::StampNs stamp, const fabmap_node::PlaceDescription& description) {
    PlaceQueryRow row;
    row.session = query_.sessions.size() - 1;
    row.stamp = stamp;
    row.recognition = recogniser_.process(stamp, description);
    if (row.recognition.match) row.matched_row = row_of_place_[row.recognition.match->place];
    if (row.recognition.status == fabmap_node::ObservationStatus::Used) row_of_place_.push_back(query_.rows.size());
    else ++query_.unused;
    query_.rows.push_back(std::move(row));
  }
  PlaceQuery take() { return std::move(query_); }

 private:
  fabmap_node::PlaceRecogniser recogniser_;
  PlaceQuery query_;
  std::vector<std::size_t> row_of_place_;
};

void warnAboutUnused(std::size_t unused, std::size_t all, Console& console) {
  if (unused > 0)
    console.warn(std::to_string(unused) + " of " + std::to_string(all) +
                 " images are dark, blurred or blank and were not used");
}

}  // namespace

PlaceQuery queryPlaces(const fabmap_node::PlaceModel& model, const std::vector<std::string>& inputs,
                       const std::vector<std::string>& topics, const fabmap_node::RecogniserOptions& options,
                       Console& console) {
  QueryRun run(model, options);
  const fabmap_node::PlaceDescriber describer(model, {}, options.matcher.look_features);
  readPlaceSessions(
      inputs, topics, console, {&describer, false},
      [&](std::size_t, const std::string& name) { run.beginSession(name); },
      [&](StampedObservation observation) { run.add(observation.stamp, observation.description); });
  PlaceQuery query = run.take();
  warnAboutUnused(query.unused, query.rows.size(), console);
  return query;
}

PlaceRecording recordPlaces(const fabmap_node::PlaceModel& model, const std::vector<std::string>& inputs,
                            const std::vector<std::string>& topics, const fabmap_node::MatcherOptions& options,
                            Console& console) {
  PlaceRecording recording;
  std::size_t unused = 0;
  const fabmap_node::PlaceDescriber describer(model, {}, options.look_features);
  readPlaceSessions(
      inputs, topics, console, {&describer, true},
      [&](std::size_t, const std::string& name) { recording.sessions.push_back(name); },
      [&](StampedObservation observation) {
        unused += observation.description.status != fabmap_node::ObservationStatus::Used ? 1u : 0u;
        recording.places.push_back({recording.sessions.size() - 1, observation.stamp,
                                    std::move(observation.description), std::move(observation.thumbnail)});
      });
  warnAboutUnused(unused, recording.places.size(), console);
  return recording;
}

PlaceQuery recognisePlaces(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                           const fabmap_node::RecogniserOptions& options,
                           const std::function<void(std::size_t)>& progress) {
  QueryRun run(model, options);
  std::size_t sessions = 0;
  for (std::size_t i = 0; i < recording.places.size(); ++i) {
    const PlaceRecording::Place& place = recording.places[i];
    for (; sessions <= place.session; ++sessions) run.beginSession(recording.sessions[sessions]);
    run.add(place.stamp, place.description);
    if (progress) progress(i + 1);
  }
  for (; sessions < recording.sessions.size(); ++sessions) run.beginSession(recording.sessions[sessions]);
  return run.take();
}

fabmap_node::PlaceModel readPlaceModel(const std::string& path) {
  return path == "default" ? fabmap_node::defaultModel() : fabmap_node::readModel(path);
}

std::vector<Option> placeQueryOptions() {
  return {
      {"--mask",
       "S",
       "places of the same session younger than this are not candidates, s (default 20)",
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
       "use the previous images as evidence for places of other sessions (default on)",
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
