// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "map/stage.hpp"
#include "topics/places/place_writer.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"

namespace urban_nav {

/// Stores the places of a session while it is read: its panoramas, or the left images of its keyframes without them.
/// With panoramas, left images are also described, by which localization finds keyframes.
class PlacesPass final : public SessionPass {
 public:
  /// `ms_features`: receives the time of each observation; must outlive the object.
  PlacesPass(MapContext& context, const Stage::SessionStart& start, std::shared_ptr<const LoadedPlaceModel> model,
             std::vector<double>& ms_features);

  void process(PassItem& item) override;
  void process(const urban_nav_ros::Panorama& panorama) override;
  std::string checkpoint() override;
  void finish(const PassEnd& end) override;

 private:
  void put(const PlaceWriter::Described& described);
  void putKeyframe(const PlaceWriter::Described& described);
  void writeAll();

  urban_nav_store::Store& store_;
  urban_nav_store::SessionId id_;
  std::vector<std::size_t> cameras_;  // numbers of the panorama's cameras; empty: left images
  urban_nav_registration::KeyframeSelector selector_;
  PlaceWriter writer_, keyframe_writer_;  // the latter if there are panoramas
  std::vector<double>& ms_features_;
};

}  // namespace urban_nav
