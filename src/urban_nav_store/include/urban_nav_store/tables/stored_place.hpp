// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Observation of a place: data of place recognition for a panorama, or for an image of a single camera.
struct StoredPlace {
  SessionId session;
  urban_nav_core::StampNs stamp = 0;
  std::int64_t cameras = 1;  ///< cameras of the head: 1 for a single camera
  std::int64_t missing = 0;  ///< cameras without an image
  std::string status;        ///< "used", or why it is unsuitable for recognition
  std::string model;         ///< hash of the model with these words
  std::string words;         ///< in the encoding of the stage, as are the descriptors
  std::string descriptors;   ///< of some of its features, at most 20 kB
  std::string thumbnail;     ///< JPEG; may be empty

  static Table table() {
    Table table{"place", 2};
    table.since = 3;
    table.wide = true;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.integer("stamp_ns", stamp);
    columns.integer("cameras", cameras);
    columns.integer("missing", missing);
    columns.text("status", status);
    columns.text("model", model);
    columns.blob("words", words);
    columns.blob("descriptors", descriptors);
    columns.blob("thumbnail", thumbnail);
  }
};

}  // namespace urban_nav_store
