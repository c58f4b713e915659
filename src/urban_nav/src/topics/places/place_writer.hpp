// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/parameters.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {

/// Model of places with the hash of its bytes.
struct LoadedPlaceModel {
  std::string bytes, hash;
  fabmap_node::PlaceModel model;
};

/// Reads the model given by the parameter. Throws UserError or DataError.
std::shared_ptr<const LoadedPlaceModel> loadPlaceModel(const fabmap_node::Parameters& parameters);

/// Describes the observations of one session, each in a separate thread while the next ones are read. Returns rows in
/// order, so that the output does not depend on timing. Not thread-safe.
class PlaceWriter {
 public:
  struct Described {
    urban_nav_store::StoredPlace row;
    double ms = 0.0;  ///< decoding included
  };
  /// Returns grey images by camera number; an empty one is missing.
  using Images = std::function<std::vector<cv::Mat>()>;

  /// Place: data for recognition, and a thumbnail. Keyframe: data for localization, in addition to the stored keyframe.
  enum class Kind { Place, Keyframe };

  PlaceWriter(std::shared_ptr<const LoadedPlaceModel> model, const fabmap_node::Parameters& parameters,
              urban_nav_store::SessionId session, Kind kind, bool one_thread);

  /// Adds an observation. Returns a finished earlier one, if there is one. `images`: called once, in any thread.
  std::optional<Described> add(urban_nav_core::StampNs stamp, Images images);
  /// Returns the next observation that add() has not returned; blocks until it is described. nullopt: no more.
  std::optional<Described> next();

 private:
  std::shared_ptr<const LoadedPlaceModel> model_;
  std::shared_ptr<const fabmap_node::PlaceDescriber> describer_;
  urban_nav_store::SessionId session_;
  Kind kind_;
  std::launch launch_;
  std::deque<std::future<Described>> made_;
};

}  // namespace urban_nav
