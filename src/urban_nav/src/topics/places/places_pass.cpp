// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/places_pass.hpp"

#include <set>

#include "fabmap_node/store/model_rows.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace urban_nav {

using urban_nav_store::StoredKeyframePlace;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

/// Grey images of a panorama, by camera number.
std::vector<cv::Mat> decodePanorama(const urban_nav_ros::Panorama& panorama, const std::vector<std::size_t>& cameras) {
  std::vector<cv::Mat> images(cameras.back() + 1);
  for (std::size_t i = 0; i < panorama.images.size(); ++i)
    if (!panorama.images[i].empty()) images[cameras[i]] = panorama.images[i].grey().pixels;
  return images;
}

}  // namespace

PlacesPass::PlacesPass(MapContext& context, const Stage::SessionStart& start,
                       std::shared_ptr<const LoadedPlaceModel> model, std::vector<double>& ms_features)
    : store_(*context.store),
      id_(context.sessions[start.session].id),
      selector_(context.options.parameters.get(urban_nav_registration::table())),
      writer_(model, context.options.parameters.get(fabmap_node::table()), id_, PlaceWriter::Kind::Place,
              context.options.threads == 1),
      keyframe_writer_(model, context.options.parameters.get(fabmap_node::table()), id_, PlaceWriter::Kind::Keyframe,
                       context.options.threads == 1),
      ms_features_(ms_features) {
  for (const urban_nav_input::PanoramaCamera& camera : context.sessions[start.session].info.panorama)
    cameras_.push_back(camera.number);
  TableStore<StoredModel> models(store_);
  if (!models.get({id_, model->hash, {}, {}})) models.put(fabmap_node::toStoredModel(id_, model->hash, model->bytes));
  if (!start.checkpoint) return;
  std::set<urban_nav_core::StampNs> stored;
  const auto keep = [&](const StoredPlace& row) { stored.insert(row.stamp); };
  if (cameras_.empty()) TableStore<StoredPlace>(store_).forEach(id_, keep);
  else TableStore<StoredKeyframePlace>(store_).forEach(id_, keep);
  for (const OdometryFrame& row : context.sessions[start.session].odometry->frames)
    if (stored.count(row.stamp) > 0) selector_.keep(row.T_odom_base);
}

void PlacesPass::process(PassItem& item) {
  const OdometryFrame& row = *item.odometry;
  const urban_nav_core::StereoPairWithMotion& frame = item.input.assembled;
  if (!row.accepted || frame.pair.left.empty() || !selector_.select(row.T_odom_base)) return;
  // The owner keeps the pixels alive.
  const auto image = [left = frame.pair.left, owner = frame.left_owner] {
    return std::vector<cv::Mat>{cv::Mat(left.height, left.width, CV_8UC1, const_cast<std::uint8_t*>(left.data),
                                        static_cast<std::size_t>(left.stride))};
  };
  if (cameras_.empty()) {
    if (const auto described = writer_.add(row.stamp, image)) put(*described);
  } else if (const auto described = keyframe_writer_.add(row.stamp, image)) {
    putKeyframe(*described);
  }
}

void PlacesPass::process(const urban_nav_ros::Panorama& panorama) {
  const auto images = [panorama, cameras = cameras_] { return decodePanorama(panorama, cameras); };
  if (const auto described = writer_.add(panorama.stamp, images)) put(*described);
}

std::string PlacesPass::checkpoint() {
  writeAll();
  return {};
}

void PlacesPass::finish(const PassEnd&) { writeAll(); }

void PlacesPass::put(const PlaceWriter::Described& described) {
  TableStore<StoredPlace>(store_).put(described.row);
  ms_features_.push_back(described.ms);
}

void PlacesPass::putKeyframe(const PlaceWriter::Described& described) {
  TableStore<StoredKeyframePlace>(store_).put({described.row});
}

void PlacesPass::writeAll() {
  while (const auto described = writer_.next()) put(*described);
  while (const auto described = keyframe_writer_.next()) putKeyframe(*described);
}

}  // namespace urban_nav
