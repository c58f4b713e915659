// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_writer.hpp"

#include <chrono>

#include "fabmap_node/fab_map.hpp"
#include "fabmap_node/retrieval/keyframe_places.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_ros/image.hpp"

namespace urban_nav {

namespace {

constexpr std::size_t kMaxPendingPlaces = 4;

PlaceWriter::Described describePlace(const LoadedPlaceModel& model, const fabmap_node::PlaceDescriber& describer,
                                     const urban_nav_store::SessionId& session, urban_nav_core::StampNs stamp,
                                     PlaceWriter::Kind kind, const PlaceWriter::Images& images) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<cv::Mat> grey = images();
  std::vector<urban_nav_core::ImageView> views;
  for (const cv::Mat& image : grey) views.push_back(urban_nav_ros::toView(image));
  PlaceWriter::Described described;
  described.row = fabmap_node::toStoredPlace(session, stamp, describer.describe(views), model.hash);
  if (kind == PlaceWriter::Kind::Place) described.row.thumbnail = fabmap_node::placeThumbnail(views);
  described.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return described;
}

}  // namespace

std::shared_ptr<const LoadedPlaceModel> loadPlaceModel(const fabmap_node::Parameters& parameters) {
  auto loaded = std::make_shared<LoadedPlaceModel>();
  const bool is_default = parameters.model == "default";
  loaded->bytes =
      is_default ? std::string(fabmap_node::defaultModelBytes()) : urban_nav_core::readBytes(parameters.model);
  loaded->hash = fabmap_node::modelHash(loaded->bytes);
  loaded->model = fabmap_node::parseModel(loaded->bytes, parameters.model);
  return loaded;
}

PlaceWriter::PlaceWriter(std::shared_ptr<const LoadedPlaceModel> model, const fabmap_node::Parameters& parameters,
                         urban_nav_store::SessionId session, Kind kind, bool one_thread)
    : model_(std::move(model)),
      describer_(std::make_shared<fabmap_node::PlaceDescriber>(
          model_->model, fabmap_node::featureOptions(parameters),
          kind == Kind::Place ? fabmap_node::MatcherOptions().look_features : fabmap_node::kKeyframeLookFeatures)),
      session_(std::move(session)),
      kind_(kind),
      launch_(one_thread ? std::launch::deferred : std::launch::async) {}

std::optional<PlaceWriter::Described> PlaceWriter::add(urban_nav_core::StampNs stamp, Images images) {
  std::optional<Described> done;
  if (made_.size() == kMaxPendingPlaces) done = next();
  made_.push_back(std::async(launch_, [model = model_, describer = describer_, session = session_, kind = kind_, stamp,
                                       images = std::move(images)] {
    return describePlace(*model, *describer, session, stamp, kind, images);
  }));
  return done;
}

std::optional<PlaceWriter::Described> PlaceWriter::next() {
  if (made_.empty()) return std::nullopt;
  Described first = made_.front().get();
  made_.pop_front();
  return first;
}

}  // namespace urban_nav
