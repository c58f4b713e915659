// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_sessions.hpp"

#include "fabmap_node/features/feature_extractor.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "topics/places/place_source.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_ros/image.hpp"

namespace urban_nav {
namespace {

constexpr std::size_t kImagesAtOnce = 32;  // decoded before features are extracted on all threads

StampedObservation describeImages(const fabmap_node::FeatureExtractor& extractor, const PlaceReading& reading,
                                  const PlaceImages& images) {
  std::vector<urban_nav_core::ImageView> views;
  for (const cv::Mat& grey : images.grey) views.push_back(urban_nav_ros::toView(grey));
  StampedObservation observation;
  observation.stamp = images.stamp;
  if (reading.describer != nullptr) observation.description = reading.describer->describe(views);
  else observation.observation = extractor.extract(views);
  if (reading.with_thumbnails) observation.thumbnail = fabmap_node::placeThumbnail(views);
  return observation;
}

}  // namespace

void readPlaceSessions(const std::vector<std::string>& inputs, const std::vector<std::string>& topics, Console& console,
                       const PlaceReading& reading, const std::function<void(std::size_t, const std::string&)>& session,
                       const std::function<void(StampedObservation)>& place) {
  std::vector<std::unique_ptr<PlaceSource>> sources;  // all opened first, to report errors before the run
  for (const std::string& input : inputs) sources.push_back(openPlaceSource(input, topics));
  const fabmap_node::FeatureExtractor extractor;
  std::vector<std::string> names;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    names.push_back(urban_nav_input::uniqueName(urban_nav_input::plainName(inputs[s]), names));
    session(s, names.back());
    PlaceSource& source = *sources[s];
    for (const std::string& note : source.notes()) console.info(note);
    const std::size_t noted = source.notes().size();
    Progress progress(console, names.back(), "images", static_cast<std::int64_t>(source.expected()));
    std::int64_t done = 0;
    for (bool more = true; more;) {
      std::vector<PlaceImages> batch;
      while (batch.size() < kImagesAtOnce && more) {
        std::optional<PlaceImages> images = source.next();
        more = images.has_value();
        if (images) batch.push_back(std::move(*images));
      }
      std::vector<StampedObservation> observations(batch.size());
      urban_nav_core::forEach(batch.size(), 1,
                              [&](std::size_t i) { observations[i] = describeImages(extractor, reading, batch[i]); });
      for (StampedObservation& observation : observations) {
        place(std::move(observation));
        progress.update(++done);
      }
    }
    progress.finish(done);
    for (std::size_t i = noted; i < source.notes().size(); ++i) console.warn(source.notes()[i]);
  }
}

}  // namespace urban_nav
